/* Exercise 7: the barrier. Build me: cc -Wall -o barrier barrier.c -lm */
#define EXERCISE 7
#include "exercise.h"
#include <stdio.h>

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1];
}

void push_out(int count, double x[][2], double v[][2], const struct circle *circle)
{
    for (int i = 0; i < count; i++) {
        double n[2] = {x[i][0] - circle->centre[0], x[i][1] - circle->centre[1]};
        double d = sqrt(dot(n, n));
        if (d < circle->radius) {
            n[0] /= d;
            n[1] /= d;
            if (dot(v[i], n) < 0) {
                v[i][0] -= dot(v[i], n) * n[0];
                v[i][1] -= dot(v[i], n) * n[1];
            }
            x[i][0] = circle->centre[0] + circle->radius * n[0];
            x[i][1] = circle->centre[1] + circle->radius * n[1];
        }
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
