/* springlab.h: what makes a C file a stepper. Write
 *
 *     void step(double *y, int n, double t, double dt)
 *
 * y has n numbers: y[0] to y[n/2 - 1] are the positions of all masses [m], one after another, each with all its axes;
 * y[n/2] to y[n - 1] are their velocities [m/s]. Leave the state after dt [s] in y. For slopes, at any y and t, call
 *
 *     slope(y, t, dydt)
 *
 * which fills dydt with n numbers: velocities, then accelerations. Masses that are held have none of either.
 */
void (*slope)(const double *y, double t, double *dydt);
void step(double *y, int n, double t, double dt);
