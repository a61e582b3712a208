#define EXERCISE 1
#include "exercise.h"

void step(double *y, double *v, double dt, const struct spring *s)
{
    double force = s->stiffness * (-*y - s->rest_length) - s->mass * s->gravity + s->damping * *v;
    double yn = *y + dt * *v, vn = *v + dt * force / s->mass;
    *y = yn;
    *v = vn;
}
