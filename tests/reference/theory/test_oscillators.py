"""Steps of single oscillators: how much they grow in one, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from reference.schemes.catalogue import find
from reference.theory.oscillators import growth_of_oscillators


def test_undamped_oscillators_grow_under_euler_and_not_under_kick_drift() -> None:
    """|1 + i h w| = sqrt(1 + h^2 w^2); kick-drift keeps them up to h w = 2, and beyond has a real pair."""
    squares, none, h = np.array([1.0, 4.0, 25.0]), np.zeros(3), 0.5
    assert growth_of_oscillators(find("euler"), h, squares, none) == pytest.approx(np.sqrt(1 + h**2 * squares))
    half = (2 - h**2 * 25.0) / 2
    expected = [1.0, 1.0, -half + np.sqrt(half**2 - 1)]
    assert growth_of_oscillators(find("kick_drift"), h, squares, none) == pytest.approx(expected, rel=1e-9)


def test_of_two_rates_the_one_that_decays_less_counts() -> None:
    """Overdamped, x'' + 10 x' + 9 x = 0 decays at 1 and 9: Euler's factors are 1 - h and 1 - 9 h."""
    found = growth_of_oscillators(find("euler"), 0.01, np.array([9.0]), np.array([10.0]))
    assert found == pytest.approx([0.99], rel=1e-9)
