from dataclasses import dataclass

EXERCISE = 2


@dataclass
class S:
    y: float
    v: float

    def slope(self, p):
        f = p.stiffness * (-self.y - p.rest_length) - p.mass * p.gravity - p.damping * self.v
        return S(self.v, f / p.mass)

    def plus(self, h, d):
        return S(self.y + h * d.y, self.v + h * d.v)


def step(y, v, dt, spring):
    start = S(y, v)
    first = start.slope(spring)
    guess = start.plus(dt, first)
    second = guess.slope(spring)
    mean = S((first.y + second.y) / 2, (first.v + second.v) / 2)
    end = start.plus(dt, mean)
    return end.y, end.v
