/* Exercise 1: one mass on a spring, by Euler's step. Build me: cc -Wall -o euler euler.c -lm */
#define EXERCISE 1
#include "exercise.h"
#include <stdio.h>
#include <stdlib.h>

/* From height *y [m] and velocity *v [m/s], those after dt [s]. */
void step(double *y, double *v, double dt, const struct spring *spring)
{
    double length = abs(*y);
    double force;
    double acceleration;
    double old_velocity = *v;

    force = spring->stiffness * (length - spring->rest_length);
    force -= spring->mass * spring->gravity;
    force -= spring->damping * old_velocity;
    acceleration = force / spring->mass;

    *v = old_velocity + acceleration * dt;
    *y = *y + old_velocity * dt;
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
