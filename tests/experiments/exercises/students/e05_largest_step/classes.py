import math

EXERCISE = 5
SEED = "example"


class Oscillator:
    mass = 0.026
    stiffness = 474.8
    damping = 0.229
    masses = 3

    @property
    def omega(self):
        return math.sqrt(self.stiffness / self.mass)

    @property
    def decay(self):
        return self.damping / self.mass

    def mode(self, j):
        return 2 * self.omega * math.sin((2 * j - 1) * math.pi / (4 * self.masses + 2))

    def modes(self):
        return [self.mode(j) for j in range(1, self.masses + 1)]


me = Oscillator()
IMAGINARY_AXIS = {"kick_drift": 2.0, "runge_kutta": 8**0.5}


def kick_drift():
    return IMAGINARY_AXIS["kick_drift"] / me.omega


def runge_kutta():
    return IMAGINARY_AXIS["runge_kutta"] / me.omega


def euler():
    return me.decay / me.omega**2


def string():
    return IMAGINARY_AXIS["kick_drift"] / max(me.modes())
