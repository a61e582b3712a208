#define EXERCISE 1
#include "exercise.h"

double step(double y, double v, double dt, struct spring s)
{
    return y + dt * v;
}
