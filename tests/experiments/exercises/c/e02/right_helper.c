#define EXERCISE 2
#include "exercise.h"

static void slope(const double state[2], const struct spring *s, double out[2])
{
    out[0] = state[1];
    out[1] = (s->stiffness * (-state[0] - s->rest_length) - s->damping * state[1]) / s->mass - s->gravity;
}

void step(double *y, double *v, double dt, const struct spring *spring)
{
    double state[2] = {*y, *v}, guess[2], first[2], second[2];
    slope(state, spring, first);
    for (int i = 0; i < 2; i++)
        guess[i] = state[i] + dt * first[i];
    slope(guess, spring, second);
    *y = state[0] + dt * 0.5 * (first[0] + second[0]);
    *v = state[1] + dt * 0.5 * (first[1] + second[1]);
}
