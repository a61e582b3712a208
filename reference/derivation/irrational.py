"""Numbers of methods that are no fractions: p + q sqrt(n), as in Gauss' and Radau's, and p + q c + r c^2, c = 2^(1/3).

A number is taken for one of these only where it agrees to rounding: of random numbers one in a hundred thousand would.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache

import numpy as np

from reference.state import Array

#: The n; what p and q are multiples of one over, and the largest q.
ROOTS, PART, LARGEST = (2, 3, 5, 6, 7, 10, 15), 1800, 2

#: What p, q, r of cube roots are multiples of one over, and the largest.
CUBE, CUBE_PART, CUBE_LARGEST = 2 ** (1 / 3), 12, 3

#: How far a number may be off, beside 1 or itself where that is larger.
OFF = 1e-13


@lru_cache(maxsize=1000)
def irrational(x: float) -> str | None:
    """How it is written; None where it is none of these, or a fraction.

    >>> irrational(1 - 2**0.5 / 2), irrational(1 / (2 - 2 ** (1 / 3)))
    ('1 - sqrt(2)/2', '2/3 + cbrt(2)/3 + cbrt(4)/6')
    >>> irrational(0.123456789) is None
    True
    """
    tol = OFF * max(1.0, abs(x))
    m = np.arange(-LARGEST * PART, LARGEST * PART + 1)
    for n in ROOTS:
        found = _whole((x - m / PART * n**0.5) * PART, tol * PART)
        known = [(int(m[i]), int(p)) for i, p in found if m[i]]
        if known:
            by_root, alone = min(known, key=lambda pair: _size(*pair))
            return _sum([(Fraction(alone, PART), ""), (Fraction(by_root, PART), f"sqrt({n})")])
    k = np.arange(-CUBE_LARGEST * CUBE_PART, CUBE_LARGEST * CUBE_PART + 1)
    q, r = (grid.ravel() for grid in np.meshgrid(k, k))
    for i, p in _whole((x - q / CUBE_PART * CUBE - r / CUBE_PART * CUBE**2) * CUBE_PART, tol * CUBE_PART):
        if q[i] or r[i]:
            parts = (Fraction(int(part), CUBE_PART) for part in (p, q[i], r[i]))
            return _sum(list(zip(parts, ("", "cbrt(2)", "cbrt(4)"), strict=True)))
    return None


def _whole(values: Array, tol: float) -> list[tuple[int, float]]:
    """Which are whole numbers, and which ones."""
    near = np.round(values)
    return [(int(i), float(near[i])) for i in np.flatnonzero(np.abs(values - near) < tol)]


def _size(q: int, p: int) -> int:
    return Fraction(q, PART).denominator + Fraction(p, PART).denominator


def _sum(terms: list[tuple[Fraction, str]]) -> str:
    words = ""
    for c, root in terms:
        if not c:
            continue
        size, sign = abs(c), "-" if c < 0 else "+"
        above = root if root and size.numerator == 1 else f"{size.numerator} {root}".strip()
        term = above if size.denominator == 1 else f"{above}/{size.denominator}"
        words += f" {sign} {term}" if words else term if sign == "+" else f"-{term}"
    return words
