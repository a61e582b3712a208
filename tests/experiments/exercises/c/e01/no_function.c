#define EXERCISE 1
#include "exercise.h"

void euler_step(double *y, double *v, double dt, const struct spring *s)
{
    *y += dt * *v;
}
