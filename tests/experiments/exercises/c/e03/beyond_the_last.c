#define EXERCISE 3
#include "exercise.h"

void forces(double x[][2], double v[][2], const struct string *s, double f[][2])
{
    for (int i = 0; i <= s->count; i++) {
        f[i][0] = 0.0;
        f[i][1] = 0.0;
    }
}
