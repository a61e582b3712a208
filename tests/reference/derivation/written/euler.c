#include "springlab.h"

void step(double *y, int n, double t, double dt)
{
    double k[n];
    slope(y, t, k);
    for (int i = 0; i < n; i++)
        y[i] = y[i] + dt * k[i];
}
