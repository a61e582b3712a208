#define EXERCISE 1
#include "exercise.h"
#include <stdio.h>

static double acceleration(struct spring s, double y, double v)
{
    return (s.stiffness * (-y - s.rest_length) - s.damping * v) / s.mass - s.gravity;
}

void step(double *y, double *v, double dt, const struct spring *spring)
{
    const double a = acceleration(*spring, *y, *v);
    *y += *v * dt;
    *v += a * dt;
    printf("y = %f\n", *y);
}

int main(void)
{
    struct spring spring = {0.05, 50.0, 0.15, 0.0, 9.81};
    double y = -0.2, v = 0.0;
    step(&y, &v, 0.005, &spring);
    return 0;
}
