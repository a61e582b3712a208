"""Limits beyond steps in which the damping of some springs drowns all else: there they are as rods.

Where a step takes damping by e^(h c/m), a spring with h c/m > DROWNED holds its two masses together as a rod does, to
all digits that there are. What is left is S(h) on moves that change no such spring's length. Looked at dt by dt, each a
little longer than the last; of small systems.
"""

from __future__ import annotations

import numpy as np

from reference.bisection import bisect
from reference.schemes.implicit_damping import effective_masses
from reference.state import Array
from reference.theory.definite import DENSE_UP_TO, Definiteness

#: Where h c/m of a spring is larger, e^(h c/m) leaves few of the other digits.
DROWNED = 18.0

#: Each dt looked at is so many times the one before, up to so many times the first; precision of a limit.
RATIO, FAR, PRECISION = 1.02, 1e4, 1e-9


def drowned_from(definite: Definiteness) -> float:
    """The dt [s] from which on a spring is as a rod; infinite if none is damped."""
    system = definite.linear.system
    fastest = float((system.damping / effective_masses(system)).max(initial=0.0))
    return DROWNED / fastest if fastest else np.inf


def limit_with_rods(definite: Definiteness, dt: float) -> float | None:
    """The first dt [s] above one at which a step is unstable; infinite if none is found, None of large systems."""
    if len(definite.linear.mass) > DENSE_UP_TO:
        return None
    last = FAR * dt

    def unstable(at: float) -> bool:
        return _negative(definite, at)

    while not unstable(RATIO * dt):
        dt *= RATIO
        if dt > last:
            return np.inf
    low, high = bisect(unstable, dt, RATIO * dt, lambda low, high: high - low <= PRECISION * low)
    return (low + high) / 2


def _negative(definite: Definiteness, dt: float) -> bool:
    """Whether S has a negative eigenvalue on the moves that change no rod's length."""
    linear, system = definite.linear, definite.linear.system
    rods = dt * system.damping > DROWNED * effective_masses(system)
    moves = _without_change(linear.scaled(linear.along_springs(rods.astype(float))).toarray())
    if not moves.shape[1]:
        return False
    gentle = system.with_parameter("damping", np.where(rods, 0.0, system.damping).tolist())
    matrix = definite.with_system(gentle).matrix(dt)
    return bool(np.linalg.eigvalsh(moves.T @ matrix @ moves)[0] < 0)


def _without_change(rods: Array) -> Array:
    """An orthonormal basis of the moves that a sum of squares of length changes does not see, as columns."""
    values, vectors = np.linalg.eigh(rods)
    return np.asarray(vectors[:, values <= 1e-10 * max(values.max(initial=0.0), 1e-300)])
