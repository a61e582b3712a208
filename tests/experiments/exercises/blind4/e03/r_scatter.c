/* Exercise 3: the forces on a string. Build me: cc -Wall -o forces forces.c -lm */
#define EXERCISE 3
#include "exercise.h"
#include <stdio.h>

void forces(double x[][2], double v[][2], const struct string *string, double f[][2])
{
    const double *up = string->anchor;
    double *f_up = 0;

    for (int i = 0; i < string->count; i++) {
        double rx = up[0] - x[i][0], ry = up[1] - x[i][1];
        double r = hypot(rx, ry);
        double t = string->stiffness[i] * (r - string->rest_lengths[i]) / r;
        f[i][0] = t * rx - string->drag * v[i][0];
        f[i][1] = t * ry - string->drag * v[i][1] - string->masses[i] * string->gravity;
        if (f_up) {
            f_up[0] -= t * rx;
            f_up[1] -= t * ry;
        }
        up = x[i];
        f_up = f[i];
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
