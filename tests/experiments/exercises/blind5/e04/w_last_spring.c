/* Exercise 4: a string by Heun's step, the whole state at once. Build me: cc -Wall -o whole_state whole_state.c -lm */
#define EXERCISE 4
#include "exercise.h"
#include <stdio.h>
#include <stdlib.h>

static void get_acceleration(double x[][2], double v[][2], const struct string *string, double a[][2])
{
    const int n = string->count;
    double (*pull)[2] = malloc(n * sizeof *pull);

    /* how each spring pulls its lower mass up */
    for (int i = 0; i < n; i++) {
        double dx, dy;
        if (i == 0) {
            dx = string->anchor[0] - x[0][0];
            dy = string->anchor[1] - x[0][1];
        } else {
            dx = x[i - 1][0] - x[i][0];
            dy = x[i - 1][1] - x[i][1];
        }
        double len = sqrt(dx * dx + dy * dy);
        double size = string->stiffness[i] * (len - string->rest_lengths[i]);
        pull[i][0] = size * dx / len;
        pull[i][1] = size * dy / len;
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < 2; j++)
            a[i][j] = (pull[i][j] - string->drag * v[i][j]) / string->masses[i];
    for (int i = 0; i < n - 2; i++)
        for (int j = 0; j < 2; j++)
            a[i][j] -= pull[i + 1][j] / string->masses[i];
    for (int i = 0; i < n; i++)
        a[i][1] -= string->gravity;
    free(pull);
}

/* From positions x [m] and velocities v [m/s], those after dt [s]. */
void step(double x[][2], double v[][2], double dt, const struct string *string)
{
    int n = string->count;
    double a1[n][2], a2[n][2], xg[n][2], vg[n][2];
    get_acceleration(x, v, string, a1);
    for (int i = 0; i < n; i++) {
        xg[i][0] = x[i][0] + dt * v[i][0];
        xg[i][1] = x[i][1] + dt * v[i][1];
        vg[i][0] = v[i][0] + dt * a1[i][0];
        vg[i][1] = v[i][1] + dt * a1[i][1];
    }
    get_acceleration(xg, vg, string, a2);
    for (int i = 0; i < n; i++) {
        x[i][0] += dt * (v[i][0] + vg[i][0]) / 2;
        x[i][1] += dt * (v[i][1] + vg[i][1]) / 2;
        v[i][0] += dt * (a1[i][0] + a2[i][0]) / 2;
        v[i][1] += dt * (a1[i][1] + a2[i][1]) / 2;
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
