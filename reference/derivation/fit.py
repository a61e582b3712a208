"""The rational function of smallest size that values follow to rounding, its coefficients as fractions.

Linear least squares for numerator - value x denominator = 0, the denominator's constant being 1; more and more terms
are allowed until what is left is rounding. What was found is then checked on all values, also those held back.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import product

import numpy as np

from reference.derivation.formula import ONE, Formula, Monomial, Number, evaluated, weight
from reference.derivation.small_fractions import fraction_or_itself
from reference.state import Array

#: What is left of a fit may be so many times the noise.
NOISES = 30

#: How far values are off at most, as so many of their root mean square; and noise up to which decimals tell something.
SCATTERS, FINE = 3, 1e-8

#: A coefficient's uncertainty, as so many of the standard deviations that the fit gives it.
DEVIATIONS = 10

#: The largest powers of h above and below: those of a polynomial, and those of a fraction.
POLYNOMIAL, ABOVE, BELOW = 8, 4, 4


#: The formulas of m11, m12, m21, m22.
Entries = tuple[Formula, Formula, Formula, Formula]


@dataclass(frozen=True, eq=False)
class Samples:
    """Where a step was taken: a, b and d, each shape (n,); every third is held back for the check."""

    a: Array
    b: Array
    d: Array

    def of(self, monomials: Sequence[Monomial]) -> Array:
        """The values of monomials, shape (n, m)."""
        columns = [evaluated(m, self.a, self.b, self.d) for m in monomials]
        return np.stack(columns, axis=1) if columns else np.empty((len(self.a), 0))


def formula_of(samples: Samples, values: Array, noise: float, largest: int = POLYNOMIAL) -> Formula | None:
    """The formula of one entry of a step matrix; None where no small one holds.

    Args:
        values: shape (n,).
        noise: how far these may be off by rounding.
        largest: the largest power of h above.
    """
    damped, dragged = bool(samples.b.any()), bool(samples.d.any())
    of_small = _may_follow(
        samples, values, noise, _monomials(ABOVE, damped, dragged), _monomials(BELOW, damped, dragged)
    )
    for above, below in _shapes(damped, dragged):
        small = weight(above[-1]) <= ABOVE and not any(m[3] or m[4] for m in above)
        if 2 * (len(above) + len(below)) > len(values) or (small and not of_small):
            continue
        if weight(above[-1]) > largest or (largest < POLYNOMIAL and not small):
            continue
        found = _fitted(samples, values, noise, above, below)
        if found is not None:
            return found
    return None


def _may_follow(
    samples: Samples, values: Array, noise: float, above: Sequence[Monomial], below: Sequence[Monomial]
) -> bool:
    """Whether the largest formula leaves little enough: all smaller ones are among those it is the best of."""
    matrix = np.hstack([samples.of(above), -values[:, None] * samples.of(below[1:])])
    if matrix.shape[1] > len(values) // 2:
        return True  # so many terms follow anything
    size = np.abs(matrix).max(axis=0)
    size[size == 0] = 1.0
    left = matrix @ (np.linalg.lstsq(matrix / size, values, rcond=1e-15)[0] / size) - values
    return bool(np.linalg.norm(left) <= NOISES * noise * np.sqrt(len(values)))


def formulas_of(samples: Samples, matrices: Array, noise: float, largest: int = POLYNOMIAL) -> Entries | None:
    """The formulas of all four entries of step matrices, shape (n, 2, 2); None where one has none (`formula_of`)."""
    found = []
    for entry in matrices.reshape(-1, 4).T:
        formula = formula_of(samples, entry, noise, largest)
        if formula is None:
            return None
        found.append(formula)
    return found[0], found[1], found[2], found[3]


def _fitted(
    samples: Samples, values: Array, noise: float, above: Sequence[Monomial], below: Sequence[Monomial]
) -> Formula | None:
    kept = np.arange(len(values)) % 3 != 2
    matrix = np.hstack([samples.of(above), -values[:, None] * samples.of(below)])
    size = np.abs(matrix[kept]).max(axis=0)
    size[size == 0] = 1.0
    u, s, vt = np.linalg.svd(matrix[kept] / size, full_matrices=False)
    if s[-1] < 1e-13 * s[0]:
        return None
    solution = vt.T @ ((u.T @ values[kept]) / s)
    left = matrix @ (solution / size) - values
    if np.abs(left).max() > NOISES * noise:
        return None
    spread = DEVIATIONS * noise * np.sqrt(((vt.T / s) ** 2).sum(axis=1)) / size
    # what is left tells how far values are really off; where only then they are fractions, these count
    scatter = min(1.0, SCATTERS * float(np.sqrt((left**2).mean())) / noise)
    numbers = [_number(float(c), float(t), scatter) for c, t in zip(solution / size, spread, strict=True)]
    formula = Formula(
        {m: c for m, c in zip(above, numbers, strict=False) if c},
        {ONE: Fraction(1)} | {m: c for m, c in zip(below, numbers[len(above) :], strict=True) if c},
    )
    if not formula.exact and (not formula.is_polynomial or noise > FINE):
        return None  # a fraction of polynomials with numbers that are none, or few digits of these: it may be anything
    below_size = np.abs(1 + samples.of(below) @ (solution / size)[len(above) :]) if below else np.ones(1)
    off = np.abs(formula.at(samples.a, samples.b, samples.d) - values)
    return formula if bool((off <= 2 * NOISES * noise / np.minimum(below_size, 1.0)).all()) else None


def _number(c: float, spread: float, scatter: float) -> Number:
    found = fraction_or_itself(c, spread)
    return found if isinstance(found, Fraction) else fraction_or_itself(c, spread * scatter)


@cache
def _shapes(damped: bool, dragged: bool) -> tuple[tuple[tuple[Monomial, ...], tuple[Monomial, ...]], ...]:
    """Terms above and below to try, the fewest first; exponentials of damping and of drag come after all others."""
    plain = [*_plain(damped, dragged)]
    plain.sort(key=lambda shape: len(shape[0]) + len(shape[1]))
    decays = [decay for decay, there in (((1, 0), damped), ((0, 1), dragged)) if there]
    exponential = [
        (tuple((*m[:3], *power) for power in ((0, 0), decay) for m in _monomials(n, damped, dragged)), ())
        for n in (2, 3, 4)
        for decay in decays
    ]
    return (*plain, *exponential)


def _plain(damped: bool, dragged: bool) -> Iterator[tuple[tuple[Monomial, ...], tuple[Monomial, ...]]]:
    for n in range(POLYNOMIAL + 1):
        for m in range(BELOW + 1) if n <= ABOVE else (0,):
            yield _monomials(n, damped, dragged), _monomials(m, damped, dragged)[1:]


@cache
def _monomials(most: int, damped: bool, dragged: bool) -> tuple[Monomial, ...]:
    """Those up to a power of h, of the variables that there are."""
    found = [
        (i, j, k, 0, 0)
        for i, j, k in product(range(most // 2 + 1), range(most + 1), range(most + 1))
        if 2 * i + j + k <= most and (damped or not j) and (dragged or not k)
    ]
    return tuple(sorted(found, key=weight))
