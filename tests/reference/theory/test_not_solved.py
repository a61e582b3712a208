"""Schemes whose solver gives up, and steps of schemes that remember, differenced: neither is taken for instability."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from reference.errors import SolverError
from reference.motion import MotionOfSprings
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.schemes.multistep import bdf2
from reference.state import State
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.measured_mode import measured_mode_limit
from reference.theory.rates import rates
from reference.theory.step_map import step_jacobian


def gives_up(motion: MotionOfSprings, state: State, dt: float) -> State:
    """BDF2 whose solver gives up beyond 20 ms."""
    if dt > 0.02:
        raise SolverError("no solution")
    return bdf2(motion, state, dt)


def damped_string() -> Equilibrium:
    """Of two masses."""
    return spring_equilibrium(find_scene("string").system({"masses": 2, "damping": 0.5}))


@pytest.mark.rotating(3)
def test_a_solver_that_gives_up_is_told_as_that_and_not_as_a_limit() -> None:
    """Predicted, up to where it was computed; measured, up to where it ran."""
    rest = damped_string()
    scheme = Scheme(gives_up, 2, implicit=True, linear=False, one_step=False)
    predicted = stability_limit(scheme, rest)
    assert predicted.dt is None
    assert re.match(r"not computed: stable up to 0\.02 s, above which .* not solved: no solution", predicted.reason)
    measured = measured_mode_limit(scheme, rest, predicted, rates(rest))
    assert measured.dt is None
    assert "its equations were not solved: no solution" in measured.reason
    assert "unstable" not in measured.reason


@pytest.mark.parametrize("name", ["bdf2", "hht", "adams_bashforth_2"])
@pytest.mark.parametrize("part", [1e-4, 1e-2, 1.0])
def test_what_remembers_is_differenced_as_well_in_short_steps(name: str, part: float) -> None:
    """Against the step of the linearised motion, whose Jacobian is exact, in parts of the fastest motion's 1/w.

    Differences of fourth order are good to 1e-9 of what is of size 1.
    """
    rest = damped_string()
    dt = part / rates(rest).fastest
    exact, differenced = (step_jacobian(replace(find(name), linear=linear), rest, dt) for linear in (True, False))
    assert np.abs(exact - differenced).max() < 1e-7
