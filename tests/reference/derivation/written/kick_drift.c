#include "springlab.h"

/* y holds positions, then velocities */
void step(double *y, int n, double t, double dt)
{
    double k[n], *x = y, *v = y + n / 2;
    slope(y, t, k);
    for (int i = 0; i < n / 2; i++) {
        v[i] += dt * k[n / 2 + i];
        x[i] += dt * v[i];
    }
}
