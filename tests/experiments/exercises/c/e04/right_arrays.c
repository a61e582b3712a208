#define EXERCISE 4
#include "exercise.h"

static void accelerations(double x[][2], double v[][2], const struct string *s, double a[][2])
{
    for (int i = 0; i < s->count; i++) {
        a[i][0] = -s->drag * v[i][0] / s->masses[i];
        a[i][1] = -s->drag * v[i][1] / s->masses[i] - s->gravity;
    }
    for (int i = 0; i < s->count; i++) {
        const double *top = i ? x[i - 1] : s->anchor;
        double d[2] = {x[i][0] - top[0], x[i][1] - top[1]};
        double l = sqrt(d[0] * d[0] + d[1] * d[1]);
        for (int k = 0; k < 2; k++) {
            double pull = s->stiffness[i] * (l - s->rest_lengths[i]) * d[k] / l;
            a[i][k] -= pull / s->masses[i];
            if (i)
                a[i - 1][k] += pull / s->masses[i - 1];
        }
    }
}

void step(double x[][2], double v[][2], double dt, const struct string *string)
{
    int n = string->count;
    double a[n][2], xg[n][2], vg[n][2], ag[n][2];
    accelerations(x, v, string, a);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 2; k++) {
            xg[i][k] = x[i][k] + dt * v[i][k];
            vg[i][k] = v[i][k] + dt * a[i][k];
        }
    accelerations(xg, vg, string, ag);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 2; k++) {
            x[i][k] += dt * (v[i][k] + vg[i][k]) / 2;
            v[i][k] += dt * (a[i][k] + ag[i][k]) / 2;
        }
}
