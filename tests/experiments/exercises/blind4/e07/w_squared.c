/* Exercise 7: the barrier. Build me: cc -Wall -o barrier barrier.c -lm */
#define EXERCISE 7
#include "exercise.h"
#include <stdio.h>

void push_out(int count, double x[][2], double v[][2], const struct circle *circle)
{
    double R = circle->radius;
    for (int k = 0; k < count; ++k) {
        double a = x[k][0] - circle->centre[0], b = x[k][1] - circle->centre[1];
        double dd = a * a + b * b;
        if (dd < R) {
            double d = sqrt(dd);
            double nx = a / d, ny = b / d;
            double s = fmin(0.0, v[k][0] * nx + v[k][1] * ny);
            x[k][0] = circle->centre[0] + R * nx;
            x[k][1] = circle->centre[1] + R * ny;
            v[k][0] -= s * nx;
            v[k][1] -= s * ny;
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
