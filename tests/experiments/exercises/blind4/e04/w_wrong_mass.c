/* Exercise 4: a string by Heun's step, the whole state at once. Build me: cc -Wall -o whole_state whole_state.c -lm */
#define EXERCISE 4
#include "exercise.h"
#include <stdio.h>

static void slopes(double x[][2], double v[][2], const struct string *s, double a[][2])
{
    for (int i = 0; i < s->count; i++) {
        a[i][0] = -s->drag * v[i][0] / s->masses[i];
        a[i][1] = -s->drag * v[i][1] / s->masses[i] - s->gravity;
    }
    for (int i = 0; i < s->count; i++) {
        double ux, uy;
        if (i == 0) {
            ux = s->anchor[0] - x[0][0];
            uy = s->anchor[1] - x[0][1];
        } else {
            ux = x[i - 1][0] - x[i][0];
            uy = x[i - 1][1] - x[i][1];
        }
        double len = hypot(ux, uy);
        double tension = s->stiffness[i] * (len - s->rest_lengths[i]);
        double ax = tension * ux / len / s->masses[i];
        double ay = tension * uy / len / s->masses[i];
        a[i][0] += ax;
        a[i][1] += ay;
        if (i > 0) {
            a[i - 1][0] -= ax;
            a[i - 1][1] -= ay;
        }
    }
}

void step(double x[][2], double v[][2], double dt, const struct string *string)
{
    enum { MAX = 1000 };
    static double k1[MAX][2], k2[MAX][2], gx[MAX][2], gv[MAX][2];
    slopes(x, v, string, k1);
    for (int i = 0; i < string->count; i++)
        for (int c = 0; c < 2; c++) {
            gx[i][c] = x[i][c] + dt * v[i][c];
            gv[i][c] = v[i][c] + dt * k1[i][c];
        }
    slopes(gx, gv, string, k2);
    for (int i = 0; i < string->count; i++)
        for (int c = 0; c < 2; c++) {
            x[i][c] += 0.5 * dt * (v[i][c] + gv[i][c]);
            v[i][c] += 0.5 * dt * (k1[i][c] + k2[i][c]);
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
