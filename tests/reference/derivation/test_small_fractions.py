"""Fractions near numbers: the simplest, and none where chance would give one as simple."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from reference.derivation.small_fractions import recognised, simplest_within


@pytest.mark.parametrize(("p", "q"), [(1, 3), (-2187, 6784), (49, 176), (0, 1), (35, 384), (7, 1)])
def test_a_fraction_is_found_again_from_its_rounded_value(p: int, q: int) -> None:
    """Those of Dormand and Prince among them."""
    assert recognised(p / q, 4e-15) == Fraction(p, q)


def test_none_is_simpler() -> None:
    """Of all fractions within the distance the denominator is the smallest, by trying all."""
    for x in np.random.default_rng(0).uniform(-2, 2, 50).tolist():
        smallest = next(q for q in range(1, 2000) if abs(round(x * q) / q - x) <= 1e-3)
        assert simplest_within(x, 1e-3).denominator == smallest


def test_chance_gives_none() -> None:
    """Of a thousand random numbers, at most a few: the expected part is BY_CHANCE."""
    found = [recognised(float(x), 1e-13) for x in np.random.default_rng(1).uniform(0, 1, 1000)]
    assert sum(f is not None for f in found) <= 3
