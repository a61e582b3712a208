/* Exercise 4: a string by Heun's step, the whole state at once. Build me: cc -Wall -o whole_state whole_state.c -lm */
#define EXERCISE 4
#include "exercise.h"
#include <stdio.h>

static void acceleration(double x[][2], double v[][2], const struct string *s, double a[][2])
{
    for (int i = 0; i < s->count; i++) {
        a[i][0] = 0;
        a[i][1] = s->gravity;
    }
    for (int i = 0; i < s->count; i++) {
        const double *u = i ? x[i - 1] : s->anchor;
        double d[2] = {x[i][0] - u[0], x[i][1] - u[1]};
        double l = sqrt(d[0] * d[0] + d[1] * d[1]);
        double t = s->stiffness[i] * (l - s->rest_lengths[i]);
        for (int c = 0; c < 2; c++) {
            a[i][c] -= (t * d[c] / l + s->drag * v[i][c]) / s->masses[i];
            if (i)
                a[i - 1][c] += t * d[c] / l / s->masses[i - 1];
        }
    }
}

void step(double x[][2], double v[][2], double dt, const struct string *string)
{
    int n = string->count;
    double xg[n][2], vg[n][2], a[n][2], b[n][2];
    acceleration(x, v, string, a);
    for (int i = 0; i < n; i++)
        for (int c = 0; c < 2; c++) {
            xg[i][c] = x[i][c] + dt * v[i][c];
            vg[i][c] = v[i][c] + dt * a[i][c];
        }
    acceleration(xg, vg, string, b);
    for (int i = 0; i < n; i++)
        for (int c = 0; c < 2; c++) {
            v[i][c] += 0.5 * dt * (a[i][c] + b[i][c]);
            x[i][c] += 0.5 * dt * (v[i][c] + vg[i][c]);
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
