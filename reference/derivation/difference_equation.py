"""The difference equation of a method with a memory: what its positions obey on oscillators, step after step.

    sum_j (alpha_j + beta_j a + gamma_j b + delta_j d) x_(n+1-j) = 0,    j = 0 .. k,    alpha_0 = 1,

with a = h^2 k/m, b = h c/m, d = h Cd/m. Every linear multistep method obeys one, also where it keeps accelerations, as
those of Hilber, Hughes and Taylor, and of Chung and Hulbert: whatever is remembered beside positions is eliminated. Its
roots are the eigenvalues of the whole step, memory and all (Chung and Hulbert, J. Appl. Mech. 60, 1993). The
coefficients are numbers: many oscillators together are many equations for few of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import product
from math import factorial

import numpy as np

from reference.derivation.consequences import Windows, windows
from reference.derivation.fit import DEVIATIONS, NOISES, Samples
from reference.derivation.formula import ONE, Formula, Monomial, Number
from reference.derivation.oscillators import FEW, ROUNDINGS, Runs, rows_of_steps, samples
from reference.derivation.small_fractions import fraction_or_itself
from reference.derivation.step_matrix import VARIANTS
from reference.errors import Unsupported
from reference.identification.scale import ROUNDING, Precision
from reference.state import Array
from reference.system import BoolArray

#: So many steps back are looked at, at most; so many at the start may be another method's, which begins it.
MOST, BEGINNING = 8, 4

#: What multiplies the coefficients of each kind.
KINDS: tuple[Monomial, ...] = (ONE, (1, 0, 0, 0, 0), (0, 1, 0, 0, 0), (0, 0, 1, 0, 0))

#: Oscillators are this part as stiff as those that step matrices are seen on: what is unstable grows less.
SOFTER = 1 / 4

#: Roots of it may be beyond 1 by so much for rounding; the highest order that is looked for, and how near its sums are.
BEYOND, HIGHEST, NEAR = 1e-11, 8, 1e-9


@dataclass(frozen=True)
class DifferenceEquation:
    """What was found.

    Attributes:
        parts: of x_(n+1), x_n, ..., in a, b and d: the first with 1 as its constant.
        damped: whether it was seen with damping of the spring.
        dragged: whether it was seen with drag.
    """

    parts: tuple[Formula, ...]
    damped: bool
    dragged: bool

    @property
    def explicit(self) -> bool:
        """Whether the new position is divided by nothing."""
        return set(self.parts[0].numerator) == {ONE}

    def at(self, a: Array, b: Array, d: Array) -> Array:
        """Its coefficients at many oscillators, shape (n, k + 1), those of x_(n+1) first.

        The roots of such a polynomial are what a step multiplies by.
        """
        return np.stack([part.at(a, b, d) for part in self.parts], axis=1)

    @cached_property
    def imaginary_axis(self) -> Windows:
        """In which intervals of h w an undamped oscillator does not grow."""
        return windows(lambda s: self._stable(s**2, 0 * s, 0 * s))

    @cached_property
    def real_axis(self) -> Windows | None:
        """In which intervals of h c/m, or h Cd/m, a damped mass without stiffness does not; None of neither."""
        if not (self.damped or self.dragged):
            return None
        return windows(lambda s: self._stable(0 * s, s * self.damped, s * (not self.damped)))

    def _stable(self, a: Array, b: Array, d: Array) -> BoolArray:
        return np.asarray(largest_roots(self.at(a, b, d)) <= 1 + BEYOND)

    @property
    def of_fast(self) -> float | None:
        """By what a step multiplies what swings infinitely fast; None where that grows beyond all bounds."""
        by_stiffness = np.array([float(part.numerator.get(KINDS[1], 0)) for part in self.parts])
        return float(largest_roots(by_stiffness[None])[0]) if by_stiffness[0] else None

    @cached_property
    def order(self) -> int:
        """Up to which p what a true swing leaves of it goes as h^(p + 2), without damping (Henrici 1962, ch. 6)."""
        k = len(self.parts) - 1
        alpha, beta = (np.array([float(part.numerator.get(kind, 0)) for part in self.parts]) for kind in KINDS[:2])
        steps = k - np.arange(k + 1.0)
        for q in range(HIGHEST + 3):
            left = (alpha * steps**q).sum() / factorial(q)
            left -= (beta * steps ** (q - 2)).sum() / factorial(q - 2) if q >= 2 else 0.0
            if abs(left) > NEAR:
                return max(0, q - 2)
        return HIGHEST

    def text(self) -> list[str]:
        """Its coefficients as they are written, those of x_(n+1) first."""
        return list(map(str, self.parts))


def largest_roots(polynomials: Array) -> Array:
    """The size of each one's largest root, shape (n,); coefficients of shape (n, k + 1), the highest first."""
    k = polynomials.shape[1] - 1
    companions = np.zeros((len(polynomials), k, k))
    companions[:, 0] = -polynomials[:, 1:] / polynomials[:, :1]
    companions[:, np.arange(1, k), np.arange(k - 1)] = 1.0
    return np.asarray(np.abs(np.linalg.eigvals(companions)).max(axis=1))


