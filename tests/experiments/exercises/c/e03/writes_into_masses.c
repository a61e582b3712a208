#define EXERCISE 3
#include "exercise.h"

void forces(double x[][2], double v[][2], const struct string *s, double f[][2])
{
    s->masses[0] = 1.0;
    f[0][0] = x[0][0] + v[0][0];
}
