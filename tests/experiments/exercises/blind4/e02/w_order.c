/* Exercise 2: one mass on a spring, by Heun's step. Build me: cc -Wall -o heun heun.c -lm */
#define EXERCISE 2
#include "exercise.h"
#include <stdio.h>

/* From height *y [m] and velocity *v [m/s], those after dt [s]. */
void step(double *y, double *v, double dt, const struct spring *spring)
{
    double m = spring->mass, k = spring->stiffness, c = spring->damping, l = spring->rest_length;
    double a1 = k * (-*y - l) / m - c * *v / m - spring->gravity;
    double guess_y = *y + dt * *v;
    double guess_v = *v + dt * a1;
    double a2 = k * (-guess_y - l) / m - c * guess_v / m - spring->gravity;

    *v = *v + 0.5 * dt * (a1 + a2);
    *y = *y + 0.5 * dt * (*v + guess_v);
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
