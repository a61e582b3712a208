"""What identification ranks and how it pushes, on runs that are made by hand: two masses, a few frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest

from reference.changes import Change
from reference.identification import identify
from reference.identification.bits import BITS
from reference.identification.naming import _has_step
from reference.identification.pushes import PART, lacking, pushes
from reference.identification.ranking import (
    comparable_frames,
    identify_beginning,
    identify_first_steps,
    identify_run,
    match,
    ranked,
)
from reference.identification.result import Identification, Match
from reference.identification.scale import fastest_rate_bound
from reference.identification.single_steps import TOUCH, Steps, steps_of
from reference.lengths import lengths_and_rates
from reference.obstacles import Plane
from reference.outcome import Outcome
from reference.scenes import find as find_scene
from reference.state import Array, Trajectory
from reference.stepper import stepper_named
from reference.system import MassSpringSystem

DT = 0.5

PAIR = MassSpringSystem(
    positions=np.array([[0.0, 0.0], [2.0, 0.0]]),
    springs=np.array([[0, 1]]),
    masses=np.array([0.5, 3.0]),
    rest_lengths=np.array(2.0),
    stiffness=np.array(4.0),
    gravity=np.zeros(2),
)


def run(off: Array, slower: Array) -> Trajectory:
    """The second mass so far off along y [m], and so much slower along x [m/s], frame by frame."""
    positions = np.repeat(PAIR.positions[None], len(off), axis=0)
    positions[:, 1, 1] += off
    velocities = np.zeros_like(positions)
    velocities[:, 1, 0] -= slower
    return Trajectory(DT * np.arange(len(off)), positions, velocities)


ZERO = np.zeros(5)
STILL = run(ZERO, ZERO)


def test_a_match_is_the_largest_distance_of_positions_and_of_velocities_times_the_step() -> None:
    """In the frames that are asked for; of a run that tells no velocities, of positions only."""
    off, slower = np.array([0.0, 1e-3, 3e-3, 2e-3, 9e-3]), np.array([0.0, 0.02, 0.01, 0.04, 0.9])
    other = run(off, slower)
    found = match("a", STILL, other, 4)
    assert (found.scheme, found.steps) == ("a", 3)
    assert (found.positions, found.velocities) == pytest.approx((3e-3, DT * 0.04), rel=1e-12)
    assert found.error == pytest.approx(0.02, rel=1e-12)
    silent = Trajectory(STILL.times, STILL.positions, np.full_like(STILL.velocities, np.nan))
    assert match("a", silent, other, 4) == Match("a", found.positions, 0.0, 3)
    late = [replace(each, times=each.times + 10) for each in (STILL.frames(slice(2)), other.frames(slice(2)))]
    assert match("a", *late, 2).velocities == pytest.approx(DT * 0.02, rel=1e-12)


def test_of_several_that_are_as_good_as_the_best_the_first_is_named() -> None:
    """Within the noise, or ten times the best, but no more than the limit; the others by their errors."""
    errors = {"a": 5e-3, "b": 3e-9, "c": 2.9e-8, "d": 1e-9, "e": 1e-8, "f": 1e-3}
    listed = [Match(name, error) for name, error in errors.items()]
    assert [m.scheme for m in ranked(listed, 1e-6, 1e-12)] == ["b", "d", "e", "c", "f", "a"]
    assert [m.scheme for m in ranked(listed, 1e-6, 1e-7)] == ["b", "c", "d", "e", "f", "a"]
    assert [m.scheme for m in ranked(listed, 2e-9, 1e-7)] == ["d", "b", "e", "c", "f", "a"]
    assert ranked([], 1.0, 1.0) == ()


def test_what_is_compared_ends_where_a_run_blew_up() -> None:
    """Where a spring is three times its length, or a velocity is no number; all of a run that is done."""
    far = run(np.array([0.0, 5.0, 6.0, 7.0, 8.0]), ZERO)
    assert comparable_frames(Outcome("done", "", far), PAIR) == 5
    # sqrt(2^2 + 5^2) = 5.4 m, sqrt(2^2 + 6^2) = 6.3 m of 2 m
    assert comparable_frames(Outcome("diverged", "", far), PAIR) == 2
    lost = run(ZERO, np.array([0.0, 0.0, 0.0, np.nan, np.nan]))
    assert comparable_frames(Outcome("diverged", "", lost), PAIR) == 3
    silent = run(ZERO, np.array([0.0, *[np.nan] * 4]))
    silent.velocities[1:] = np.nan
    assert comparable_frames(Outcome("diverged", "", silent), PAIR) == 5


def test_the_nearest_is_named_within_a_part_of_the_scale_and_told_of_beyond() -> None:
    """1e-12 of 2 m; by its velocities alone, or by both; or that nothing is known, or it blew up at once."""
    done = Outcome("done", "", STILL)
    near, far = run(np.full(5, 1.9e-12), ZERO), run(np.full(5, 2.3e-12), ZERO)
    assert identify_run("mine", done, PAIR, {"far": far, "near": near}).identified_as == "near"
    assert identify_run("mine", done, PAIR, {"far": far}).identified_as is None
    assert identify_run("mine", done, PAIR, {"far": far}, 2e-12).identified_as == "far"
    assert "nearest far at 2.3e-12 m" in identify_run("mine", done, PAIR, {"far": far}).reason
    slow = run(np.full(5, 1e-13), np.full(5, 0.25))
    words = "nearest slow at 0.12 m, by its velocities times the step; its positions are the same to 1e-13 m"
    assert words in identify_run("mine", done, PAIR, {"slow": slow}).reason
    assert "no scheme of the catalogue can step this system" in identify_run("mine", done, PAIR, {}).reason
    later = run(np.array([0.0, 0.1, 9.0, 9.0, 9.0]), ZERO)
    assert identify_run("mine", Outcome("diverged", "", later), PAIR, {"later": later}).identified_as == "later"
    blown = run(np.array([0.0, 9.0, 9.0, 9.0, 9.0]), ZERO)
    assert "it blew up in its first step" in identify_run("mine", Outcome("diverged", "", blown), PAIR, {}).reason
    assert identify_run("mine", Outcome("crashed", "gone"), PAIR, {"near": near}).reason == "gone"


def test_a_run_may_be_named_by_its_beginning() -> None:
    """By as many steps as each is known for; or by as much as is known of the longest."""
    later = run(np.array([0.0, 0.0, 0.0, 0.5, 0.5]), ZERO)
    begun = Trajectory(STILL.times[:3], STILL.positions[:3], STILL.velocities[:3])
    done = Outcome("done", "", later)
    assert identify_run("mine", done, PAIR, {"still": STILL}).identified_as is None
    assert identify_first_steps("mine", done, PAIR, {"still": (2, begun)}).identified_as == "still"
    found = identify_beginning("mine", done, PAIR, {"still": begun})
    assert (found.identified_as, found.ranking[0].steps) == ("still", 2)


def test_what_is_found_is_said() -> None:
    """Who is named, to what, how; whom it cannot be told from, without what; last those that nothing tells apart."""
    ranking = tuple(
        Match(name, error) for name, error in (("heun", 1e-15), ("b", 2e-15), ("mine", 2e-15), ("c", 3e-15))
    )
    found = Identification("mine", (*ranking, Match("d", 4e-15), Match("far", 0.5)), 1e-12)
    assert (found.identified_as, found.ties, found.error) == ("heun", ("b", "c", "d"), 1e-15)
    assert str(found) == "mine is heun, to 1e-15 m"
    told = replace(found, same_without={"b": "drag", "d": "drag"}, told_apart_by="a push", compared="single steps")
    assert told.remark == "On this scene it cannot be told from b, d (the same without drag); c."
    assert str(told) == "mine is heun, to 1e-15 m a step (by single steps), told apart by a push"
    none = found.without_name("it is random")
    assert (none.identified_as, none.ties, none.remark) == (None, ("heun", "b", "mine", "c", "d"), "")
    assert str(none) == "mine: not identified; it is random"
    assert Identification("mine", (), 1.0).error == np.inf


# --- Pushes ---


def test_a_push_moves_every_free_mass_by_a_part_of_the_shortest_spring() -> None:
    """And as far in a step; the second leaves them where they are, the third turns springs and stretches none."""
    string = find_scene("string").system({"masses": 5, "rest_length": "0.2,0.1,0.3,0.2,0.2", "angle": 30})
    dt = 1 / fastest_rate_bound(string)
    for given, step in ((1e-4, dt), (3 * dt, 3 * dt)):
        stretched, in_motion, turning = pushes(string, given)
        assert [push.dt for push in (stretched, in_motion, turning)] == pytest.approx([step] * 3, rel=1e-12)
        aside = stretched.system.positions - string.positions
        assert 0.5 * PART * 0.1 < np.abs(aside).max() <= PART * 0.1
        assert 0.5 * PART * 0.1 < step * np.abs(stretched.system.velocities).max() <= PART * 0.1
        assert aside.min() < 0 < aside.max()
        assert not aside[0].any()
        assert not stretched.system.velocities[0].any()
        assert np.array_equal(in_motion.system.positions, string.positions)
        assert np.array_equal(in_motion.system.velocities, stretched.system.velocities)
        system = turning.system
        _, rates = lengths_and_rates(system.positions, system.velocities, string.springs, np.ones(5, dtype=bool))
        assert np.abs(rates).max() < 1e-15
        assert np.abs(np.diff(system.velocities, axis=0)).max(axis=1).min() > 0
        words = f"a push of its masses, with dt = {step:.3g} s" if given < step else "a push of its masses"
        assert stretched.words == in_motion.words == turning.words == words


def test_a_push_leads_away_from_obstacles_and_says_so() -> None:
    """What is no string has no third; springs count as they are, where they are shorter than at rest."""
    floor = replace(PAIR, obstacles=(Plane((0.0, -1.0), (0.0, 1.0)),), positions=np.array([[0.0, 0.0], [0.3, 0.4]]))
    stretched, in_motion = pushes(floor, 2.0)
    assert (stretched.system.obstacles, in_motion.system.obstacles) == ((), ())
    assert stretched.words == "a push of its masses, away from obstacles, with dt = 2 s"
    aside = stretched.system.positions - floor.positions
    loose = replace(
        PAIR, springs=np.zeros((0, 2), dtype=int), rest_lengths=np.zeros(0), stiffness=np.zeros(0), damping=np.zeros(0)
    )
    stretched, _ = pushes(loose, 2.0)
    assert (stretched.dt, stretched.words) == (2.0, "a push of its masses")
    # the same push, of the spring's half a metre and of the system's two
    assert stretched.system.positions - loose.positions == pytest.approx(aside * 2 / 0.5, rel=1e-12)
    assert 0.5 * PART * 0.5 < np.abs(aside).max() <= PART * 0.5


def test_no_rate_is_beyond_the_bound() -> None:
    """sqrt(2 k/m) and (2 c + Cd)/m of the lighter mass, each with one spring; nothing moves where all is held."""
    assert fastest_rate_bound(PAIR) == pytest.approx(np.sqrt(2 * 4 / 0.5), rel=1e-15)
    assert fastest_rate_bound(replace(PAIR, damping=np.array([10.0]), drag=2.0)) == pytest.approx(22 / 0.5, rel=1e-15)
    assert fastest_rate_bound(replace(PAIR, fixed=np.array([True, False]))) == pytest.approx(np.sqrt(8 / 3), rel=1e-15)
    assert fastest_rate_bound(replace(PAIR, fixed=np.array([True, True]))) == 0


def test_what_a_system_lacks_is_given_to_it() -> None:
    """A tenth of the least mass over the step, as damping of every spring or as drag; what it has, it keeps."""
    push = next(iter(pushes(PAIR, 2.0)))
    (one, damped), (other, dragged) = lacking(push)
    assert (one, other) == ("damping", "drag")
    assert (damped.system.damping.tolist(), damped.system.drag) == ([0.025], 0.0)
    assert (dragged.system.damping.tolist(), dragged.system.drag) == ([0.0], 0.025)
    assert [word for word, _ in lacking(replace(push, system=damped.system))] == ["drag"]
    assert [word for word, _ in lacking(replace(push, system=dragged.system))] == ["damping"]
    string = find_scene("string").system({"masses": 2, "damping": "0.5,0"})  # one damped spring is damping
    assert [word for word, _ in lacking(next(iter(pushes(string, 1e-3))))] == ["drag"]


def test_steps_that_can_be_compared_are_between_states_of_numbers() -> None:
    """And begin where every mass is slower than the system's size in a step, of 2 m in half a second."""
    assert list(steps_of(STILL, PAIR).systems) == [0, 1, 2, 3]
    lost = run(ZERO, np.array([0.0, 0.0, np.nan, 0.0, 0.0]))  # of one mass of two, along one axis
    assert list(steps_of(lost, PAIR).systems) == [0, 3]
    lost = run(np.array([0.0, 0.0, np.nan, 0.0, 0.0]), ZERO)
    assert list(steps_of(lost, PAIR).systems) == [0, 3]
    size = PAIR.scale
    fast = run(ZERO, np.array([0.0, 0.99 * size / DT, 1.01 * size / DT, 0.0, 0.0]))
    assert list(steps_of(fast, PAIR).systems) == [0, 1, 3]


