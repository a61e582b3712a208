"""Outcomes: when a trajectory counts as blown up, and how that is said."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference import outcome
from reference.changes import Change
from reference.lengths import spring_lengths
from reference.outcome import Outcome, blow_up, first_diverged_frame, outcome_of
from reference.scenes import find as find_scene
from reference.springs.angular import AngularSprings
from reference.springs.kinds import NonlinearSprings
from reference.state import Array, Trajectory
from reference.stepper import stepper_named
from reference.system import IntArray, MassSpringSystem

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
    assert first_diverged_frame(STRING, trajectory(2.0, 3.0, np.nan), 1e6) == 2


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
    found = stepper_named(name).run(LOOSE, dt, 200)
    assert found.ending == ending
    if ending == "diverged":
        assert "the energy is over 10000 times what the system was given" in found.reason


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


#: Three unequal masses on two unequal springs, one stretched, one pressed; bent, pulled and thrown.
BENT = MassSpringSystem(
    positions=np.array([[0.0, 0.0], [3.0, 4.0], [3.0, 3.0]]),
    velocities=np.array([[0.0, 2.0], [3.0, 4.0], [0.0, 0.0]]),
    springs=np.array([[0, 1], [1, 2]]),
    masses=np.array([0.2, 0.5, 1.5]),
    rest_lengths=np.array([2.0, 1.5]),
    stiffness=np.array([10.0, 40.0]),
    angular_springs=AngularSprings(np.array([[0, 1, 2]]), np.array([6.0]), np.array([np.arccos(0.8) + 0.5])),
    gravity=np.array([3.0, -4.0]),
    pulls=np.array([[0.0, 0.0], [0.0, -2.0], [1.0, 0.0]]),
)

#: Changes on the way, and what counts is the most there ever is, or of masses the least as well.
CHANGES = (
    Change(0.1, "gravity", (1.0, 12.0)),
    Change(0.2, "mass", (0.8, 0.1, 1.0)),
    Change(0.3, "stiffness", (5.0, 90.0)),
    Change(0.4, "pull.2.x", -3.0),
    Change(0.5, "pull.1.y", 1.0),
)


@pytest.fixture
def frame_by_frame(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is told of a frame is told by it and the start alone."""
    monkeypatch.setattr(outcome, "AT_ONCE", 1)


def ended(positions: Array, speed: float = 0.0) -> Trajectory:
    """Three frames: the start; another in between; masses at `positions`, the last with a speed [m/s], after 3 s."""
    all_positions = np.array([BENT.positions, BENT.positions * [1.5, -0.5], positions])
    velocities = np.array([BENT.velocities, [[9, 0], [0, -9], [0, 9]], [[0, 0], [0, 0], [0.6 * speed, 0.8 * speed]]])
    return Trajectory(np.array([0.0, 1.5, 3.0]), all_positions, velocities)


@pytest.mark.usefixtures("frame_by_frame")
@pytest.mark.parametrize(
    ("changes", "strongest"),
    [
        # gravity of 5 m/s^2; pulled with 2 N and 1 N
        ((), 5 + 3 / 0.2),
        ((Change(0.1, "mass", 7.0),), 5 + 3 / 0.2),
        # no axis of gravity has ever been more than (3, 12); pulled with 2 N and 3 N, and no less than 0.1 kg
        (CHANGES[:2] + CHANGES[3:], np.hypot(3, 12) + 5 / 0.1),
    ],
    ids=["as it is", "heavier", "with changes"],
)
def test_how_far_a_mass_can_have_come(changes: tuple[Change, ...], strongest: float) -> None:
    """Its extent of 4 m, springs of 5 and 1.5 m end to end, 5 m/s t and (g + F/m) t^2/2: told from 20 times that on."""
    allowed = 4 + 6.5 + 5 * 3 + strongest * 3**2 / 2
    for part, told in ((1 - 1e-9, None), (1 + 1e-9, "mass 1 is over 20 times as far as it could have come at t = 3 s")):
        moved = 20 * allowed * part * np.array([[0.6, 0.8 - 1e-6], [0.6, 0.8], [0.6, 0.8 - 1e-6]])
        assert blow_up(BENT, ended(BENT.positions + moved), 20.0, changes) == told


