import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The plane as complex numbers; the recursion goes down the string."""
    z = [complex(*p) for p in x]

    def tension(i):
        if i >= len(z):
            return 0j
        gap = z[i] - (z[i - 1] if i else complex(*string.anchor))
        return string.stiffness[i] * (abs(gap) - string.rest_lengths[i]) * gap / abs(gap)

    total = [tension(i + 1) - tension(i) - 1j * m * string.gravity for i, m in enumerate(string.masses)]
    return np.array([[f.real, f.imag] for f in total]) - string.drag * np.asarray(v)
