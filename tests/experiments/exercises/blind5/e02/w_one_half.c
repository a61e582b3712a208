#define EXERCISE 2
#include "exercise.h"
#include <stdio.h>

/* From height *y [m] and velocity *v [m/s], those after dt [s]. */
void step(double *y, double *v, double dt, const struct spring *spring)
{
    const double m = spring->mass, k = spring->stiffness, c = spring->damping;
    const double l = spring->rest_length, g = spring->gravity;
    double ky[2], kv[2];

    ky[0] = *v;
    kv[0] = (-k * (*y + l) - c * *v) / m - g;
    ky[1] = *v + dt * kv[0];
    kv[1] = (-k * (*y + dt * ky[0] + l) - c * ky[1]) / m - g;

    *y += 1 / 2 * dt * (ky[0] + ky[1]);
    *v += 1 / 2 * dt * (kv[0] + kv[1]);
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