def test_a_run_of_another_step_or_of_none_has_no_step() -> None:
    """Of half a second, to rounding."""
    assert _has_step(STILL, DT)
    assert not _has_step(STILL, 1.001 * DT)
    assert not _has_step(STILL, 0.999 * DT)
    assert not _has_step(STILL.frames(slice(1)), DT)


@dataclass
class Claiming:
    """A stepper in single precision that steps as one scheme and claims to be others."""

    steps_as: str
    claims: tuple[str, ...]
    name: str = "claiming"
    kind: str = "engine"
    version: str | None = None
    precision: str = "single"

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """As its scheme."""
        return stepper_named(self.steps_as).run(system, dt, steps, changes)


def test_a_scheme_of_single_precision_is_named_by_its_bits() -> None:
    """The first claim of single precision that it is, whatever stands before it; one that it is not is not named so."""
    single, other = "soft_constraints_cold(single=True)", "soft_constraints_relaxed(single=True)"
    system = find_scene("string").system({"masses": 2})
    for claims in ((single,), ("heun", single), (other, single)):
        found = identify(Claiming(single, claims), system, 1e-3, 10)
        assert (found.identified_as, found.compared, found.error) == (single, BITS, 0.0)
        assert found.ranking[0].steps == 10
    assert identify(Claiming(single, (other,)), system, 1e-3, 10).compared != BITS
    assert identify(Claiming("heun", ("heun",)), system, 1e-3, 10).compared != BITS


