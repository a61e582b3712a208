/* Exercise 2: one mass on a spring, by Heun's step. Build me: cc -Wall -o heun heun.c -lm */
#define EXERCISE 2
#include "exercise.h"
#include <stdio.h>

typedef struct {
    double y, v;
} state;

static state slope(state s, const struct spring *p)
{
    state d;
    d.y = s.v;
    d.v = p->stiffness / p->mass * (-s.y - p->rest_length) - p->damping / p->mass * s.v - p->gravity;
    return d;
}

static state along(state from, double h, state k)
{
    return (state){from.y + h * k.y, from.v + h * k.v};
}

/* From height *y [m] and velocity *v [m/s], those after dt [s]. */
void step(double *y, double *v, double dt, const struct spring *spring)
{
    state s = {*y, *v};
    state k1 = slope(s, spring);
    state k2 = slope(along(s, dt, k1), spring);
    state end = along(along(s, dt / 2, k1), dt / 2, k2);
    *y = end.y;
    *v = end.v;
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
