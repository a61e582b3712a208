"""The search for the first dt at which perturbations grow, on growths that are known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.system import MassSpringSystem
from reference.theory import step_spectrum
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit


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


def test_in_place_euler_of_one_mass_is_euler_where_nothing_resists_a_motion() -> None:
    """One mass amid a string without tension: along it h < g/w^2, across it nothing pulls, and nothing grows.

    Growth beyond the limit is a ten-millionth in a step: that is no rounding of the motion across.
    """
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array(0.1),
        rest_lengths=np.array(1.0),
        stiffness=np.array(100.0),
        damping=np.array(0.05),
        drag=0.0,
        gravity=np.array(0.0),
        fixed=np.array([True, False, True]),
    )
    limit = stability_limit(find("euler_in_place"), spring_equilibrium(system))
    assert limit.dt == pytest.approx(0.1 / 200, rel=1e-5)


@pytest.mark.parametrize("damping", [1e-3, 1e-7, 1e-9])
def test_rounding_of_what_is_remembered_is_no_growth(damping: float) -> None:
    """Verlet by positions on 100 1/s, hardly damped: 2/w, be the damping ever so small."""
    rest = spring_equilibrium(find_scene("oscillator").system({"damping": damping}))
    assert stability_limit(find("stormer_verlet"), rest).dt == pytest.approx(0.02, rel=1e-6)
