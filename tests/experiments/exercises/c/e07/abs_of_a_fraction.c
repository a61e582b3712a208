#define EXERCISE 7
#include "exercise.h"
#include <stdlib.h>

void push_out(int count, double x[][2], double v[][2], const struct circle *circle)
{
    for (int i = 0; i < count; i++) {
        double dx = x[i][0] - circle->centre[0], dy = x[i][1] - circle->centre[1];
        if (abs(dx) < circle->radius && abs(dy) < circle->radius) {
            double r = sqrt(dx * dx + dy * dy), s = (v[i][0] * dx + v[i][1] * dy) / r;
            x[i][0] = circle->centre[0] + circle->radius * dx / r;
            x[i][1] = circle->centre[1] + circle->radius * dy / r;
            if (s < 0) {
                v[i][0] -= s * dx / r;
                v[i][1] -= s * dy / r;
            }
        }
    }
}
