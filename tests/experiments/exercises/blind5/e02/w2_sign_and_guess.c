/* Exercise 2: one mass on a spring, by Heun's step. Build me: cc -Wall -o heun heun.c -lm */
#define EXERCISE 2
#include "exercise.h"
#include <stdio.h>

#define ACC(Y, V) ((s->stiffness * (-(Y) - s->rest_length) + s->damping * (V)) / s->mass - s->gravity)

/* From height *y [m] and velocity *v [m/s], those after dt [s]. */
void step(double *y, double *v, double dt, const struct spring *s)
{
    double a1 = ACC(*y, *v);
    double v2 = *v + dt * a1;
    double a2 = ACC(*y + dt * *v, v2);
    *y += dt * v2;
    *v += dt * (a1 + a2) / 2;
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
