/* Exercise 4: a string by Heun's step, the whole state at once. Build me: cc -Wall -o whole_state whole_state.c -lm */
#define EXERCISE 4
#include "exercise.h"
#include <stdio.h>

static void acceleration(int i, double x[][2], double v[][2], const struct string *s, double a[2])
{
    double f[2] = {-s->drag * v[i][0], -s->drag * v[i][1] - s->masses[i] * s->gravity};
    for (int k = i; k <= i + 1 && k < s->count; k++) {
        const double *other = k > i ? x[i + 1] : i > 0 ? x[i - 1] : s->anchor;
        double dx = other[0] - x[i][0], dy = other[1] - x[i][1], l = hypot(dx, dy);
        double t = s->stiffness[k] * (l - s->rest_lengths[k]);
        f[0] += t * dx / l;
        f[1] += t * dy / l;
    }
    a[0] = f[0] / s->masses[i];
    a[1] = f[1] / s->masses[i];
}

/* From positions x [m] and velocities v [m/s], those after dt [s]. */
void step(double x[][2], double v[][2], double dt, const struct string *string)
{
    int n = string->count;
    double x0[n][2], v0[n][2], a0[n][2], a1[n][2];

    for (int i = 0; i < n; i++) {
        acceleration(i, x, v, string, a0[i]);
        for (int j = 0; j < 2; j++) {
            x0[i][j] = x[i][j];
            v0[i][j] = v[i][j];
            x[i][j] += dt * v0[i][j];
            v[i][j] += dt * a0[i][j];
        }
    }
    for (int i = 0; i < n; i++)
        acceleration(i, x, v, string, a1[i]);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < 2; j++) {
            x[i][j] = x0[i][j] + dt / 2 * (v0[i][j] + v[i][j]);
            v[i][j] = v0[i][j] + dt / 2 * (a0[i][j] + a1[i][j]);
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
