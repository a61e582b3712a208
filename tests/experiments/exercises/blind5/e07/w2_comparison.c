/* Exercise 7: the barrier. Build me: cc -Wall -o barrier barrier.c -lm */
#define EXERCISE 7
#include "exercise.h"
#include <stdio.h>

/* Positions x [m] and velocities v [m/s] after they have met the circle. */
void push_out(int count, double x[][2], double v[][2], const struct circle *circle)
{
    int i, j;
    for (i = 0; i < count; i++) {
        double d[2], n[2], dist2 = 0, vn = 0;
        for (j = 0; j < 2; j++) {
            d[j] = x[i][j] - circle->centre[j];
            dist2 += d[j] * d[j];
        }
        if (dist2 < circle->radius) {
            for (j = 0; j < 2; j++) {
                n[j] = d[j] / sqrt(dist2);
                vn += v[i][j] * n[j];
            }
            for (j = 0; j < 2; j++) {
                x[i][j] = circle->centre[j] + circle->radius * n[j];
                if (vn > 0)
                    v[i][j] -= vn * n[j];
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
