#define EXERCISE 7
#include "exercise.h"

void push_out(int count, double x[][2], double v[][2], const struct circle *circle)
{
    for (int i = 0; i < count; i++) {
        double dx = x[i][0] - circle->centre[0], dy = x[i][1] - circle->centre[1];
        double distance = hypot(dx, dy);
        if (distance >= circle->radius)
            continue;
        double nx = dx / distance, ny = dy / distance;
        x[i][0] = circle->centre[0] + circle->radius * nx;
        x[i][1] = circle->centre[1] + circle->radius * ny;
        double inwards = v[i][0] * nx + v[i][1] * ny;
        if (inwards < 0) {
            v[i][0] -= inwards * nx;
            v[i][1] -= inwards * ny;
        }
    }
}
