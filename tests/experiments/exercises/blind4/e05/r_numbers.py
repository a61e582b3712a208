"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

EXERCISE = 5
SEED = "ada"


# w = sqrt(k/m) = 35.28 /s
def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 0.05668  # 2 / w


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 80.16e-3  # sqrt(8) / w


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return 5.846e-4  # c / k, since 4 k m > c^2


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    return 0.03146


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
