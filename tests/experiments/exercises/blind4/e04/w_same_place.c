/* Exercise 4: a string by Heun's step, the whole state at once. Build me: cc -Wall -o whole_state whole_state.c -lm */
#define EXERCISE 4
#include "exercise.h"
#include <stdio.h>

static void accel(double x[][2], double v[][2], const struct string *s, double a[][2])
{
    for (int i = 0; i < s->count; i++) {
        const double *p = i == 0 ? s->anchor : x[i - 1];
        double dx = p[0] - x[i][0], dy = p[1] - x[i][1];
        double l = sqrt(dx * dx + dy * dy);
        double k = s->stiffness[i] * (l - s->rest_lengths[i]) / l;
        a[i][0] = (k * dx - s->drag * v[i][0]) / s->masses[i];
        a[i][1] = (k * dy - s->drag * v[i][1]) / s->masses[i] - s->gravity;
        if (i > 0) {
            a[i - 1][0] -= k * dx / s->masses[i - 1];
            a[i - 1][1] -= k * dy / s->masses[i - 1];
        }
    }
}

void step(double x[][2], double v[][2], double dt, const struct string *string)
{
    int n = string->count;
    double a1[n][2], a2[n][2], xg[n][2], vg[n][2];

    accel(x, v, string, a1);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < 2; j++) {
            xg[i][j] = x[i][j] + dt * v[i][j];
            vg[i][j] = v[i][j] + dt * a1[i][j];
        }
    }
    accel(x, v, string, a2);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < 2; j++) {
            x[i][j] += dt * (v[i][j] + vg[i][j]) / 2;
            v[i][j] += dt * (a1[i][j] + a2[i][j]) / 2;
        }
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
