/* Exercise 7: the barrier. Build me: cc -Wall -o barrier barrier.c -lm */
#define EXERCISE 7
#include "exercise.h"
#include <stdio.h>

/* Positions x [m] and velocities v [m/s] after they have met the circle. */
void push_out(int count, double x[][2], double v[][2], const struct circle *circle)
{
    for (int i = 0; i < count; i++) {
        double nx = x[i][0] - circle->centre[0];
        double ny = x[i][1] - circle->centre[1];
        double d = sqrt(nx * nx + ny * ny);
        if (d < circle->radius) {
            nx /= d;
            ny /= d;
            x[i][0] = circle->centre[0] + nx * circle->radius;
            x[i][1] = circle->centre[1] + ny * circle->radius;
            if (v[i][0] * nx + v[i][1] * ny < 0.0) {
                v[i][0] = 0.0;
                v[i][1] = 0.0;
            }
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
