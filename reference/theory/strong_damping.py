"""Limits beyond steps in which some damping or drag drowns all else: there springs are as rods, and masses are held.

Where a step takes damping by e^(h c/m), a spring with h c/m > DROWNED holds its two masses together as a rod does, to
all digits that there are; where it takes drag by e^(h Cd/m), a mass with h Cd/m > DROWNED is as good as held. What is
left is S(h) of the other masses, on moves that change no such spring's length. Looked at dt by dt, each a little longer
than the last; of small systems.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from reference.bisection import bisect
from reference.schemes.implicit_damping import effective_masses
from reference.state import Array
from reference.system import BoolArray, MassSpringSystem
from reference.theory.definite import DENSE_UP_TO, Definiteness

#: Where h c/m of a spring, or h Cd/m of a mass, is larger, e to that power leaves few of the other digits.
DROWNED = 18.0

#: Each dt looked at is so many times the one before, up to so many times the first; precision of a limit.
RATIO, FAR, PRECISION = 1.02, 1e4, 1e-9

#: And at least up to so many times the slowest swing's 1/w.
SLOWEST = 30.0


def drowned_from(definite: Definiteness) -> float:
    """The dt [s] from which on a spring is as a rod, or a mass as good as held; infinite if none ever is."""
    system = definite.linear.system
    fastest = 0.0
    if definite.springs_grow:
        fastest = float((system.damping / effective_masses(system)).max(initial=0.0))
    if definite.drag_grows:
        fastest = max(fastest, float((system.drag / system.masses[~system.fixed]).max(initial=0.0)))
    return DROWNED / fastest if fastest else np.inf


def limit_with_rods(definite: Definiteness, dt: float) -> float | None:
    """The first dt [s] above one at which a step is unstable; infinite if none is found, None of large systems."""
    if len(definite.linear.mass) > DENSE_UP_TO:
        return None
    last = max(FAR * dt, SLOWEST / _slowest(definite))

    def unstable(at: float) -> bool:
        return _negative(definite, at)

    while not unstable(RATIO * dt):
        dt *= RATIO
        if dt > last:
            return np.inf
    low, high = bisect(unstable, dt, RATIO * dt, lambda low, high: high - low <= PRECISION * low)
    return (low + high) / 2


def _negative(definite: Definiteness, dt: float) -> bool:
    """Whether S has a negative eigenvalue on the moves of masses that are not held which change no rod's length."""
    system = definite.linear.system
    held = ~system.fixed & (dt * system.drag > DROWNED * system.masses)
    if definite.drag_grows and held.any():
        if (held | system.fixed).all():
            return False
        definite = definite.with_system(_holding(system, held))
    linear, system = definite.linear, definite.linear.system
    rods = definite.springs_grow & (dt * system.damping > DROWNED * effective_masses(system))
    moves = _without_change(linear.scaled(linear.along_springs(rods.astype(float))).toarray())
    if not moves.shape[1]:
        return False
    gentle = system.with_parameter("damping", np.where(rods, 0.0, system.damping).tolist())
    matrix = definite.with_system(gentle).matrix(dt)
    return bool(np.linalg.eigvalsh(moves.T @ matrix @ moves)[0] < 0)


def _slowest(definite: Definiteness) -> float:
    """The lowest w [1/s] of what springs bring back; infinite where there is none."""
    squares = np.linalg.eigvalsh(definite.linear.scaled_stiffness.toarray())
    swings = squares[squares > 1e-10 * squares[-1]]
    return float(np.sqrt(swings[0])) if len(swings) else np.inf


def _holding(system: MassSpringSystem, held: BoolArray) -> MassSpringSystem:
    """The system with these masses fixed; fixed masses, whose drag nobody feels, as heavy as others."""
    fixed = system.fixed | held
    return replace(system, fixed=fixed, masses=np.where(fixed, system.masses.max(), system.masses))


def _without_change(rods: Array) -> Array:
    """An orthonormal basis of the moves that a sum of squares of length changes does not see, as columns."""
    values, vectors = np.linalg.eigh(rods)
    return np.asarray(vectors[:, values <= 1e-10 * max(values.max(initial=0.0), 1e-300)])