@pytest.mark.usefixtures("frame_by_frame")
@pytest.mark.parametrize("bends", [False, True])
@pytest.mark.parametrize("changes", [(), CHANGES], ids=["as it is", "with changes"])
def test_how_much_energy_can_have_been_given(changes: tuple[Change, ...], bends: bool) -> None:
    """Sum of m v^2/2, k e^2/2 and kappa beta^2/2 at the start, (m g + F) |x - x0|, k L^2/2, kappa/2 [J]: all by hand.

    Told from 3^2 times that on, of what is in springs, 1 m and 2.5 m longer then and bent at a right angle, and in the
    last mass's speed.
    """
    system = BENT if bends else replace(BENT, angular_springs=None)
    mass = np.array([0.8, 0.5, 1.5] if changes else [0.2, 0.5, 1.5])
    k, g = (np.array([10.0, 90.0]), np.hypot(3, 12)) if changes else (np.array([10.0, 40.0]), 5.0)
    pulls, kappa = np.array([0.0, 2.0, 3.0 if changes else 1.0]), 6.0 * bends
    at_start = k @ np.array([3.0, -0.5]) ** 2 / 2 + kappa * 0.5**2 / 2
    at_end = k @ np.array([1.0, 2.5]) ** 2 / 2 + kappa * (np.pi / 2 - np.arccos(0.8) - 0.5) ** 2 / 2
    given = mass @ np.array([4.0, 25.0, 0.0]) / 2 + at_start + (mass * g + pulls) @ np.array([0, np.sqrt(10), 1])
    given += k @ np.array([5.0, 1.5]) ** 2 / 2 + kappa / 2
    for part, told in ((1 - 1e-9, None), (1 + 1e-9, "the energy is over 9 times what the system was given at t = 3 s")):
        speed = np.sqrt(2 * (9 * given * part - at_end) / mass[2])
        run = ended(np.array([[0.0, 0.0], [0.0, 3.0], [4.0, 3.0]]), speed)
        assert blow_up(system, run, 3.0, changes) == told


def test_a_part_of_the_frames_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two springs and three masses, ten of these at once: two frames, and the first, by which all is told."""
    run, looked_at = trajectory(2.0, 3.0, 4.0, 5.0, 99.0, 101.1, 3.0), []

    def spied(positions: Array, springs: IntArray) -> Array:
        looked_at.append(len(positions) if positions.ndim == 3 else 0)
        return spring_lengths(positions, springs)

    monkeypatch.setattr(outcome, "spring_lengths", spied)
    for at_once, frames in ((10, [3, 3, 3]), (14, [3, 3, 3]), (15, [4, 4]), (4, [2] * 6)):
        monkeypatch.setattr(outcome, "AT_ONCE", at_once)
        looked_at.clear()
        assert outcome.first_blown_up_frame(STRING, run) == 5
        assert [count for count in looked_at if count] == frames


@pytest.mark.parametrize("lengths", [(0.0, 0.3), (0.3, 0.0)])
def test_the_other_springs_are_measured_by_their_own_lengths(lengths: tuple[float, float]) -> None:
    """Beside one without rest length, which may be as long as the system is large, 0.4 m: told from 3 times that on."""
    system = replace(STRING, rest_lengths=np.array(lengths), positions=0.2 * STRING.positions)
    for j, length in enumerate(lengths):
        for times, told in ((2.99, False), (3.01, True)):
            positions = np.repeat(system.positions[None], 2, axis=0)
            positions[1, j + 1 :, 0] += times * (length or 0.4) - 0.2
            run = Trajectory(np.array([0.0, 1.0]), positions, np.zeros_like(positions))
            assert first_diverged_frame(system, run, 3.0) == (1 if told else 2)


def test_what_only_pushes_or_breaks_may_be_of_any_length() -> None:
    """And no other spring of the same system; a change that breaks it is known beforehand."""
    far, near = trajectory(2.0, 1e4), trajectory(2.0, 3.0)
    near.positions[1, 1, 0] = -1e4
    opens = replace(STRING, nonlinear=NonlinearSprings(compression_only=np.array([False, True])))
    breaks = replace(STRING, nonlinear=NonlinearSprings(breaking_stretch=np.array([np.inf, 0.5])))
    assert first_diverged_frame(STRING, far, 100.0) == 1
    assert first_diverged_frame(opens, far, 100.0) == first_diverged_frame(breaks, far, 100.0) == 2
    assert first_diverged_frame(opens, near, 100.0) == first_diverged_frame(breaks, near, 100.0) == 1
    assert outcome.first_blown_up_frame(breaks, near, 100.0) == 1
    assert outcome.first_blown_up_frame(breaks, trajectory(2.0, 150.0), 100.0, (Change(0.0, "break", (0.0,)),)) == 2
