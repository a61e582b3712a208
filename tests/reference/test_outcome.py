"""Outcomes: when a trajectory counts as blown up, and how that is said."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.changes import Change
from reference.outcome import Outcome, blow_up, first_diverged_frame, outcome_of
from reference.scenes import find as find_scene
from reference.state import Trajectory
from reference.stepper import stepper_named
from reference.system import MassSpringSystem

STRING = find_scene("string").system({"masses": 2, "rest_length": 1.0})


def trajectory(*tips: float) -> Trajectory:
    """The string, its last mass at these places along it at 0, 0.1 s, 0.2 s, ..."""
    positions = np.repeat(STRING.positions[None], len(tips), axis=0)
    positions[:, 2, 0] = tips
    return Trajectory(np.linspace(0.0, 0.1 * (len(tips) - 1), len(tips)), positions, np.zeros_like(positions))


def test_a_run_within_bounds_is_done() -> None:
    """Springs of up to 100 times their length are far from broken by rounding."""
    run = trajectory(2.0, 50.0, 100.9)
    assert blow_up(STRING, run) is None
    assert outcome_of(STRING, run) == Outcome("done", "", run)


@pytest.mark.parametrize(
    ("tips", "reason"),
    [
        ((2.0, 3.0, 101.1), "spring 1 is over 100 times its length at t = 0.2 s"),
        ((2.0, 1e300, np.nan), "spring 1 is over 100 times its length at t = 0.1 s"),
        ((2.0, np.nan), "the position of mass 2 is not a number at t = 0.1 s"),
        ((2.0, 3.0, np.inf), "the position of mass 2 is not a number at t = 0.2 s"),
        ((2.0, 3.0, -np.inf), "the position of mass 2 is not a number at t = 0.2 s"),
    ],
)
def test_a_blow_up_is_told_with_its_first_time_and_place(tips: tuple[float, ...], reason: str) -> None:
    """The mass or the spring, and when it is first seen."""
    run = trajectory(*tips)
    assert outcome_of(STRING, run) == Outcome("diverged", reason, run)


def test_a_spring_is_measured_by_its_length_at_the_start_if_that_is_longer() -> None:
    """Whoever starts with a spring stretched 200 times has not diverged by that."""
    assert blow_up(STRING, trajectory(201.0, 250.0, 190.0)) is None


def test_the_first_diverged_frame_is_found_at_any_stretch_ratio() -> None:
    """At three times the length already, for identification; the number of frames if there is none."""
    run = trajectory(2.0, 3.9, 4.1, 500.0)
    assert first_diverged_frame(STRING, run, 3.0) == 2
    assert first_diverged_frame(STRING, run, 100.0) == 3
    assert first_diverged_frame(STRING, run, 1e6) == 4


#: A mass of 1 g with a drag of 1 N s/m and no spring, which falls.
LOOSE = MassSpringSystem(
    positions=np.array([[0.0, 0.0]]),
    springs=np.zeros((0, 2), dtype=int),
    masses=np.array(1e-3),
    rest_lengths=np.zeros(0),
    stiffness=np.zeros(0),
    drag=1.0,
)


@pytest.mark.parametrize(("dt", "ending"), [(1.9e-3, "done"), (2.1e-3, "diverged"), (5e-3, "diverged")])
@pytest.mark.parametrize("name", ["euler", "kick_drift"])
def test_a_mass_without_springs_blows_up_by_its_drag(name: str, dt: float, ending: str) -> None:
    """Explicit drag multiplies v by 1 - h Cd/m in a step: beyond h = 2 m/Cd, here 2 ms, that is below -1.

    At 5 ms it is -4, and the speed 1e120 times as large after 200 steps; no spring is there to be stretched. At 2.1 ms
    it is -1.1: 1.1^200 = 2e8.
    """
    outcome = stepper_named(name).run(LOOSE, dt, 200)
    assert outcome.ending == ending
    if ending == "diverged":
        assert "the energy is over 10000 times what the system was given" in outcome.reason


def test_what_falls_or_flies_for_long_is_done() -> None:
    """Free fall, v = g t, and flight have the energy they were given: 1000 s of it, 4.9e6 m, are no blow-up."""
    free = replace(LOOSE, drag=0.0, velocities=np.array([[30.0, 40.0]]))
    for system in (free, replace(free, gravity=np.array(0.0))):
        assert stepper_named("heun").run(system, 1.0, 1000).ending == "done"


def test_gravity_that_comes_later_is_no_blow_up() -> None:
    """A mass at rest without gravity is given no energy; a change of gravity gives it some."""
    changes = (Change(0.1, "gravity", 9.81),)
    assert (
        stepper_named("heun").run(replace(LOOSE, drag=0.0, gravity=np.array(0.0)), 1e-2, 200, changes).ending == "done"
    )


def test_a_mass_that_is_put_elsewhere_is_told() -> None:
    """Without a velocity to show for it: a jump of 1 km where free fall covers 5 mm in 0.1 s."""
    positions = np.array([[[0.0, 0.0]], [[0.0, -0.05]], [[1e3, 0.0]]])
    run = Trajectory(np.array([0.0, 0.1, 0.2]), positions, np.zeros_like(positions))
    assert blow_up(LOOSE, run) == "mass 0 is over 100 times as far as it could have come at t = 0.2 s"


@pytest.mark.parametrize(("times", "ending"), [(99.0, "done"), (101.0, "diverged")])
def test_a_pendulum_that_turns_too_fast_has_blown_up(times: float, ending: str) -> None:
    """Rods keep their lengths at any speed: the kinetic energy is `times` squared of all that it can have been given.

    That is what stretches every spring to twice its length, k L^2/2 each: nothing has moved, so gravity has given none.
    """
    given = (STRING.stiffness * STRING.rest_lengths**2 / 2).sum()
    velocities = np.zeros((2, *STRING.positions.shape))
    velocities[1, 2, 1] = times * np.sqrt(2 * given / STRING.masses[2])
    run = Trajectory(np.array([0.0, 0.1]), np.repeat(STRING.positions[None], 2, axis=0), velocities)
    assert outcome_of(STRING, run).ending == ending


@pytest.mark.parametrize(("dt", "blown_up"), [(1e-3, False), (0.011, True)])
def test_a_spring_without_rest_length_is_measured_by_the_system(dt: float, blown_up: bool) -> None:
    """A slinky's lowest spring hangs 0.4 mm long, and is stretched by metres once its coils fall through one another.

    The fastest mode has h w = 2 at h = sqrt(m / k) = sqrt((1/50 kg) / (490 N/m)) = 6.4 ms: beyond, the run blows up.
    """
    slinky = find_scene("slinky").system({})
    ended = stepper_named("kick_drift").run(slinky, dt, round(0.5 / dt))
    assert ended.trajectory is not None
    assert (blow_up(slinky, ended.trajectory, ratio=20.0) is not None) == blown_up
