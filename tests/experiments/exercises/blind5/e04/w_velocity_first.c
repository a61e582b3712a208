#define EXERCISE 4
#include "exercise.h"
#include <stdio.h>

typedef double vec[2];

static void force(const vec *x, const vec *v, const struct string *s, vec *f)
{
    int n = s->count;
    for (int i = n - 1; i >= 0; i--) {
        double upx = i ? x[i - 1][0] : s->anchor[0];
        double upy = i ? x[i - 1][1] : s->anchor[1];
        double ex = upx - x[i][0], ey = upy - x[i][1];
        double l = hypot(ex, ey);
        double q = s->stiffness[i] * (1 - s->rest_lengths[i] / l);
        f[i][0] = q * ex - s->drag * v[i][0];
        f[i][1] = q * ey - s->drag * v[i][1] - s->masses[i] * s->gravity;
        if (i < n - 1) {
            ex = x[i + 1][0] - x[i][0];
            ey = x[i + 1][1] - x[i][1];
            l = hypot(ex, ey);
            q = s->stiffness[i + 1] * (1 - s->rest_lengths[i + 1] / l);
            f[i][0] += q * ex;
            f[i][1] += q * ey;
        }
    }
}

void step(double x[][2], double v[][2], double dt, const struct string *string)
{
    int n = string->count;
    vec f1[n], f2[n], gx[n], gv[n];

    force((const vec *)x, (const vec *)v, string, f1);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < 2; j++) {
            gx[i][j] = x[i][j] + dt * v[i][j];
            gv[i][j] = v[i][j] + dt * f1[i][j] / string->masses[i];
        }
    force((const vec *)gx, (const vec *)gv, string, f2);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < 2; j++) {
            v[i][j] += 0.5 * dt * (f1[i][j] + f2[i][j]) / string->masses[i];
            x[i][j] += 0.5 * dt * (v[i][j] + gv[i][j]);
        }
}

int main(void)
{
    const double masses[] = {0.05, 0.05, 0.05}, stiffness[] = {50, 50, 50}, rest_lengths[] = {0.15, 0.15, 0.15};
    struct string string = {.count = 3, .masses = masses, .stiffness = stiffness, .rest_lengths = rest_lengths,
                            .drag = 0.02, .gravity = 9.81, .anchor = {0.1, 0.2}};
    double x[3][2] = {{0.25, 0.2}, {0.4, 0.2}, {0.55, 0.2}}, v[3][2] = {{0}};
    for (int i = 0; i < 10; i++) {
        printf("t = %.3f s   the last mass is at (%.5f, %.5f) m\n", 0.005 * i, x[2][0], x[2][1]);
        step(x, v, 0.005, &string);
    }
}
