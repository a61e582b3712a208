/* Exercise 7: the barrier. Build me: cc -Wall -o barrier barrier.c -lm */
#define EXERCISE 7
#include "exercise.h"
#include <stdio.h>

/* Positions x [m] and velocities v [m/s] after they have met the circle. */
void push_out(int count, double x[][2], double v[][2], const struct circle *circle)
{
    const double *c = circle->centre, r2 = circle->radius * circle->radius;
    while (count-- > 0) {
        double *p = x[count], *w = v[count];
        double d[2] = {p[0] - c[0], p[1] - c[1]};
        double d2 = d[0] * d[0] + d[1] * d[1];
        if (d2 > r2)
            continue;
        double q = (w[0] * d[0] + w[1] * d[1]) / d2; /* no root needed: q d is the part along d */
        for (int j = 0; j < 2; j++) {
            if (q < 0)
                w[j] -= q * d[j];
            p[j] = c[j] + sqrt(r2 / d2) * d[j];
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
