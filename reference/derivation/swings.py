"""Small swings of one rod, for steppers to which springs are rods: along a line nothing of theirs moves.

A mass hangs on a rod of length L under gravity g, turned by q or turning at q'. A step of small swings multiplies
(q, h q') by a matrix, as one of an oscillator does, with a = h^2 g/L in place of h^2 k/m and d = h Cd/m. A step is odd
in the angle: of two amplitudes the cubic part is taken away, and what is left of the fifth is below rounding.
"""

from __future__ import annotations

from itertools import product

import numpy as np

from reference.derivation.fit import Samples
from reference.derivation.oscillators import DT, Run, Runs, end_of, row_of
from reference.state import Array
from reference.system import MassSpringSystem

#: The amplitude [rad]; how far the matrices are off: of rounding over it, and of its fourth power.
ANGLE, NOISE = 2.0**-10, 2e-11

#: To so many decimals coefficients are certain.
CERTAIN = 10

#: What springs are that are rods, where a stiffness is asked for [N/m]; and in how many steps it would show.
STIFF, STEPS = 1e4, 4


def swing(a: float, d: float, angle: float, rate: float, dt: float = DT, stiffness: float = STIFF) -> MassSpringSystem:
    """A mass of 1 kg on a rod of 1 m, at an angle from straight down [rad], turning at a rate [rad/s]."""
    return MassSpringSystem(
        positions=np.array([[0.0, 0.0], [np.sin(angle), -np.cos(angle)]]),
        velocities=np.array([[0.0, 0.0], [rate * np.cos(angle), rate * np.sin(angle)]]),
        springs=np.array([[0, 1]]),
        masses=np.array([1.0, 1.0]),
        rest_lengths=np.array([1.0]),
        stiffness=np.array([stiffness]),
        drag=d / dt,
        gravity=np.array([0.0, -a / dt**2]),
        fixed=np.array([True, False]),
    )


def swing_matrices(runs: Runs, at: Samples, dt: float = DT) -> Array:
    """Step matrices of small swings, shape (n, 2, 2).

    Raises:
        Unsupported: where the stepper cannot step a rod, with its reason.
    """
    begun = [
        (a, d, times * angle, times * rate)
        for times, (angle, rate) in product((1, 2), ((ANGLE, 0.0), (0.0, ANGLE / dt)))
        for a, d in zip(at.a.tolist(), at.d.tolist(), strict=True)
    ]
    ends = [end_of(outcome) for outcome in runs([Run(swing(*each, dt), dt) for each in begun])]
    angles = np.array([np.arctan2(x[1, 0], -x[1, 1]) for x, _ in ends])
    across = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    rates = (np.array([v[1] for _, v in ends]) * across).sum(axis=1)
    moved = np.stack([angles, dt * rates], axis=1).reshape(2, 2, len(at.a), 2) / ANGLE
    return np.asarray(((8 * moved[0] - moved[1]) / 6).transpose(1, 2, 0))


def are_rods(runs: Runs) -> bool:
    """Whether a swing does not depend on a stiffness, as it does on springs from the second step on."""
    begun = [swing(0.5, 0.0, ANGLE, ANGLE / DT, stiffness=times * STIFF) for times in (1, 4)]
    (one, _), (other, _) = (row_of(outcome, STEPS) for outcome in runs([Run(system, DT, STEPS) for system in begun]))
    return bool(np.abs(one - other).max() < NOISE * ANGLE)
