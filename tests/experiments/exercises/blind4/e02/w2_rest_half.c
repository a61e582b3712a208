/* Exercise 2: one mass on a spring, by Heun's step. Build me: cc -Wall -o heun heun.c -lm */
#define EXERCISE 2
#include "exercise.h"
#include <stdio.h>

/* From height *y [m] and velocity *v [m/s], those after dt [s]. */
void step(double *y, double *v, double dt, const struct spring *spring)
{
    const double k = spring->stiffness, m = spring->mass, g = spring->gravity;
    const double c = spring->damping, L = spring->rest_length;

    /* slope here */
    double dy1 = *v;
    double dv1 = (k * (-*y - L) - c * *v) / m - g;
    /* guess */
    double yg = *y + dt * dy1, vg = *v + dt * dv1;
    /* slope there */
    double dy2 = vg;
    double dv2 = k * (-yg - L) / m - g;
    /* step */
    *y += dt * (dy1 + dy2);
    *v += dt * (dv1 + dv2) / 2;
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
