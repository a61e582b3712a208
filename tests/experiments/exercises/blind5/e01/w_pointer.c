/* Exercise 1: one mass on a spring, by Euler's step. Build me: cc -Wall -o euler euler.c -lm */
#define EXERCISE 1
#include "exercise.h"
#include <stdio.h>

/* From height *y [m] and velocity *v [m/s], those after dt [s]. */
void step(double *y, double *v, double dt, const struct spring *spring)
{
    double up = spring->stiffness * (-*y - spring->rest_length);
    double down = spring->mass * spring->gravity + spring->damping * *v;
    double y_new = *y + dt * *v;
    double v_new = *v + dt * (up - down) / spring->mass;
    *y = y_new;
    v = &v_new;
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
