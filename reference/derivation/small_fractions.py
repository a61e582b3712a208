"""The simplest fraction near a number, and whether chance alone would give one as simple."""

from __future__ import annotations

from fractions import Fraction
from math import floor

#: A fraction of denominator q within tol of a number is taken for it where tol q^2 is less: about so many random
#: numbers of one have such a fraction near (7 of 20,000 at 1e-3).
BY_CHANCE = 1e-4


def simplest_within(x: float, tol: float) -> Fraction:
    """The fraction of smallest denominator in [x - tol, x + tol] (Stern 1858, Brocot 1861).

    >>> simplest_within(0.33333, 1e-4)
    Fraction(1, 3)
    """
    low, high = Fraction(x) - Fraction(tol), Fraction(x) + Fraction(tol)
    if low <= 0 <= high:
        return Fraction(0)
    return _between(low, high) if low > 0 else -_between(-high, -low)


def recognised(x: float, tol: float) -> Fraction | None:
    """That fraction, where it is too simple to be there by chance; else None.

    >>> recognised(0.6666666666666667, 1e-14)
    Fraction(2, 3)
    >>> recognised(2**0.5, 1e-14) is None
    True
    """
    found = simplest_within(x, tol)
    return found if tol * found.denominator**2 < BY_CHANCE else None


def fraction_or_itself(x: float, tol: float) -> Fraction | float:
    """That fraction, which is 0 within tol of it; a number that none is recognised in as it is.

    >>> fraction_or_itself(0.5, 1e-14), fraction_or_itself(2**0.5, 1e-14)
    (Fraction(1, 2), 1.4142135623730951)
    """
    found = Fraction(0) if abs(x) <= tol else recognised(x, tol)
    return x if found is None else found


def _between(low: Fraction, high: Fraction) -> Fraction:
    """The simplest fraction in [low, high], both positive: as far as their continued fractions agree."""
    whole = floor(low)
    if whole == low:
        return Fraction(whole)
    if whole < floor(high):
        return Fraction(whole + 1)
    return whole + 1 / _between(1 / (high - whole), 1 / (low - whole))
