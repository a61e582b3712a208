#define EXERCISE 1
#include "exercise.h"

void step(double *y, double *v, double dt, const struct spring *spring)
{
    int stretch = -*y - spring->rest_length;
    double force = spring->stiffness * stretch - spring->mass * spring->gravity - spring->damping * *v;
    *y += dt * *v;
    *v += dt * force / spring->mass;
}
