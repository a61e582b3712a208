/* Exercise 3: the forces on a string. Build me: cc -Wall -o forces forces.c -lm */
#define EXERCISE 3
#include "exercise.h"
#include <stdio.h>

/* The force on every mass [N], into f. */
void forces(double x[][2], double v[][2], const struct string *string, double f[][2])
{
    double px = string->anchor[0], py = string->anchor[1];
    for (int i = 0; i < string->count; i++) {
        double dx = px - x[i][0], dy = py - x[i][1];
        double l = sqrt(pow(dx, 2) + pow(dy, 2));
        double t = string->stiffness[i] * (l - string->rest_lengths[i]) / l;
        f[i][0] = t * dx - string->drag * v[i][0];
        f[i][1] = t * dy - string->drag * v[i][1] - string->gravity;
        if (i >= 1) {
            f[i - 1][0] += t * dx;
            f[i - 1][1] += t * dy;
        }
        px = x[i][0];
        py = x[i][1];
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
