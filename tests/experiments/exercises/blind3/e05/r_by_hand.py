"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

EXERCISE = 5
SEED = "example"

# m = 0.026 kg, k = 474.8 N/m, w = sqrt(k/m) = 135.135 /s


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 0.014800  # 2 / w


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 0.020930  # 2 sqrt(2) / w


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return 4.8231e-4  # c / k, underdamped


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    return 0.0082135  # fastest of 3 modes: 1.80194 w


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
