#define EXERCISE 1
#include "exercise.h"
#include <stdio.h>

void step(double *y, double *v, double dt, const struct spring *spring)
{
    double m = spring->mass, k = spring->stiffness, c = spring->damping, l0 = spring->rest_length;
    double dydt = *v;
    /* m y'' = -k (y + l0) - m g - c y' */
    double dvdt = -spring->gravity - (k * (*y + l0) - c * dydt) / m;
    *y += dydt * dt;
    *v += dvdt * dt;
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
