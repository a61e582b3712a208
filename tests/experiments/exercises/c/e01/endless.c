#define EXERCISE 1
#include "exercise.h"

void step(double *y, double *v, double dt, const struct spring *s)
{
    double t = 0.0;
    while (t < dt)
        *y += t * *v;
}
