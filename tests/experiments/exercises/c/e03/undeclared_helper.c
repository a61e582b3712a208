#define EXERCISE 3
#include "exercise.h"

void forces(double x[][2], double v[][2], const struct string *s, double f[][2])
{
    f[0][0] = pull(x[0][0], s->rest_lengths[0]);
    f[0][1] = v[0][0];
}

double pull(double length, double rest)
{
    return length - rest;
}
