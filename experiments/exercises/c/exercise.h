/* exercise.h: what the functions of exercises 1, 2, 3, 4 and 7 are given in C. In your file stands, before all else,
 *
 *     #define EXERCISE 1
 *     #include "exercise.h"
 *
 * All numbers are in SI units. A position or velocity is two numbers, x[i][0] sideways and x[i][1] upwards. Arrays hold
 * anything until they are written into.
 */
#ifndef EXERCISE_H
#define EXERCISE_H

#include <math.h>

/* Exercises 1 and 2. */
struct spring {
    double mass, stiffness, rest_length, damping, gravity;
};

/* Exercises 3 and 4: count masses, and as many springs. Spring 0 hangs on the anchor. */
struct string {
    int count;
    const double *masses, *stiffness, *rest_lengths;
    double drag, gravity;
    double anchor[2];
};

/* Exercise 7. */
struct circle {
    double centre[2];
    double radius;
};

#if !defined(EXERCISE)
#error "expected a line such as #define EXERCISE 1 before this one"
#elif EXERCISE == 1 || EXERCISE == 2
/* Height *y and velocity *v: leave those after dt in them. */
void step(double *y, double *v, double dt, const struct spring *spring);
#elif EXERCISE == 3
/* Write the force on every mass into f. Leave x and v as they are. */
void forces(double x[][2], double v[][2], const struct string *string, double f[][2]);
#elif EXERCISE == 4
/* Positions x and velocities v of all masses: leave those after dt in them. */
void step(double x[][2], double v[][2], double dt, const struct string *string);
#elif EXERCISE == 7
/* Positions x and velocities v of count masses: leave those after the circle in them. */
void push_out(int count, double x[][2], double v[][2], const struct circle *circle);
#else
#error "of this exercise there is no form in C: expected 1, 2, 3, 4 or 7"
#endif

#endif
