/* Exercise 3: the forces on a string. Build me: cc -Wall -o forces forces.c -lm */
#define EXERCISE 3
#include "exercise.h"
#include <stdio.h>

/* The force on every mass [N], into f. */
void forces(double x[][2], double v[][2], const struct string *string, double f[][2])
{
    int i;

    /* weight and drag */
    for (i = 0; i < string->count; i++) {
        f[i][0] = 0.0;
        f[i][1] = -string->masses[i] * string->gravity;
        f[i][0] -= string->drag * v[i][0];
        f[i][1] -= string->drag * v[i][1];
    }
    /* springs */
    for (i = 1; i < string->count; i++) {
        double direction[2] = {x[i][0] - x[i - 1][0], x[i][1] - x[i - 1][1]};
        double length = hypot(direction[0], direction[1]);
        double force = string->stiffness[i] * (length - string->rest_lengths[i]);
        f[i][0] -= force * direction[0] / length;
        f[i][1] -= force * direction[1] / length;
        f[i - 1][0] += force * direction[0] / length;
        f[i - 1][1] += force * direction[1] / length;
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
