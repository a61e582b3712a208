/* Exercise 7: the barrier. Build me: cc -Wall -o barrier barrier.c -lm */
#define EXERCISE 7
#include "exercise.h"
#include <stdio.h>

void push_out(int count, double x[][2], double v[][2], const struct circle *circle)
{
    for (int i = 0; i < count; i++) {
        double dx = x[i][0] - circle->centre[0];
        double dy = x[i][1] - circle->centre[1];
        double r = hypot(dx, dy);

        if (r >= circle->radius)
            break;

        double nx = dx / r, ny = dy / r;
        double vn = v[i][0] * nx + v[i][1] * ny;
        if (vn < 0) {
            v[i][0] -= vn * nx;
            v[i][1] -= vn * ny;
        }
        x[i][0] += (circle->radius - r) * nx;
        x[i][1] += (circle->radius - r) * ny;
    }
}

int main(void)
{
    struct circle circle = {.centre = {0.5, 0.0}, .radius = 0.3};
    double x[3][2] = {{0.5, 0.25}, {0.3, 0.0}, {0.0, 0.0}}, v[3][2] = {{0.5, -1.0}, {0.5, -1.0}, {0.5, -1.0}};
    push_out(3, x, v, &circle);
    for (int i = 0; i < 3; i++)
        printf("(%.5f, %.5f) m   (%.5f, %.5f) m/s\n", x[i][0], x[i][1], v[i][0], v[i][1]);
}
