/* Exercise 4: a string by Heun's step, the whole state at once. Build me: cc -Wall -o whole_state whole_state.c -lm */
#define EXERCISE 4
#include "exercise.h"
#include <stdio.h>

static void force(int n, double x[][2], double v[][2], const struct string *s, double f[][2])
{
    double pull[n + 1][2];
    pull[n][0] = pull[n][1] = 0;
    for (int i = 0; i < n; i++) {
        const double *q = i ? x[i - 1] : s->anchor;
        double l = hypot(q[0] - x[i][0], q[1] - x[i][1]);
        double t = s->stiffness[i] * (l - s->rest_lengths[i]);
        pull[i][0] = t * (q[0] - x[i][0]) / l;
        pull[i][1] = t * (q[1] - x[i][1]) / l;
    }
    for (int i = 0; i < n; i++) {
        f[i][0] = pull[i][0] - pull[i + 1][0] - s->drag * v[i][0];
        f[i][1] = pull[i][1] - pull[i + 1][1] - s->drag * v[i][1] - s->masses[i] * s->gravity;
    }
}

void step(double x[][2], double v[][2], double dt, const struct string *string)
{
    int i, n = string->count;
    double f1[n][2], f2[n][2], xg[n][2], vg[n][2];
    force(n, x, v, string, f1);
    for (i = 0; i < n; i++) {
        double m = string->masses[i];
        xg[i][0] = x[i][0] + dt * v[i][0];
        xg[i][1] = x[i][1] + dt * v[i][1];
        vg[i][0] = v[i][0] + dt * f1[i][0] / m;
        vg[i][1] = v[i][1] + dt * f1[i][1] / m;
    }
    force(n, xg, vg, string, f2);
    for (i = 0; i < n - 1; i++) {
        double m = string->masses[i];
        x[i][0] += dt * (v[i][0] + vg[i][0]) / 2;
        x[i][1] += dt * (v[i][1] + vg[i][1]) / 2;
        v[i][0] += dt * (f1[i][0] + f2[i][0]) / 2 / m;
        v[i][1] += dt * (f1[i][1] + f2[i][1]) / 2 / m;
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
