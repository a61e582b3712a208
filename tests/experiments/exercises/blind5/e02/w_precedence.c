/* Exercise 2: one mass on a spring, by Heun's step. Build me: cc -Wall -o heun heun.c -lm */
#define EXERCISE 2
#include "exercise.h"
#include <stdio.h>

static void slope(const double s[2], double out[2], const struct spring *p)
{
    out[0] = s[1];
    out[1] = (p->stiffness * (-s[0] - p->rest_length) - p->damping * s[1] - p->mass * p->gravity) / p->mass;
}

/* From height *y [m] and velocity *v [m/s], those after dt [s]. */
void step(double *y, double *v, double dt, const struct spring *spring)
{
    double now[2] = {*y, *v}, guess[2], d1[2], d2[2];
    slope(now, d1, spring);
    for (int i = 0; i < 2; i++)
        guess[i] = now[i] + dt * d1[i];
    slope(guess, d2, spring);
    *y = now[0] + dt * (d1[0] + d2[0]) / 2;
    *v = now[1] + dt * d1[1] + d2[1] / 2;
}

int main(void)
{
    struct spring spring = {.mass = 0.05, .stiffness = 50.0, .rest_length = 0.15, .damping = 0.0, .gravity = 9.81};
    double y = -0.2, v = 0.0;
    for (int i = 0; i < 10; i++) {
        printf("t = %.3f s   y = %.5f m   v = %.5f m/s\n", 0.005 * i, y, v);
        step(&y, &v, 0.005, &spring);
    }
}
