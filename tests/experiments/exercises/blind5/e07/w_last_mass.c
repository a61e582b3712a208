#define EXERCISE 7
#include "exercise.h"
#include <stdio.h>

static double dot(const double a[2], const double b[2])
{
    return a[0] * b[0] + a[1] * b[1];
}

void push_out(int count, double x[][2], double v[][2], const struct circle *circle)
{
    int i = 0;
    while (i < count - 1) {
        double n[2] = {x[i][0] - circle->centre[0], x[i][1] - circle->centre[1]};
        double length = sqrt(dot(n, n));
        n[0] /= length;
        n[1] /= length;
        if (length < circle->radius) {
            double vn = fmin(dot(v[i], n), 0.0);
            for (int k = 0; k < 2; k++) {
                x[i][k] = circle->centre[k] + circle->radius * n[k];
                v[i][k] -= vn * n[k];
            }
        }
        i++;
    }
}

int main(void)
{
    struct circle circle = {.centre = {0.5, 0.0}, .radius = 0.3};
    double x[3][2] = {{0.5, 0.25}, {0.3, 0.0}, {0.0, 0.0}}, v[3][2] = {{0.5, -1.0}, {0.5, -1.0}, {0.5, -1.0}};
    push_out(3, x, v, &circle);
    for (int i = 0; i < 3; i++)
        printf("(%.5f, %.5f) m   (%.5f, %.5f) m/s\n", x[i][0], x[i][1], v[i][0], v[i][1]);
}
