"""The Butcher tableau of a stepper that only steps, from the forces it takes (`force_jumps`).

An explicit Runge-Kutta method of a(x) takes its forces at c_i h v, with b and beta = b A, moved by A^2 of earlier ones.
Up to five stages these are enough for all of A, where none has both weights zero. What is found is held against every
number that was not used for it, and against the step matrix: a method that is none, as a leapfrog, fails there.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import permutations, product

import numpy as np

from reference.derivation.force_jumps import ASIDE, LENGTH, Taken
from reference.derivation.small_fractions import fraction_or_itself, simplest_within
from reference.derivation.step_matrix import StepMatrix
from reference.derivation.tableau import Tableau
from reference.state import Array

#: The most stages whose tableau is known from that.
MOST = 5

#: Numbers agree within this: what forces add to one another is known to about 1e-7.
AGREE, SAME = 1e-5, 1e-9

#: How near a coefficient is to its fraction, which has to be a simple one; the step matrix is then its to rounding.
OFF = 1e-6

#: The same of five stages, whose last rows are known less well: the simplest fraction is taken there, and has then to
#: give every beta, which are known to EXACT, and the step matrix.
ROUGH, EXACT = 2e-5, 1e-8


def tableau_by_jumps(taken: Sequence[Taken], matrix: StepMatrix) -> Tableau | None:
    """The explicit Runge-Kutta method that takes these forces and has this step matrix; None where there is none.

    Stages at one c may stand in either order: the first that agrees with everything is taken.
    """
    s = len(taken)
    if not 1 <= s <= MOST or taken[0].at != 0:
        return None
    for later in permutations(taken[1:]):
        order = [taken[0], *later]
        a = _filled(order)
        if a is not None and _agrees(order, a):
            tableau = _tableau(order, a)
            if _same_betas(tableau, order) and _same_matrix(tableau, matrix):
                return tableau
    return None


def _filled(order: Sequence[Taken]) -> Array | None:
    """A, of rows that add up to c, from beta = b A and the shift of the third stage."""
    s = len(order)
    c, b, beta = (
        np.array([float(n) for n in row])
        for row in zip(*((t.at, t.in_velocity, t.in_position) for t in order), strict=True)
    )
    a = np.zeros((s, s))
    if s >= 2:
        a[1, 0] = c[1]
    if s == 3:
        if not b[2]:
            return None
        a[2, 1] = beta[1] / b[2]
    if s == 4:
        if not b[3] or not c[1]:
            return None
        a[3, 2] = beta[2] / b[3]
        a[2, 1] = order[2].by_earlier / (c[1] * _forces(c, 2)[0])
        a[3, 1] = (beta[1] - b[2] * a[2, 1]) / b[3]
    if s == 5:
        if not b[4] or not c[1]:
            return None
        a[4, 3] = beta[3] / b[4]
        a[2, 1] = order[2].by_earlier / (c[1] * _forces(c, 2)[0])
        a[3, 1], a[3, 2], a[4, 1], a[4, 2] = _last_two(order, c, b, beta, a[2, 1], a[4, 3])
    for i in range(2, s):
        a[i, 0] = c[i] - a[i].sum()
    return a


def _last_two(order: Sequence[Taken], c: Array, b: Array, beta: Array, a32: float, a54: float) -> Array:
    """a42, a43, a52 and a53 of five stages: beta2, beta3 and the shifts of the last two stages are linear in these.

    With F the forces there, the fourth stage is moved by (a42 a21 + a43 a31) F1 + a43 a32 F2, and the fifth by
    (a52 a21 + a53 a31 + a54 a41) F1 + (a53 a32 + a54 a42) F2 + a54 a43 F3.
    """
    a21, a31 = c[1], c[2] - a32
    f, g = _forces(c, 3), _forces(c, 4)
    rows = [
        [b[3], 0.0, b[4], 0.0],
        [0.0, b[3], 0.0, b[4]],
        [a21 * f[0], a31 * f[0] + a32 * f[1], 0.0, 0.0],
        [a54 * (g[1] - g[0]), a54 * (g[2] - g[0]), a21 * g[0], a31 * g[0] + a32 * g[1]],
    ]
    sides = [
        beta[1] - b[2] * a32,
        beta[2],
        order[3].by_earlier,
        order[4].by_earlier - a54 * c[3] * g[0],
    ]
    return np.asarray(np.linalg.lstsq(np.array(rows), np.array(sides), rcond=None)[0])


def _forces(c: Array, i: int) -> Array:
    """Of each stage, in units of k L, when stage i is at the spring's other end."""
    x = ASIDE * (c / c[i] - 1)
    return np.asarray(np.sign(x) - x / LENGTH)


def _agrees(order: Sequence[Taken], a: Array) -> bool:
    """Whether A gives every beta and every shift."""
    c, b = np.array([float(t.at) for t in order]), np.array([float(t.in_velocity) for t in order])
    beta = np.array([float(t.in_position) for t in order])
    squared = a @ a
    shifts = [squared[i] @ _forces(c, i) - order[i].by_earlier for i in range(1, len(c)) if c[i]]
    return bool(np.abs(b @ a - beta).max() < AGREE and max(map(abs, shifts), default=0.0) < AGREE)


def _tableau(order: Sequence[Taken], a: Array) -> Tableau:
    few = len(order) < MOST
    rows = tuple(
        tuple(fraction_or_itself(n, OFF) if few else simplest_within(n, ROUGH) for n in row) for row in a.tolist()
    )
    return Tableau(rows, tuple(t.in_velocity for t in order), tuple(t.at for t in order))


def _same_betas(tableau: Tableau, order: Sequence[Taken]) -> bool:
    """Whether b A is every beta, of numbers that are fractions now."""
    found = np.array(tableau.b, float) @ np.array(tableau.a, float)
    return bool(np.abs(found - np.array([float(taken.in_position) for taken in order])).max() < EXACT)


def _same_matrix(tableau: Tableau, matrix: StepMatrix) -> bool:
    """Whether it makes the same of oscillators, with the kinds of damping that the matrix is known for."""
    cases = product((0.3, 1.1), (0.0, 0.2 * matrix.damped), (0.0, 0.1 * matrix.dragged))
    a, b, d = np.array(list(cases)).T
    return bool(np.abs(tableau.step_matrices(a, b + d) - matrix.at(a, b, d)).max() <= SAME)
