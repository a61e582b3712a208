/* Exercise 4: a string by Heun's step, the whole state at once. Build me: cc -Wall -o whole_state whole_state.c -lm */
#define EXERCISE 4
#include "exercise.h"
#include <stdio.h>
#include <string.h>

#define MAX 256

static void slopes(double x[][2], double v[][2], const struct string *p, double a[][2])
{
    for (int i = 0; i < p->count; i++) {
        a[i][0] = -p->drag * v[i][0];
        a[i][1] = -p->drag * v[i][1] - p->masses[i] * p->gravity;
    }
    for (int i = 0; i < p->count; i++) {
        double dx = x[i][0] - (i == 0 ? p->anchor[0] : x[i - 1][0]);
        double dy = x[i][1] - (i == 0 ? p->anchor[1] : x[i - 1][1]);
        double l = sqrt(dx * dx + dy * dy);
        double t = p->stiffness[i] * (l - p->rest_lengths[i]);
        a[i][0] -= t * dx / l;
        a[i][1] -= t * dy / l;
        if (i > 0) {
            a[i - 1][0] += t * dx / l;
            a[i - 1][1] += t * dy / l;
        }
    }
    for (int i = 0; i < p->count; i++) {
        a[i][0] /= p->masses[i];
        a[i][1] /= p->masses[i];
    }
}

/* From positions x [m] and velocities v [m/s], those after dt [s]. */
void step(double x[][2], double v[][2], double dt, const struct string *string)
{
    double oldx[MAX][2] = {{0}}, oldv[MAX][2] = {{0}}, a1[MAX][2], a2[MAX][2];
    int n = string->count;

    memcpy(oldx, x, n * sizeof(double));
    memcpy(oldv, v, 2 * n * sizeof(double));

    slopes(x, v, string, a1);
    for (int i = 0; i < n; i++)
        for (int c = 0; c < 2; c++) {
            x[i][c] += dt * v[i][c];
            v[i][c] += dt * a1[i][c];
        }
    slopes(x, v, string, a2);
    for (int i = 0; i < n; i++)
        for (int c = 0; c < 2; c++) {
            x[i][c] = oldx[i][c] + dt * (oldv[i][c] + v[i][c]) / 2;
            v[i][c] = oldv[i][c] + dt * (a1[i][c] + a2[i][c]) / 2;
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
