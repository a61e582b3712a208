"""The search for the first dt at which perturbations grow, on growths that are known."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from reference.theory.first_growth import Search, first_growth


def search(excess: Callable[[float], float], rounding: float = 0.0, decays: bool = False) -> Search:
    """Of a growth that is known, to 1e-6."""
    return Search(excess, lambda dt: rounding * max(1.0, dt / 0.1), 1e-6, decays)


@pytest.mark.parametrize("start", [1e-3, 0.7, 5.0, 400.0])
def test_the_first_unstable_dt_is_found_from_either_side(start: float) -> None:
    """Growth dt - 1: unstable beyond 1 s, to the precision asked for, wherever the search begins."""
    limit = first_growth(search(lambda dt: dt - 1.0), start, 1.0, 1e4)
    assert limit.dt == pytest.approx(1.0, rel=1e-6)


def test_what_is_unstable_at_any_dt_or_stable_at_any_has_no_limit_and_says_how_far_it_was_looked() -> None:
    """No search goes on for ever."""
    unstable = first_growth(search(lambda dt: 1.0), 1.0, 1.0, 1e4)
    stable = first_growth(search(lambda dt: -1.0), 1.0, 1.0, 1e4)
    assert unstable.dt is None
    assert "no stable step was found" in unstable.reason
    assert stable.dt is None
    assert "stable at any dt" in stable.reason


def test_where_all_decays_in_the_end_growth_that_goes_on_is_no_proof_of_none() -> None:
    """In steps shorter than one can look at it decays: no limit is computed, and it is not said to be none."""
    limit = first_growth(search(lambda dt: 1e-7, 1e-8, decays=True), 1e-2, 1.0, 1e4)
    assert limit.dt is None
    assert limit.reason.startswith("not computed: growth is seen in steps down to")
    assert limit.stable_steps == "unknown"


def test_rounding_at_long_steps_is_no_growth() -> None:
    """Beyond the fastest mode's 1/w, dt x velocities are larger than positions, and so is their rounding."""
    margin = 1e-9
    rounding = first_growth(search(lambda dt: 0.9 * margin * max(1.0, dt / 0.1), margin), 1e-2, 0.1, 1e3)
    growing = first_growth(search(lambda dt: 200 * margin if dt > 0.05 else 0.0, margin), 1e-2, 0.1, 1e3)
    rising = first_growth(search(lambda dt: margin * (dt / 0.05) ** 4, margin), 1e-2, 0.1, 1e3)
    assert rounding.dt is None
    assert growing.dt is not None
    assert math.isclose(growing.dt, 0.05, rel_tol=1e-5)
    # what rises out of rounding slowly has begun before
    assert (rising.dt, rising.stable_steps) == (None, "unknown")


@pytest.mark.parametrize(
    ("rounding", "low", "high"),
    [(1e-12, 1e-3, 1e-3), (1e-10, 1e-3, 1e-3), (1e-7, 9e-4, 1.0916e-3), (1e-6, None, None)],
)
def test_a_limit_is_one_value_only_where_decay_and_growth_are_more_than_rounding(
    rounding: float, low: float | None, high: float | None
) -> None:
    """Of what decays by g dt and grows by dt^2, g = 0.001: at dt = g they are equal, and each is 1e-6.

    Rounding by r leaves sqrt(g^2 / 4 - r) about g / 2 on one side, sqrt(g^2 / 4 + r) on the other, and none at all if r
    is more than g^2 / 4 = 2.5e-7.
    """
    g = 1e-3
    found = first_growth(search(lambda dt: dt**2 - g * dt, rounding, decays=True), 1e-2, 1.0, 1e4)
    if low is None:
        assert found.dt is None
        assert found.reason.startswith("not computed: ")
        return
    expected = [g / 2 + math.sqrt(g**2 / 4 + sign * rounding) for sign in (-1, 1)]
    if low == high:
        assert found.dt == pytest.approx(g, rel=1e-6)
        assert found.certainty == "computed"
    else:
        assert found.certainty == "between"
        assert [found.dt, found.at_most] == pytest.approx(expected, rel=1e-5)
        assert expected == pytest.approx([low, high], rel=0.02)
