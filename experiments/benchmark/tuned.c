/* The anchor for speed: Heun on a string and on any mesh in 2D or 3D, by hand, as a C programmer would who has time.
 *
 * Tuned: one array per axis, no two of them overlapping (restrict), every spring computed once, a string's ends peeled
 * off the loop, sqrt without errno. Compiled by experiments/tuned.py with the system's compiler:
 *     cc -O3 -march=native -fno-math-errno -DAXES=2 -shared -fPIC tuned.c -lm
 */
#include <math.h>
#include <stdint.h>

/* Per axis: statements, parameters that are read or written, and the arrays to pass for them. Names end in the axis. */
#if AXES == 2
#define EACH(DO) DO(0) DO(1)
#define READ(q) const double *restrict q##0, const double *restrict q##1
#define WRITE(q) double *restrict q##0, double *restrict q##1
#define PASS(q) q[0], q[1]
#else
#define EACH(DO) DO(0) DO(1) DO(2)
#define READ(q) const double *restrict q##0, const double *restrict q##1, const double *restrict q##2
#define WRITE(q) double *restrict q##0, double *restrict q##1, double *restrict q##2
#define PASS(q) q[0], q[1], q[2]
#endif

typedef const double *restrict in;
typedef const uint32_t *restrict list;

/* Spring j between masses p and q: its force on p, along each axis. */
#define SEPARATION(a) double separation##a = x##a[q] - x##a[p]; squares += separation##a * separation##a;
#define RATE(a) separation##a /= length; rate += separation##a * (v##a[q] - v##a[p]);
#define FORCE(a) forces##a[j] = separation##a * force;
#define SPRING                                                                        \
    double squares = 0, rate = 0;                                                     \
    EACH(SEPARATION)                                                                         \
    double length = sqrt(squares);                                                    \
    EACH(RATE)                                                                        \
    double force = stiffness[j] * (length - rest[j]) + damping[j] * rate;             \
    EACH(FORCE)

/* Heun's two halves for mass i, once the sum of its springs' forces is known along each axis. */
#define GUESS_AXIS(a)                                                                 \
    { double acceleration = (sum##a - drag * v##a[i]) / mass[i];                      \
      first##a[i] = acceleration;                                                     \
      gx##a[i] = x##a[i] + dt * v##a[i];                                              \
      gv##a[i] = v##a[i] + dt * acceleration; }
#define MOVE_AXIS(a)                                                                  \
    { double acceleration = (sum##a - drag * gv##a[i]) / mass[i];                     \
      x##a[i] += dt / 2 * (v##a[i] + gv##a[i]);                                       \
      v##a[i] += dt / 2 * (first##a[i] + acceleration); }

#define WEIGHT(a) double sum##a = mass[i] * gravity[a];
#define ABOVE(a) sum##a -= forces##a[i - 1];
#define BELOW(a) sum##a += forces##a[i];
#define LISTED(a) sum##a += sign[e] * forces##a[spring[e]];

#define STRING_MASSES(DO)                                                             \
    for (int64_t i = 1; i < n - 1; i++) { EACH(WEIGHT) EACH(ABOVE) EACH(BELOW) EACH(DO) } \
    { int64_t i = n - 1; EACH(WEIGHT) EACH(ABOVE) EACH(DO) }
#define MESH_MASSES(DO)                                                               \
    for (int64_t i = 0; i < n; i++) {                                                 \
        if (fixed[i]) continue;                                                       \
        EACH(WEIGHT)                                                                  \
        for (uint32_t e = begin[i]; e < begin[i + 1]; e++) { EACH(LISTED) }           \
        EACH(DO)                                                                      \
    }

static void string_springs(READ(x), READ(v), WRITE(forces), in rest, in stiffness, in damping, int64_t springs)
{
    for (int64_t j = 0; j < springs; j++) { int64_t p = j, q = j + 1; SPRING }
}

static void mesh_springs(READ(x), READ(v), WRITE(forces), list first_end, list second_end, in rest, in stiffness,
                         in damping, int64_t springs)
{
    for (int64_t j = 0; j < springs; j++) { uint32_t p = first_end[j], q = second_end[j]; SPRING }
}

static void string_guess(READ(x), READ(v), WRITE(gx), WRITE(gv), WRITE(first), READ(forces), in mass, in gravity,
                         double drag, double dt, int64_t n)
{
    STRING_MASSES(GUESS_AXIS)
}

static void string_move(WRITE(x), WRITE(v), READ(gv), READ(first), READ(forces), in mass, in gravity, double drag,
                        double dt, int64_t n)
{
    STRING_MASSES(MOVE_AXIS)
}

static void mesh_guess(READ(x), READ(v), WRITE(gx), WRITE(gv), WRITE(first), READ(forces), list begin, list spring,
                       in sign, const uint8_t *restrict fixed, in mass, in gravity, double drag, double dt, int64_t n)
{
    MESH_MASSES(GUESS_AXIS)
}

static void mesh_move(WRITE(x), WRITE(v), READ(gv), READ(first), READ(forces), list begin, list spring, in sign,
                      const uint8_t *restrict fixed, in mass, in gravity, double drag, double dt, int64_t n)
{
    MESH_MASSES(MOVE_AXIS)
}

/* A string of n masses, the first of them fixed. */
void heun_string(double **x, double **v, double **gx, double **gv, double **first, double **forces, in mass, in rest,
                 in stiffness, in damping, in gravity, double drag, double dt, int64_t n, int64_t steps)
{
    for (int64_t step = 0; step < steps; step++) {
        string_springs(PASS(x), PASS(v), PASS(forces), rest, stiffness, damping, n - 1);
        string_guess(PASS(x), PASS(v), PASS(gx), PASS(gv), PASS(first), PASS(forces), mass, gravity, drag, dt, n);
        string_springs(PASS(gx), PASS(gv), PASS(forces), rest, stiffness, damping, n - 1);
        string_move(PASS(x), PASS(v), PASS(gv), PASS(first), PASS(forces), mass, gravity, drag, dt, n);
    }
}

/* Any mesh: springs by lists of their ends, masses by lists of their springs. */
void heun_mesh(double **x, double **v, double **gx, double **gv, double **first, double **forces, in mass, in rest,
               in stiffness, in damping, in gravity, double drag, double dt, int64_t n, int64_t steps,
               list first_end, list second_end, list begin, list spring, in sign, const uint8_t *restrict fixed,
               int64_t springs)
{
    for (int64_t step = 0; step < steps; step++) {
        mesh_springs(PASS(x), PASS(v), PASS(forces), first_end, second_end, rest, stiffness, damping, springs);
        mesh_guess(PASS(x), PASS(v), PASS(gx), PASS(gv), PASS(first), PASS(forces), begin, spring, sign, fixed, mass,
                   gravity, drag, dt, n);
        mesh_springs(PASS(gx), PASS(gv), PASS(forces), first_end, second_end, rest, stiffness, damping, springs);
        mesh_move(PASS(x), PASS(v), PASS(gv), PASS(first), PASS(forces), begin, spring, sign, fixed, mass, gravity,
                  drag, dt, n);
    }
}
