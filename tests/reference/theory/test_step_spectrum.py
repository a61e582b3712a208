"""The search for the first dt at which perturbations grow, on growths that are known."""

from __future__ import annotations

import math

import pytest

from reference.theory import step_spectrum


@pytest.mark.parametrize("start", [1e-3, 0.7, 5.0, 400.0])
def test_the_first_unstable_dt_is_found_from_either_side(start: float) -> None:
    """Growth dt - 1: unstable beyond 1 s, to the precision asked for, wherever the search begins."""
    limit = step_spectrum._scan(lambda dt: dt - 1.0, start, 1.0, 0.0, 1e4, 1e-6)
    assert limit.dt == pytest.approx(1.0, rel=1e-6)


def test_what_is_unstable_at_any_dt_or_stable_at_any_has_no_limit_and_says_how_far_it_was_looked() -> None:
    """No search goes on for ever."""
    unstable = step_spectrum._scan(lambda dt: 1.0, 1.0, 1.0, 0.0, 1e4, 1e-6)
    stable = step_spectrum._scan(lambda dt: -1.0, 1.0, 1.0, 0.0, 1e4, 1e-6)
    assert unstable.dt is None
    assert "no stable step was found" in unstable.reason
    assert stable.dt is None
    assert "stable at any dt" in stable.reason


def test_rounding_at_long_steps_is_no_growth() -> None:
    """Beyond the fastest mode's 1/w, dt x velocities are larger than positions, and so is their rounding."""
    margin = 1e-9
    rounding = step_spectrum._scan(lambda dt: 0.9 * margin * max(1.0, dt / 0.1), 1e-2, 0.1, margin, 1e3, 1e-6)
    growing = step_spectrum._scan(lambda dt: 2 * margin if dt > 0.05 else 0.0, 1e-2, 0.1, margin, 1e3, 1e-6)
    assert rounding.dt is None
    assert growing.dt is not None
    assert math.isclose(growing.dt, 0.05, rel_tol=1e-5)
