from scipy.optimize import fsolve


def step(f, y, t, dt):
    return fsolve(lambda z: z - y - dt * f(z, t + dt), y + dt * f(y, t), xtol=1e-11)
