"""Systems along a line in engines: up and down the plane, and exactly straight."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.engine import CAPABILITIES, Engine, Unsupported, demands, registry
from engines.line import SimulationOnLine, started
from engines.step_jacobian import own_jacobian, step_jacobian
from experiments.runs.steppers import installed_engines
from reference.line import system_in_plane
from reference.scenes import find
from reference.theory.equilibrium import equilibrium
from tests.conformance.case import Case
from tests.conformance.children import result_of, run_all
from tests.conformance.doctored import Doctored, KickDrift

#: A chain whose weight pushes it together, against its anchor: in the plane it would buckle, if anything began to.
PUSHED = replace(find("chain").system({"masses": 5}), gravity=np.array([9.81]))

ABLE = [stepper.engine for stepper in installed_engines() if "1d" in stepper.engine.capabilities]


@pytest.mark.parametrize("able", ABLE, ids=lambda engine: engine.name)
def test_what_is_straight_stays_exactly_straight(able: Engine) -> None:
    """No mass is off the line by a single bit after 500 steps under compression; and they have moved along it."""
    (outcome,) = result_of(run_all, able, [Case("pushed", system_in_plane(PUSHED), 1e-3, 500)])
    assert outcome.trajectory is not None
    assert (outcome.trajectory.positions[..., 0] == 0).all()
    assert (outcome.trajectory.velocities[..., 0] == 0).all()
    assert np.ptp(outcome.trajectory.positions[:, 2, 1]) > 0


def test_a_chain_of_rods_would_not_stay_straight() -> None:
    """Shown to fail: the cable, whose rods stand on one another, falls over, and so takes nothing along a line."""
    engine = registry()["mujoco_cable"]
    (outcome,) = result_of(run_all, engine, [Case("pushed", system_in_plane(PUSHED), 1e-3, 1500)])
    assert outcome.trajectory is not None
    assert np.abs(outcome.trajectory.positions[..., 0]).max() > 0.01
    assert "1d" not in engine.capabilities


def test_only_who_can_is_given_a_line() -> None:
    """Others are not started: refused with what they lack, before anything is put into the plane."""
    assert "1d" in demands(PUSHED)
    assert "tilted gravity" not in demands(PUSHED)
    unable = replace(Doctored(KickDrift), capabilities=frozenset(CAPABILITIES) - {"1d"})
    with pytest.raises(Unsupported, match="cannot do motion along a line"):
        started(unable, PUSHED, 1e-3)


def test_the_plane_is_left_as_it_is() -> None:
    """An engine's own simulation is handed out there."""
    engine = Doctored(KickDrift)
    assert isinstance(started(engine, PUSHED, 1e-3), SimulationOnLine)
    assert isinstance(started(engine, system_in_plane(PUSHED), 1e-3), KickDrift)


def test_states_are_along_the_line_and_changes_too() -> None:
    """As a simulation of its own equations: gravity set to a number is downwards, to a list of one along the axis."""
    simulation = started(Doctored(KickDrift), PUSHED, 1e-3)
    own = KickDrift(PUSHED, 1e-3)
    for value in (1.62, [3.0], (-2.0,)):
        simulation.change("gravity", value)
        own.change("gravity", value)
        simulation.step()
        own.step()
        for found, right in zip(simulation.state(), own.state(), strict=True):
            assert found.shape == (6, 1)
            assert np.array_equal(found, right)


def test_the_jacobian_is_that_along_the_line() -> None:
    """Kick-drift of one mass: [[1 - h^2 w^2, 1], [-h^2 w^2, 1]] over (x, h v), h w = 0.1. No engine's own of the plane.

    Central differences are good to the square of their perturbation, 4e-11.
    """
    system = find("oscillator").system({})
    rest = replace(system, positions=equilibrium(system).positions)
    found = step_jacobian(Doctored(KickDrift), rest, 1e-3)
    assert found == pytest.approx(np.array([[0.99, 1.0], [-0.01, 1.0]]), abs=1e-9)
    assert own_jacobian(Doctored(KickDrift), rest, 1e-3) is None
