/* Exercise 4: a string by Heun's step, the whole state at once. Build me: cc -Wall -o whole_state whole_state.c -lm */
#define EXERCISE 4
#include "exercise.h"
#include <stdio.h>
#include <stdlib.h>

/* state s: 2n numbers of position, then 2n of velocity; out: how fast each changes */
static void rates(const double *s, double *out, const struct string *p)
{
    int n = p->count;
    const double *w = s + 2 * n;
    double *acc = out + 2 * n;

    for (int j = 0; j < 2 * n; j++) {
        out[j] = w[j];
        acc[j] = -p->drag * w[j] / p->masses[j / 2] - (j % 2) * p->gravity;
    }
    for (int i = 0; i < n; i++) {
        const double *top = i ? s + 2 * (i - 1) : p->anchor;
        double d[2] = {s[2 * i] - top[0], s[2 * i + 1] - top[1]};
        double l = hypot(d[0], d[1]), t = p->stiffness[i] * (l - p->rest_lengths[i]) / l;
        for (int j = 0; j < 2; j++) {
            acc[2 * i + j] -= t * d[j] / p->masses[i];
            if (i)
                acc[2 * (i - 1) + j] += t * d[j] / p->masses[i - 1];
        }
    }
}

/* From positions x [m] and velocities v [m/s], those after dt [s]. */
void step(double x[][2], double v[][2], double dt, const struct string *string)
{
    int half = 2 * string->count, all = 2 * half;
    double *s = malloc(4 * all * sizeof *s), *guess = s + all, *k1 = guess + all, *k2 = k1 + all;

    for (int j = 0; j < half; j++) {
        s[j] = x[j / 2][j % 2];
        s[half + j] = v[j / 2][j % 2];
    }
    rates(s, k1, string);
    for (int j = 0; j < all; j++)
        guess[j] = s[j] + dt * k1[j];
    rates(guess, k2, string);
    for (int j = 0; j < half; j++) {
        x[j / 2][j % 2] += dt / 2 * (k1[j] + k2[j]);
        v[j / 2][j % 2] += dt / 2 * (k1[half + j] + k2[half + j]);
    }
    free(s);
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
