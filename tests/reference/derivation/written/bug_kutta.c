#include "springlab.h"

void step(double *y, int n, double t, double dt)
{
    double k1[n], k2[n], k3[n], w[n];
    slope(y, t, k1);
    for (int i = 0; i < n; i++) w[i] = y[i] + dt / 2 * k1[i];
    slope(w, t + dt / 2, k2);
    for (int i = 0; i < n; i++) w[i] = y[i] + dt * (2 * k2[i] + k1[i]);
    slope(w, t + dt, k3);
    for (int i = 0; i < n; i++) y[i] += dt / 6 * (k1[i] + 4 * k2[i] + k3[i]);
}
