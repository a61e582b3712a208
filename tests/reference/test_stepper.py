"""Steppers: a scheme on springs or on rods, run to an outcome whatever happens."""

from __future__ import annotations

import pytest

from reference.changes import Change
from reference.pendulum import PendulumMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find, schemes
from reference.schemes.constrained import ROPE_KICK_DRIFT
from reference.simulate import simulate
from reference.stepper import SchemeStepper, catalogued
from tests.reference.systems import moving_string


def test_every_scheme_is_a_stepper_and_those_that_can_swing_rods_are_two() -> None:
    """Springs first, in the catalogue's order; each with the scheme's kind, or `pendulum`; the rope's is last."""
    on_rods = [f"pendulum_{name}" for name, scheme in schemes().items() if scheme.needs == "accelerations"]
    on_rods.append(ROPE_KICK_DRIFT.name)
    assert list(catalogued()) == [*schemes(), *on_rods]
    assert [name for name, stepper in catalogued().items() if stepper.on_rods] == on_rods
    assert all(catalogued()[name].kind == scheme.kind for name, scheme in schemes().items())
    assert all(catalogued()[name].kind == "pendulum" for name in on_rods)
    assert all(name == stepper.name for name, stepper in catalogued().items())


def test_a_run_that_comes_to_its_end_is_done() -> None:
    """Its trajectory is that of `simulate`."""
    system = moving_string(3)
    outcome = SchemeStepper(find("rk4")).run(system, 1e-3, 20)
    assert (outcome.ending, outcome.reason) == ("done", "")
    assert outcome.trajectory is not None
    assert outcome.trajectory.positions.tolist() == simulate(system, find("rk4"), 1e-3, 0.02).positions.tolist()


def test_a_run_that_blows_up_has_diverged_and_says_where_and_when() -> None:
    """With what there is of its trajectory."""
    outcome = SchemeStepper(find("kick_drift")).run(find_scene("string").system({}), 0.05, 400)
    assert outcome.ending == "diverged"
    assert outcome.reason == "spring 1 is over 100 times its length at t = 0.2 s"
    assert outcome.trajectory is not None
    assert len(outcome.trajectory) > 4


@pytest.mark.rotating(3)
@pytest.mark.parametrize("name", catalogued())
@pytest.mark.parametrize("dt", [0.05, 0.3, 5.0, 1e80])
def test_no_step_is_so_large_that_a_run_raises(name: str, dt: float) -> None:
    """Nor warns: it is done, or it has diverged, in one line; a run that is done has all its steps."""
    system = find_scene("string").system({"masses": 6})
    outcome = catalogued()[name].run(system, dt, 60)
    assert outcome.ending in ("done", "diverged")
    assert "\n" not in outcome.reason
    if outcome.ending == "done":
        assert outcome.trajectory is not None
        assert len(outcome.trajectory) == 61
    else:
        assert outcome.reason


def test_a_pendulum_that_turns_infinitely_fast_has_diverged() -> None:
    """Its masses are still on their rods: what is told is its energy, long before it is no number."""
    outcome = catalogued()["pendulum_drift_kick"].run(find_scene("string").system({}), 0.05, 400)
    assert outcome.ending == "diverged"
    assert "the energy is over 10000 times what the system was given" in outcome.reason


def test_an_implicit_scheme_that_finds_no_solution_has_diverged() -> None:
    """With the solver's words, and no trajectory."""
    outcome = SchemeStepper(find("backward_euler")).run(moving_string(3), 1e80, 3)
    assert outcome.ending == "diverged"
    assert outcome.reason.startswith("backward Euler found no solution")
    assert outcome.trajectory is None


@pytest.mark.parametrize(
    ("system", "reason"),
    [
        (moving_string(3), "expected every spring to start at its rest length"),
        (find_scene("spring").system({"stretch": 0.01}), "expected every spring to start at its rest length"),
    ],
)
def test_what_cannot_hang_on_rods_is_unsupported(system: object, reason: str) -> None:
    """Said before anything is run."""
    outcome = catalogued()["pendulum_heun"].run(system, 1e-3, 3)  # type: ignore[arg-type]
    assert (outcome.ending, outcome.reason) == ("unsupported", reason)


def test_a_change_that_rods_cannot_make_is_unsupported() -> None:
    """In the middle of a run, too."""
    stepper = SchemeStepper(find("rk4"), PendulumMotion)
    outcome = stepper.run(find_scene("string").system({"masses": 2}), 1e-3, 10, (Change(0.005, "rest_length", 0.2),))
    assert outcome.ending == "unsupported"
    assert "rest length" in outcome.reason