def difference_equation(runs: Runs, precision: Precision = "double") -> DifferenceEquation:
    """The one of the fewest steps back that rows of steps obey, with damping and drag where there is one with these.

    Raises:
        Unsupported: where the stepper cannot step such oscillators, or obeys none; with the reason.
    """
    noise, reason = ROUNDINGS * ROUNDING[precision], ""
    for damped, dragged in VARIANTS:
        few = samples(damped, dragged, FEW)
        at = Samples(few.a * SOFTER, few.b * SOFTER, few.d * SOFTER)
        try:
            rows = rows_of_steps(runs, at, BEGINNING + MOST + 2)
        except Unsupported as error:
            reason = reason or str(error)
            continue
        for back, begun in product(range(2, MOST + 1), range(BEGINNING)):
            parts = _fitted(at, rows[:, begun:], back, noise)
            if parts is not None:
                return DifferenceEquation(parts, damped, dragged)
        reason = f"its positions follow no linear equation of up to {MOST} steps back"
    raise Unsupported(reason)


def _fitted(at: Samples, rows: Array, back: int, noise: float) -> tuple[Formula, ...] | None:
    """Least squares over all oscillators and steps; every equation is scaled by the largest position in it."""
    kinds = [kind for kind, there in zip(KINDS, (True, True, at.b.any(), at.d.any()), strict=True) if there]
    unknowns = [(kind, j) for kind in kinds for j in range(back + 1) if kind != ONE or j]
    by_kind = dict(zip(kinds, at.of(kinds).T, strict=True))
    count = rows.shape[1] - back
    positions = np.stack(
        [rows[:, back - j : back - j + count] for j in range(back + 1)]
    )  # lag, start, step, oscillator
    scale = np.abs(positions).max(axis=0)
    terms = np.stack([(by_kind[kind] * positions[j] / scale).ravel() for kind, j in unknowns], axis=1)
    wanted = -(positions[0] / scale).ravel()
    u, s, vt = np.linalg.svd(terms, full_matrices=False)
    if s[-1] < 1e-13 * s[0]:
        return None
    solution = vt.T @ ((u.T @ wanted) / s)
    if np.abs(terms @ solution - wanted).max() > NOISES * noise:
        return None
    spread = DEVIATIONS * noise * np.sqrt(((vt.T / s) ** 2).sum(axis=1))
    parts: list[dict[Monomial, Number]] = [{ONE: Fraction(1)}, *({} for _ in range(back))]
    for (kind, j), c, off in zip(unknowns, solution.tolist(), spread.tolist(), strict=True):
        number = fraction_or_itself(c, off)
        parts[j] |= {kind: number} if number else {}
    kept = np.array([float(parts[j].get(kind, 0)) for kind, j in unknowns])
    if np.abs(terms @ kept - wanted).max() > 2 * NOISES * noise:
        return None
    return tuple(Formula(part) for part in parts)