def test_steps_at_an_obstacle_are_left_out() -> None:
    """Where any free mass touches any of them; a held one may."""
    floor, wall = Plane((0.0, -1.0), (0.0, 1.0)), Plane((9.0, 0.0), (-1.0, 0.0))
    system = replace(PAIR, obstacles=(floor, wall))
    reach = TOUCH * system.scale
    falling = run(np.array([0.0, -1 + 3 * reach, -1 + 0.5 * reach, 0.0, 0.0]), ZERO)
    found = steps_of(falling, system)
    assert (list(found.systems), found.touching) == ([0, 3], True)
    alone = steps_of(falling, replace(system, obstacles=(wall,)))
    assert (list(alone.systems), alone.touching) == ([0, 1, 2, 3], False)
    held = steps_of(falling, replace(system, fixed=np.array([False, True])))
    assert (list(held.systems), held.touching) == ([0, 1, 2, 3], False)


@pytest.mark.parametrize(
    ("most", "expected"), [(4, [0, 3, 6, 9]), (2, [0, 9]), (10, list(range(10))), (25, list(range(10)))]
)
def test_of_many_steps_a_few_are_compared_evenly_spread(most: int, expected: list[int]) -> None:
    """The first and the last among them; of few steps all, and none twice."""
    still = np.zeros((11, 2, 2))
    steps = Steps(Trajectory(DT * np.arange(11.0), still, still), dict.fromkeys(range(10), PAIR), False)
    assert list(steps.spread(most).systems) == expected
