#define EXERCISE 1
#include "exercise.h"

void step(double *y, double *v, double dt, const struct spring *s)
{
    double height = *y, speed = *v;
    double a = (s->stiffness * (-height - s->rest_length) - s->damping * speed) / s->mass - s->gravity;
    height += dt * speed;
    speed += dt * a;
}
