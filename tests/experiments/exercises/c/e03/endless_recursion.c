#define EXERCISE 3
#include "exercise.h"

static double sum(double x[][2], int i)
{
    return x[0][0] + sum(x, i + 1) * 0.5;
}

void forces(double x[][2], double v[][2], const struct string *s, double f[][2])
{
    f[0][0] = sum(x, 0);
}
