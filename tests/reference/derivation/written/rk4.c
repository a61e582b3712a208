#include "springlab.h"

static void moved(double *out, const double *y, double h, const double *k, int n)
{
    for (int i = 0; i < n; i++) out[i] = y[i] + h * k[i];
}

void step(double *y, int n, double t, double dt)
{
    double k1[n], k2[n], k3[n], k4[n], w[n];
    slope(y, t, k1);
    moved(w, y, dt / 2, k1, n);
    slope(w, t + dt / 2, k2);
    moved(w, y, dt / 2, k2, n);
    slope(w, t + dt / 2, k3);
    moved(w, y, dt, k3, n);
    slope(w, t + dt, k4);
    for (int i = 0; i < n; i++) y[i] += dt / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
}
