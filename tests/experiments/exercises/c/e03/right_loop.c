#define EXERCISE 3
#include "exercise.h"

void forces(double x[][2], double v[][2], const struct string *string, double f[][2])
{
    for (int i = 0; i < string->count; i++) {
        f[i][0] = -string->drag * v[i][0];
        f[i][1] = -string->drag * v[i][1] - string->masses[i] * string->gravity;
    }
    for (int i = 0; i < string->count; i++) {
        const double *above = i == 0 ? string->anchor : x[i - 1];
        double dx = above[0] - x[i][0], dy = above[1] - x[i][1];
        double length = sqrt(dx * dx + dy * dy);
        double pull = string->stiffness[i] * (length - string->rest_lengths[i]) / length;
        f[i][0] += pull * dx;
        f[i][1] += pull * dy;
        if (i > 0) {
            f[i - 1][0] -= pull * dx;
            f[i - 1][1] -= pull * dy;
        }
    }
}
