#define EXERCISE 3
#include "exercise.h"
#include <stdio.h>

static void add_spring(const double a[2], const double b[2], double k, double rest, double sign, double out[2])
{
    double ex = b[0] - a[0];
    double ey = b[1] - a[1];
    double l = sqrt(ex * ex + ey * ey);
    out[0] += sign * k * (l - rest) * ex / l;
    out[1] += sign * k * (l - rest) * ey / l;
}

void forces(double x[][2], double v[][2], const struct string *s, double f[][2])
{
    for (int i = 0; i < s->count; i++) {
        f[i][0] = -s->masses[i] * s->gravity - s->drag * v[i][0];
        f[i][1] = -s->drag * v[i][1];
        if (i == 0)
            add_spring(x[i], s->anchor, s->stiffness[i], s->rest_lengths[i], 1, f[i]);
        else
            add_spring(x[i], x[i - 1], s->stiffness[i], s->rest_lengths[i], 1, f[i]);
        if (i < s->count - 1)
            add_spring(x[i], x[i + 1], s->stiffness[i + 1], s->rest_lengths[i + 1], 1, f[i]);
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
