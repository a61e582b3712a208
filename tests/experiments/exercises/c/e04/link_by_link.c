#define EXERCISE 4
#include "exercise.h"

static void acceleration(int i, double x[][2], double v[][2], const struct string *s, double a[2])
{
    a[0] = -s->drag * v[i][0];
    a[1] = -s->drag * v[i][1] - s->masses[i] * s->gravity;
    for (int j = i; j <= i + 1 && j < s->count; j++) {
        const double *top = j ? x[j - 1] : s->anchor;
        double dx = x[j][0] - top[0], dy = x[j][1] - top[1], l = sqrt(dx * dx + dy * dy);
        double t = s->stiffness[j] * (l - s->rest_lengths[j]) / l * (j == i ? -1 : 1);
        a[0] += t * dx;
        a[1] += t * dy;
    }
    a[0] /= s->masses[i];
    a[1] /= s->masses[i];
}

void step(double x[][2], double v[][2], double dt, const struct string *s)
{
    for (int i = 0; i < s->count; i++) {
        double x0[2] = {x[i][0], x[i][1]}, v0[2] = {v[i][0], v[i][1]}, a[2], b[2];
        acceleration(i, x, v, s, a);
        for (int k = 0; k < 2; k++) {
            x[i][k] = x0[k] + dt * v0[k];
            v[i][k] = v0[k] + dt * a[k];
        }
        acceleration(i, x, v, s, b);
        for (int k = 0; k < 2; k++) {
            x[i][k] = x0[k] + dt * (v0[k] + v[i][k]) / 2;
            v[i][k] = v0[k] + dt * (a[k] + b[k]) / 2;
        }
    }
}
