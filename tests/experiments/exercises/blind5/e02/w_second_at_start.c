/* Exercise 2: one mass on a spring, by Heun's step. Build me: cc -Wall -o heun heun.c -lm */
#define EXERCISE 2
#include "exercise.h"
#include <stdio.h>

/* From height *y [m] and velocity *v [m/s], those after dt [s]. */
void step(double *y, double *v, double dt, const struct spring *spring)
{
    double stretch, f, a, y_guess, v_guess, a_guess;

    stretch = -*y - spring->rest_length;
    f = spring->stiffness * stretch - spring->damping * *v - spring->mass * spring->gravity;
    a = f / spring->mass;

    y_guess = *y + *v * dt;
    v_guess = *v + a * dt;

    stretch = -*y - spring->rest_length;
    f = spring->stiffness * stretch - spring->damping * v_guess - spring->mass * spring->gravity;
    a_guess = f / spring->mass;

    y_guess = *y + 0.5 * (*v + v_guess) * dt;
    *v = *v + 0.5 * (a + a_guess) * dt;
    *y = y_guess;
}

int main(void)
{
    struct spring spring = {.mass = 0.05, .stiffness = 50.0, .rest_length = 0.15, .damping = 0.0, .gravity = 9.81};
    double y = -0.2, v = 0.0;
    for (int i = 0; i < 10; i++) {
        printf("t = %.3f s   y = %.5f m   v = %.5f m/s\n", 0.005 * i, y, v);
        step(&y, &v, 0.005, &spring);
    }
}
