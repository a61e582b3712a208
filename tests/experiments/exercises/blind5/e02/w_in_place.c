/* Exercise 2: one mass on a spring, by Heun's step. Build me: cc -Wall -o heun heun.c -lm */
#define EXERCISE 2
#include "exercise.h"
#include <stdio.h>

static double accel(double y, double v, const struct spring *s)
{
    double f = s->stiffness * (-y - s->rest_length);
    f -= s->mass * s->gravity;
    f -= s->damping * v;
    return f / s->mass;
}

/* From height *y [m] and velocity *v [m/s], those after dt [s]. */
void step(double *y, double *v, double dt, const struct spring *spring)
{
    double a1 = accel(*y, *v, spring);
    double yg = *y + dt * *v;
    double vg = *v + dt * a1;
    double a2 = accel(yg, vg, spring);

    *v += dt * (a1 + a2) / 2;
    *y += dt * (*v + vg) / 2;
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
