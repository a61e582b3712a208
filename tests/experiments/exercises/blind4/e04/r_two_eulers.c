/* Exercise 4: a string by Heun's step, the whole state at once. Build me: cc -Wall -o whole_state whole_state.c -lm */
#define EXERCISE 4
#include "exercise.h"
#include <stdio.h>

static void euler(int n, double x[][2], double v[][2], double dt, const struct string *s)
{
    double f[n][2];
    for (int i = 0; i < n; i++) {
        const double *up = i ? x[i - 1] : s->anchor;
        double d[2] = {up[0] - x[i][0], up[1] - x[i][1]};
        double l = hypot(d[0], d[1]);
        for (int c = 0; c < 2; c++) {
            double p = s->stiffness[i] * (l - s->rest_lengths[i]) * d[c] / l;
            f[i][c] = p - s->drag * v[i][c] - (c == 1 ? s->masses[i] * s->gravity : 0.0);
            if (i)
                f[i - 1][c] -= p;
        }
    }
    for (int i = 0; i < n; i++)
        for (int c = 0; c < 2; c++) {
            x[i][c] += dt * v[i][c];
            v[i][c] += dt * f[i][c] / s->masses[i];
        }
}

void step(double x[][2], double v[][2], double dt, const struct string *string)
{
    int n = string->count;
    double x0[n][2], v0[n][2];
    for (int i = 0; i < n; i++)
        for (int c = 0; c < 2; c++) {
            x0[i][c] = x[i][c];
            v0[i][c] = v[i][c];
        }
    euler(n, x, v, dt, string);
    euler(n, x, v, dt, string);
    for (int i = 0; i < n; i++)
        for (int c = 0; c < 2; c++) {
            x[i][c] = (x[i][c] + x0[i][c]) / 2;
            v[i][c] = (v[i][c] + v0[i][c]) / 2;
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
