/* Exercise 3: the forces on a string. Build me: cc -Wall -o forces forces.c -lm */
#define EXERCISE 3
#include "exercise.h"
#include <stdio.h>

/* The force on every mass [N], into f. */
void forces(double x[][2], double v[][2], const struct string *string, double f[][2])
{
    for (int i = 0; i < string->count; i++) {
        const double *up = i ? x[i - 1] : string->anchor;
        double d[2] = {x[i][0] - up[0], x[i][1] - up[1]};
        double l = hypot(d[0], d[1]);
        double t = string->stiffness[i] * (l - string->rest_lengths[i]);
        for (int j = 0; j < 2; j++) {
            f[i][j] -= t * d[j] / l + string->drag * v[i][j];
            if (i > 0)
                f[i - 1][j] += t * d[j] / l;
        }
        f[i][1] -= string->masses[i] * string->gravity;
    }
}

int main(void)
{
    const double masses[] = {0.05, 0.05, 0.05}, stiffness[] = {50, 50, 50}, rest_lengths[] = {0.15, 0.15, 0.15};
    struct string string = {.count = 3, .masses = masses, .stiffness = stiffness, .rest_lengths = rest_lengths,
                            .drag = 0.02, .gravity = 9.81, .anchor = {0.1, 0.2}};
    double x[3][2] = {{0.25, 0.2}, {0.4, 0.2}, {0.55, 0.2}}, v[3][2] = {{0}}, f[3][2] = {{0}};
    forces(x, v, &string, f);
    for (int i = 0; i < 3; i++)
        printf("mass %d: %.5f N sideways, %.5f N upwards\n", i, f[i][0], f[i][1]);
}
