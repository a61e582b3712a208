#define EXERCISE 1
#include "exercise.h"

void step(double *y, double *v, double dt, const struct spring *spring)
{
    double force = spring->stiffness * (-*y - spring->rest_length) - spring->damping * *v;
    *v += dt * (force / spring->mass - spring->gravity);
    *y += dt * *v;
}
