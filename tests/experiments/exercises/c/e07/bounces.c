#define EXERCISE 7
#include "exercise.h"

void push_out(int count, double x[][2], double v[][2], const struct circle *circle)
{
    for (int i = 0; i < count; i++) {
        double d[2] = {x[i][0] - circle->centre[0], x[i][1] - circle->centre[1]};
        double r = sqrt(d[0] * d[0] + d[1] * d[1]);
        double s = (v[i][0] * d[0] + v[i][1] * d[1]) / r;
        for (int k = 0; k < 2 && r < circle->radius; k++) {
            x[i][k] = circle->centre[k] + circle->radius * d[k] / r;
            if (s < 0)
                v[i][k] -= 2 * s * d[k] / r;
        }
    }
}
