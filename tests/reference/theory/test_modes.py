"""Natural modes against closed forms: frequencies, shapes, and what damping and drag make of each."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.theory.equilibria import spring_equilibrium
from reference.theory.linearisation import Linearisation
from reference.theory.modes import natural_modes
from tests.reference.theory.test_rates import free_chain


def linear(**fields: object) -> Linearisation:
    """The free chain of three masses of 0.5 kg and two springs of 80 N/m."""
    found = spring_equilibrium(free_chain(**fields)).linear
    assert found is not None
    return found


@pytest.mark.parametrize("lowest", [None, 3, 2, 1])
@pytest.mark.parametrize(("c", "drag"), [(0.0, 0.0), (0.6, 0.4), (0.6, 0.0), (0.0, 0.4)])
def test_a_free_chain(lowest: int | None, c: float, drag: float) -> None:
    """w^2 = n k/m and g = (n c + Cd)/m with n = 0, 1 and 3; damping within modes only; one alone by sparse matrices."""
    modes = natural_modes(linear(damping=np.array(c), drag=drag), lowest)
    n, count = np.array([0.0, 1.0, 3.0]), lowest or 3
    assert modes.frequencies == pytest.approx(np.sqrt(n * 160.0)[:count] / (2 * np.pi), rel=1e-9, abs=1e-12)
    assert modes.rates == pytest.approx((n * c + drag)[:count] / 0.5, abs=1e-9)
    assert modes.coupled == pytest.approx(0.0, abs=1e-9)
    shapes = np.array([[1.0, 1.0, 1.0], [1.0, 0.0, -1.0], [0.5, -1.0, 0.5]])[:count]
    for shape, expected in zip(modes.shapes[:, :, 0], shapes, strict=True):
        assert abs(shape @ expected) == pytest.approx(expected @ expected, rel=1e-6)
    with np.errstate(invalid="ignore", divide="ignore"):
        zeta = (n * c + drag) / 0.5 / (2 * np.sqrt(n * 160.0))
    assert modes.damping_ratios[1:] == pytest.approx(zeta[1:count], rel=1e-9, abs=1e-12)
    assert np.isnan(modes.damping_ratios[0])


def test_damping_that_acts_between_modes_is_told() -> None:
    """Of the first spring alone, c (1, -1, 0): within the modes 0, c/m/2 and 3c/m/2; c/m sqrt(3)/2 between the two.

    As a part of all, sqrt(2) sqrt(3)/2 of sqrt(1/4 + 9/4 + 3/2) = 2.
    """
    modes = natural_modes(linear(damping=np.array([0.4, 0.0])))
    assert modes.rates == pytest.approx([0.0, 0.4, 1.2], abs=1e-12)
    assert modes.coupled == pytest.approx(np.sqrt(1.5) / 2, rel=1e-9)


def test_the_slowest_of_many_are_the_same_by_sparse_matrices() -> None:
    """Of thirty unequal masses, the first of them fixed: rising, with their own shapes and rates."""
    n = 30
    chain = free_chain(
        positions=np.arange(n)[:, None] * 1.0,
        springs=np.stack([np.arange(n - 1), np.arange(1, n)], axis=1),
        masses=np.linspace(0.3, 0.9, n),
        damping=np.linspace(0.1, 0.7, n - 1),
        drag=0.2,
    )
    held = spring_equilibrium(replace(chain, fixed=np.arange(n) == 0)).linear
    assert held is not None
    every, few = natural_modes(held), natural_modes(held, 4)
    assert (np.diff(few.frequencies) > 0).all()
    assert few.frequencies == pytest.approx(every.frequencies[:4], rel=1e-9)
    assert few.rates == pytest.approx(every.rates[:4], rel=1e-8)
    assert np.abs(few.shapes) == pytest.approx(np.abs(every.shapes[:4]), abs=1e-6)
    assert not few.shapes[:, 0].any()
