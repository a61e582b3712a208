/* Exercise 7: the barrier. Build me: cc -Wall -o barrier barrier.c -lm */
#define EXERCISE 7
#include "exercise.h"
#include <stdio.h>

/* Positions x [m] and velocities v [m/s] after they have met the circle. */
void push_out(int count, double x[][2], double v[][2], const struct circle *circle)
{
    for (int i = 0; i < count; i++) {
        double dx = x[i][0] - circle->centre[0], dy = x[i][1] - circle->centre[1];
        double r = hypot(dx, dy);
        double ex = dx / r, ey = dy / r;

        if (r >= circle->radius)
            continue;

        x[i][0] += (circle->radius - r) * ex;
        x[i][1] += (circle->radius - r) * ey;

        if (v[i][0] * ex + v[i][1] * ey < 0) {
            v[i][0] -= (v[i][0] * ex + v[i][1] * ey) * ex;
            v[i][1] -= (v[i][0] * ex + v[i][1] * ey) * ey;
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
