EXERCISE = 1


class Body:
    def __init__(self, y, v, s):
        self.y = y
        self.v = v
        self.s = s

    def spring_force(self):
        return -self.s.stiffness * (self.y + self.s.rest_length)

    def weight(self):
        return -self.s.mass * self.s.gravity

    def friction(self):
        return -self.s.damping * self.v

    def acceleration(self):
        return (self.spring_force() + self.weight() + self.friction()) / self.s.mass

    def advance(self, dt):
        dy = self.v * dt
        dv = self.acceleration() * dt
        self.y += dy
        self.v += dv


def step(y, v, dt, spring):
    body = Body(y, v, spring)
    body.advance(dt)
    return body.y, body.v
