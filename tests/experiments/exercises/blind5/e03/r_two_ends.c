/* Exercise 3: the forces on a string. Build me: cc -Wall -o forces forces.c -lm */
#define EXERCISE 3
#include "exercise.h"
#include <stdio.h>

/* What spring i does to the mass at its lower end (side = 1) or the one at its upper end (side = -1). */
static double spring_force(double x[][2], const struct string *s, int i, int axis, int side)
{
    const double *top = i == 0 ? s->anchor : x[i - 1];
    double dx = top[0] - x[i][0], dy = top[1] - x[i][1];
    double l = sqrt(dx * dx + dy * dy);
    return side * s->stiffness[i] * (l - s->rest_lengths[i]) * (axis == 0 ? dx : dy) / l;
}

/* The force on every mass [N], into f. */
void forces(double x[][2], double v[][2], const struct string *string, double f[][2])
{
    for (int axis = 0; axis < 2; axis++) {
        for (int i = string->count - 1; i >= 0; i--) {
            f[i][axis] = spring_force(x, string, i, axis, 1) - string->drag * v[i][axis];
            if (i + 1 < string->count)
                f[i][axis] += spring_force(x, string, i + 1, axis, -1);
            if (axis)
                f[i][axis] -= string->masses[i] * string->gravity;
        }
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
