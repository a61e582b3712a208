/* Exercise 7: the barrier. Build me: cc -Wall -o barrier barrier.c -lm */
#define EXERCISE 7
#include "exercise.h"
#include <stdio.h>

void push_out(int count, double x[][2], double v[][2], const struct circle *circle)
{
    const double *c = circle->centre;
    for (int i = 0; i < count; i++) {
        double rx = x[i][0] - c[0], ry = x[i][1] - c[1];
        double r2 = rx * rx + ry * ry;
        if (r2 >= circle->radius * circle->radius)
            continue;
        double dot = rx * v[i][0] + ry * v[i][1];
        if (dot < 0) {
            v[i][0] -= dot / r2 * rx;
            v[i][1] -= dot / r2 * ry;
        }
        double grow = circle->radius / sqrt(r2);
        x[i][0] = c[0] + grow * rx;
        x[i][1] = c[1] + grow * ry;
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
