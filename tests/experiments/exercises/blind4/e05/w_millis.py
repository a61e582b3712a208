"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

EXERCISE = 5
SEED = "ada"


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 0.0567


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 0.0802


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return 0.585


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    return 0.0315


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
