"""What follows from a step matrix: stability, order, symplectic, reversible, period and damping, what is implicit."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import factorial

import numpy as np

from reference.bisection import bisect
from reference.derivation.formula import ONE, Formula, Monomial, Terms, weight
from reference.derivation.step_matrix import StepMatrix
from reference.state import Array
from reference.system import BoolArray

#: Jury's conditions may be missed by so much; the steps h w, h c/m at which it is looked at, and beyond which nothing
#: is looked for.
ROUNDING, STEP, FAR = 1e-11, 0.005, 1e4

#: The highest order that is looked for.
HIGHEST = 8

#: Angles of a rotation in a step at which a numerical period is told.
ANGLES = (0.1, 0.5, 1.0)

#: Intervals of a step, rising, in which nothing grows: the first from 0.
Windows = tuple[tuple[float, float], ...]

#: A power series in a, b and d, as far as it is kept.
Series = dict[Monomial, float]

#: Where two numbers are the same but for rounding of formulas whose coefficients are no fractions.
SAME = 1e-11


@dataclass(frozen=True)
class Consequences:
    """Of a step matrix.

    Attributes:
        imaginary_axis: in which intervals of h w an undamped oscillator does not grow.
        real_axis: in which intervals of h c/m a damped mass without stiffness does not; of h Cd/m, where only that is
            known; None where neither is.
        order: up to which power of h the matrix is the exact one, with the damping and drag it was seen with.
        undamped_order: the same without.
        symplectic: whether its determinant is 1 without damping and drag.
        reversible: whether a step back, with -h, undoes it there.
        implicit: what is divided by: any of stiffness, damping, drag.
        periods: at some h w, the numerical period over the true one, and by what amplitudes are multiplied in a period;
            only where it is stable.
    """

    imaginary_axis: Windows
    real_axis: Windows | None
    order: int
    undamped_order: int
    symplectic: bool
    reversible: bool
    implicit: tuple[str, ...]
    periods: tuple[tuple[float, float, float], ...]


def consequences(matrix: StepMatrix) -> Consequences:
    """All of it."""
    a = np.linspace(0.05, 2, 40)
    undamped = matrix.at(a, 0 * a, 0 * a)
    determinant = np.linalg.det(undamped)
    symplectic = bool(np.abs(determinant - 1).max() < SAME)
    reversible = symplectic and bool(np.abs(undamped[:, 0, 0] - undamped[:, 1, 1]).max() < SAME)
    real = None
    if matrix.damped or matrix.dragged:
        real = windows(lambda s: by_jury(matrix.at(0 * s, s * matrix.damped, s * (not matrix.damped))))
    letters = {"stiffness": "a", "damping": "b", "drag": "d"}
    implicit = tuple(w for w, letter in letters.items() if any(e.divided_by(letter) for e in matrix.entries))
    imaginary = windows(lambda s: by_jury(matrix.at(s**2, 0 * s, 0 * s)))
    return Consequences(
        imaginary,
        real,
        order_of(matrix, matrix.damped, matrix.dragged),
        order_of(matrix, False, False),
        symplectic,
        reversible,
        implicit,
        tuple(_periods(matrix, imaginary[0][1])),
    )


def windows(stable: Callable[[Array], BoolArray]) -> Windows:
    """The intervals of s from 0 to FAR in which a step does not grow; to FAR means without limit.

    Args:
        stable: at which s it does not, shape (n,).
    """
    at = np.concatenate([np.arange(20 * STEP, 40, STEP), np.geomspace(40, FAR, 4000)])
    inside = stable(at)
    found: list[tuple[float, float]] = []
    begin = 0.0 if inside[0] else None
    for i in range(1, len(at)):
        if inside[i] != inside[i - 1]:
            before = bool(inside[i - 1])
            turned = lambda s, before=before: bool(stable(np.array([s]))[0]) != before  # noqa: E731
            edge = bisect(turned, float(at[i - 1]), float(at[i]), lambda low, high: high - low < 1e-12 * high)[1]
            if begin is not None:
                found.append((begin, edge))
            begin = edge if inside[i] else None
    if begin is not None:
        found.append((begin, FAR))
    return tuple(found) if found and found[0][0] == 0 else ((0.0, 0.0), *found)


def by_jury(m: Array) -> BoolArray:
    """Which matrices, shape (n, 2, 2), let nothing grow.

    Both eigenvalues are within the unit circle where D <= 1 and |T| <= 1 + D, of its trace and determinant (Jury 1964).
    """
    trace, determinant = m[:, 0, 0] + m[:, 1, 1], m[:, 0, 0] * m[:, 1, 1] - m[:, 0, 1] * m[:, 1, 0]
    rounding = ROUNDING * (1 + np.abs(trace) + np.abs(determinant))
    return np.asarray((determinant <= 1 + rounding) & (np.abs(trace) <= 1 + determinant + rounding))


def order_of(matrix: StepMatrix, damped: bool, dragged: bool) -> int:
    """The order on the oscillator: M - exp(A) begins with h^(p+1), with A = [[0, 1], [-a, -b - d]].

    In (x, h v) an entry of the second column is a power of h less, and one of the second row a power more.
    """
    kept = (1, int(damped), int(dragged))
    exact = _exponential(HIGHEST + 2)
    powers = [
        _first_difference(matrix.entries[2 * i + j], exact[i][j], kept) + j - i for i in range(2) for j in range(2)
    ]
    return max(0, min(powers) - 1)


def _first_difference(formula: Formula, exact: Series, kept: tuple[int, int, int]) -> int:
    """The lowest power of h in which a formula is not the exact series; HIGHEST + 2 where it is as far as is looked."""
    most = HIGHEST + 2
    left = _sum(
        _expanded(formula.numerator, most),
        {m: -c for m, c in _times(_expanded(formula.denominator, most), exact, most).items()},
    )
    there = (m for m, c in left.items() if abs(c) > SAME and all(k or not n for k, n in zip(kept, m, strict=False)))
    return min((weight(m) for m in there), default=most)


def _expanded(terms: Terms, most: int) -> Series:
    """Polynomials with exponentials as truncated power series."""
    total: Series = {}
    for m, c in terms.items():
        series: Series = {(m[0], m[1], m[2], 0, 0): float(c)}
        for i, n in ((1, m[3]), (2, m[4])):
            if n:
                decay = {(0, k * (i == 1), k * (i == 2), 0, 0): (-n) ** k / factorial(k) for k in range(most + 1)}
                series = _times(series, decay, most)
        for monomial, value in series.items():
            total[monomial] = total.get(monomial, 0.0) + value
    return total


def _times(one: Series, other: Series, most: int) -> Series:
    product: Series = {}
    for m, c in one.items():
        for n, e in other.items():
            both = (m[0] + n[0], m[1] + n[1], m[2] + n[2], 0, 0)
            if weight(both) <= most:
                product[both] = product.get(both, 0.0) + c * e
    return product


def _exponential(most: int) -> list[list[Series]]:
    """exp(A) of A = [[0, 1], [-a, -b - d]], its entries as power series up to a power of h and one more."""
    a, b, d = ((1, 0, 0, 0, 0), (0, 1, 0, 0, 0), (0, 0, 1, 0, 0))
    matrix: list[list[Series]] = [[{}, {ONE: 1.0}], [{a: -1.0}, {b: -1.0, d: -1.0}]]
    power: list[list[Series]] = [[{ONE: 1.0}, {}], [{}, {ONE: 1.0}]]
    total: list[list[Series]] = [[dict(e) for e in row] for row in power]
    for k in range(1, most + 3):
        power = [
            [_sum(_times(power[i][0], matrix[0][j], most), _times(power[i][1], matrix[1][j], most)) for j in range(2)]
            for i in range(2)
        ]
        for i in range(2):
            for j in range(2):
                total[i][j] = _sum(total[i][j], {m: c / factorial(k) for m, c in power[i][j].items()})
    return total


def _sum(one: Series, other: Series) -> Series:
    return {m: one.get(m, 0.0) + other.get(m, 0.0) for m in {**one, **other}}


def _periods(matrix: StepMatrix, below: float) -> Iterator[tuple[float, float, float]]:
    """At some h w: the numerical period over the true one, and what a period multiplies amplitudes by."""
    for s in ANGLES:
        m = matrix.at(np.array([s**2]), np.zeros(1), np.zeros(1))[0]
        value = max(np.linalg.eigvals(m), key=np.imag)  # of the pair the one that turns forwards
        angle = float(np.angle(value))
        if s < below and value.imag:
            yield s, s / angle, float(abs(value) ** (2 * np.pi / angle))
