"""The rational function that values follow to rounding."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from reference.derivation.fit import Samples, formula_of
from reference.derivation.formula import ONE

NOISE = 1e-12


def along(a: np.ndarray) -> Samples:
    """Undamped and without drag."""
    return Samples(a, np.zeros_like(a), np.zeros_like(a))


@pytest.mark.parametrize("largest", [1e-2, 1.0, 1e3])
def test_coefficients_are_fractions_as_sure_as_the_terms_are_large(largest: float) -> None:
    """1 - 3 a/7, with rounding of 1e-12: the slope is known to 1e-12 over the largest a, whatever that is.

    A slope that is 1e-9 beside 3/7 is that fraction where a is small, as rounding hides the difference, and is no
    fraction where a is large.
    """
    a = np.linspace(0.1, 1.0, 12) * largest
    noise = NOISE * np.random.default_rng(5).uniform(-1, 1, len(a))
    found = formula_of(along(a), 1 - 3 / 7 * a + noise, NOISE)
    assert found is not None
    assert found.numerator == {ONE: 1, (1, 0, 0, 0, 0): Fraction(-3, 7)}
    beside = formula_of(along(a), 1 - (3 / 7 + 1e-9) * a + noise, NOISE)
    assert beside is not None
    assert (beside.numerator[1, 0, 0, 0, 0] == Fraction(-3, 7)) == (largest == 1e-2)


def test_a_fraction_of_polynomials_is_found_and_no_small_one_is_not_forced() -> None:
    """Trapezoid's 1 - (a/2)/(1 + a/4) = (1 - a/4)/(1 + a/4); the square root of 1 + a is no such fraction."""
    a = np.linspace(0.05, 2.0, 24)
    found = formula_of(along(a), (1 - a / 4) / (1 + a / 4), NOISE)
    assert found is not None
    assert found.numerator == {ONE: 1, (1, 0, 0, 0, 0): Fraction(-1, 4)}
    assert found.denominator == {ONE: 1, (1, 0, 0, 0, 0): Fraction(1, 4)}
    assert formula_of(along(a), np.sqrt(1 + 40 * a), NOISE) is None
