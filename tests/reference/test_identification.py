"""Identification: every scheme is known by its name, and nothing that is wrong by more than rounding is."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference.changes import Change
from reference.identification import (
    NOISE,
    TOLERANCE,
    Identification,
    Match,
    candidates,
    identify,
    identify_run,
)
from reference.outcome import Outcome
from reference.scenes import find as find_scene
from reference.schemes import catalogue
from reference.schemes.catalogue import Scheme, find, schemes, wide_schemes
from reference.schemes.constrained import ROPE_KICK_DRIFT
from reference.state import Trajectory
from reference.stepper import SchemeStepper, catalogued
from reference.system import MassSpringSystem
from reference.theory.exact import exact
from tests import wrong
from tests.reference.identified import DT, PARAMETERS, SAME_AS, STEPS, Recorded, known, shifted
from tests.reference.systems import IN_PLACE, WHOLE_STATE, label, moving_string, property_test, seeds


def identified(scheme: Scheme, case: str) -> Identification:
    """What a scheme is found to be on that string."""
    system, trajectories = known(case)
    outcome = SchemeStepper(scheme).run(system, DT, STEPS)
    return identify_run(scheme.name, outcome, system, trajectories)


def check_identified(scheme: Scheme, case: str, expected: str) -> None:
    """It is found to be that scheme, to 1e-12 of the string's size, and what else matches is the same by theory."""
    found = identified(scheme, case)
    system, _ = known(case)
    assert found.identified_as == expected
    assert found.error <= 1e-12 * system.size
    others = [m.scheme for m in found.matches]
    assert all(SAME_AS[case].get(other, other) == expected for other in others if other in TEXTBOOK)


#: The schemes of which theory says with which they are one.
TEXTBOOK = [s.name for s in schemes().values() if s.step.__module__ in catalogue.FIRST]


@pytest.mark.rotating(3)
@pytest.mark.parametrize("case", PARAMETERS)
@pytest.mark.parametrize("name", TEXTBOOK)
def test_every_scheme_is_identified_as_itself_or_its_equal(name: str, case: str) -> None:
    """As itself, or as the one that theory says is the same there; nothing else matches."""
    check_identified(find(name), case, SAME_AS[case].get(name, name))


@pytest.mark.rotating(3)
@pytest.mark.parametrize("case", PARAMETERS)
@pytest.mark.parametrize("scheme", schemes().values(), ids=label)
def test_every_scheme_is_among_those_that_match_its_run(scheme: Scheme, case: str) -> None:
    """Whoever enters one: to the bit, as it is itself."""
    matches = {m.scheme: m.error for m in identified(scheme, case).matches}
    assert matches[scheme.name] == 0.0


@pytest.mark.parametrize("case", ["plain", "both"])
@pytest.mark.parametrize(
    ("scheme", "pretends_to_be"),
    [
        (wrong.heun_without_half, "heun"),
        (wrong.heun_of_the_wrong_pair, "heun"),
        (wrong.heun_back_in_time, "heun"),
        (wrong.verlet_with_one_force, "velocity_verlet"),
        (wrong.rk4_equally_weighted, "rk4"),
        (wrong.kick_drift_kicked_twice, "kick_drift"),
        (wrong.kick_drift_gaining_energy, "kick_drift"),
        (wrong.last_mass_forgotten, "kick_drift"),
        (wrong.in_order_of_number, "kick_drift"),
        (wrong.explicit_in_place_of_backward, "backward_euler"),
        (wrong.stepped(wrong.slightly_stronger, find("rk4")), "rk4"),
        (wrong.stepped(wrong.sideways, find("heun")), "heun"),
    ],
    ids=label,
)
def test_identification_fails_on_wrong_schemes(scheme: Scheme, pretends_to_be: str, case: str) -> None:
    """None of them passes for what it pretends to be, nor for anything else."""
    with pytest.raises(AssertionError):
        check_identified(scheme, case, pretends_to_be)
    assert identified(scheme, case).identified_as is None


@pytest.mark.parametrize("case", PARAMETERS)
@pytest.mark.parametrize("name", ["kick_drift", "heun", "rk4"])
def test_forces_wrong_by_a_part_in_1e9_are_not_identified(name: str, case: str) -> None:
    """The tolerance is rounding's: the nearest is named, at some 1e-10 m, but not as what it is."""
    found = identified(wrong.stepped(wrong.slightly_stronger, find(name)), case)
    assert found.identified_as is None
    assert found.ranking[0].scheme == name
    assert 1e-11 < found.error < 1e-8
    assert str(found) == f"{name}_with_slightly_stronger: not identified; nearest {name} at {found.error:.2g} m"


@cache
def known_at_rest(masses: int, case: str) -> tuple[MassSpringSystem, dict[str, Trajectory]]:
    """The scene `string`, let go at rest, and the catalogue's trajectories of it."""
    system = find_scene("string").system({"masses": masses, **PARAMETERS[case]})
    return system, candidates(system, DT, 30)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("masses", [2, 10])
@pytest.mark.parametrize("case", PARAMETERS)
@pytest.mark.parametrize("scheme", IN_PLACE, ids=label)
def test_in_place_schemes_are_never_taken_for_right_ones(scheme: Scheme, case: str, masses: int) -> None:
    """Not even on two masses let go at rest: all that matches is in place."""
    system, trajectories = known_at_rest(masses, case)
    found = identify_run(scheme.name, SchemeStepper(scheme).run(system, DT, 30), system, trajectories)
    assert found.identified_as == scheme.name
    assert all(schemes()[m.scheme].kind == "in_place" for m in found.matches)


@pytest.mark.parametrize("scheme", IN_PLACE, ids=label)
def test_one_mass_cannot_tell_in_place_from_right(scheme: Scheme) -> None:
    """By theory they are one there: the right one, simpler, is named, and the other stands among the matches."""
    found = identify(SchemeStepper(scheme), moving_string(1, **PARAMETERS["both"]), DT, 50)
    assert found.identified_as in ("euler", "heun")
    assert scheme.name in {m.scheme for m in found.matches}


@pytest.mark.parametrize("name", ["euler", "kick_drift", "heun", "rk4", "euler_in_place"])
def test_a_run_that_blows_up_is_identified_by_its_first_steps(name: str) -> None:
    """At dt = 0.03 s, three times the stable one, before the springs are three times their length."""
    system = moving_string(6)
    stepper = SchemeStepper(find(name))
    assert stepper.run(system, 0.03, 60).ending == "diverged"
    found = identify(stepper, system, 0.03, 60)
    assert found.identified_as == name


def test_a_run_that_blows_up_is_compared_only_until_it_does() -> None:
    """Rounding grows with the positions: with noise of 1e-15 in every number it is still known by its first steps."""
    system = moving_string(6)
    outcome = SchemeStepper(find("heun")).run(system, 0.03, 40)
    assert outcome.ending == "diverged"
    assert outcome.trajectory is not None
    noise = 1 + 1e-15 * np.random.default_rng(0).normal(size=outcome.trajectory.positions.shape)
    noisy = replace(outcome.trajectory, positions=outcome.trajectory.positions * noise)
    found = identify(Recorded(replace(outcome, trajectory=noisy)), system, 0.03, 40)
    assert found.identified_as == "heun"


@pytest.mark.rotating(2)
@settings(property_test, max_examples=20)
@given(seed=seeds, masses=st.integers(2, 12), index=st.integers(0, len(WHOLE_STATE) - 1))
def test_identification_holds_on_random_strings(seed: int, masses: int, index: int) -> None:
    """Any scheme, on strings of any parameters, dt up to half of kick-drift's limit, is among its matches."""
    rng = np.random.default_rng(seed)
    mass, stiffness = float(rng.uniform(0.005, 0.1)), float(rng.uniform(20, 2000))
    parameters = {
        "mass": mass,
        "stiffness": stiffness,
        "rest_length": float(rng.uniform(0.02, 1.0)),
        "damping": float(rng.choice([0.0, rng.uniform(0, 0.1)])),
        "drag": float(rng.choice([0.0, rng.uniform(0, 0.1)])),
    }
    system = moving_string(masses, seed, **parameters)
    dt = float(rng.uniform(0.05, 0.5)) * np.sqrt(mass / stiffness)
    scheme = WHOLE_STATE[index]
    found = identify(SchemeStepper(scheme), system, dt, 20)
    assert scheme.name in {m.scheme for m in found.matches}
    assert found.identified_as is not None
    assert find(found.identified_as).kind != "in_place"


@pytest.mark.parametrize("name", [n for n, s in catalogued().items() if s.kind == "pendulum"])
def test_pendulum_schemes_are_identified(name: str) -> None:
    """Rods are known from springs, whatever the scheme."""
    system = find_scene("string").system({"masses": 3})
    found = identify(catalogued()[name], system, DT, 50)
    assert found.identified_as == name
    assert [m.scheme for m in found.matches] == [name]


# --- Ranking ---


def test_true_motion_is_no_scheme_and_nearest_to_rk4() -> None:
    """The exact solution is not identified; the ranking is by distance, the highest orders first."""
    system, _ = known("plain")
    found = identify(Recorded(Outcome("done", "", exact(system, DT, STEPS))), system, DT, STEPS)
    assert found.identified_as is None
    errors = [m.error for m in found.ranking]
    assert errors == sorted(errors)
    assert found.ranking[0].scheme == "dormand_prince"
    orders = [find(m.scheme).order for m in found.ranking if m.scheme in schemes()]
    assert orders == sorted(orders, reverse=True)


@pytest.mark.parametrize(
    ("errors", "order", "named"),
    [
        ({"simple": 0.0, "nearer": 0.0}, ["simple", "nearer"], "simple"),
        ({"simple": 5e-16, "nearer": 0.0}, ["simple", "nearer"], "simple"),
        ({"simple": 1e-13, "nearer": 0.0}, ["nearer", "simple"], "nearer"),
        ({"simple": 5e-13, "nearer": 3e-13}, ["simple", "nearer"], "simple"),
        ({"simple": 2e-12, "nearer": 5e-13}, ["nearer", "simple"], "nearer"),
        ({"simple": 9e-3, "nearer": 1e-3}, ["nearer", "simple"], None),
        ({"simple": 1.01e-12, "nearer": 2e-12}, ["simple", "nearer"], None),
    ],
)
def test_ranking_is_by_distance_and_rounding_ties_go_to_the_simpler(
    errors: dict[str, float], order: list[str], named: str | None
) -> None:
    """Distances within rounding are one as good as the other; without a match the nearest is the nearest.

    The string is 1 m long, so that the tolerance is 1e-12 m and noise 1e-14 m.
    """
    system = find_scene("string").system({"masses": 1, "rest_length": 1.0})
    assert (TOLERANCE, NOISE) == (1e-12, 1e-14)
    outcome = Outcome("done", "", shifted(system, 0.0))
    trajectories = {name: shifted(system, -error) for name, error in errors.items()}
    found = identify_run("it", outcome, system, trajectories)
    assert [m.scheme for m in found.ranking] == order
    assert found.identified_as == named
    # Positions of 1 m round by 1e-16 m.
    assert found.ranking[0].error == pytest.approx(errors[order[0]], abs=2e-16)


def test_the_tolerance_grows_with_the_systems_size() -> None:
    """1e-12 of the string's length, or of how far a push takes it, a tenth of a spring at most."""
    for length in (0.01, 100.0):
        system = find_scene("string").system({"masses": 2, "rest_length": length})
        found = identify(SchemeStepper(find("heun")), system, DT, 5)
        assert found.tolerance == pytest.approx(1e-12 * 2 * length, rel=0.1)


# --- What is said ---


def test_an_identified_stepper_is_named() -> None:
    """With its deviation."""
    found = Identification("engine", (Match("heun", 2.34e-16), Match("rk4", 1e-3)), 1e-12)
    assert str(found) == "engine is heun, to 2.3e-16 m"
    assert found.matches == (Match("heun", 2.34e-16),)


@pytest.mark.parametrize("ending", ["crashed", "timed out", "unsupported", "diverged"])
def test_a_stepper_that_left_nothing_is_not_identified_and_the_reason_is_kept(ending: Any) -> None:
    """No trajectory, no ranking."""
    system, _ = known("plain")
    found = identify(Recorded(Outcome(ending, "killed by SIGSEGV")), system, DT, STEPS)
    assert found.identified_as is None
    assert found.ranking == ()
    assert found.error == np.inf
    assert str(found) == "recorded: not identified; killed by SIGSEGV"


def test_a_run_that_blew_up_at_once_is_not_identified() -> None:
    """One frame is no motion."""
    system, _ = known("plain")
    found = identify(Recorded(Outcome("diverged", "gone", shifted(system, 1e9))), system, DT, STEPS)
    assert str(found).startswith("recorded: not identified; it blew up in its first step; by single steps, nearest ")


def test_changes_on_the_fly_are_given_to_stepper_and_catalogue() -> None:
    """A stepper that ignores the change is not identified."""
    system, _ = known("plain")
    changes = (Change(0.05, "stiffness", 150.0),)
    assert identify(SchemeStepper(find("heun")), system, DT, STEPS, changes).identified_as == "heun"
    deaf = Recorded(SchemeStepper(find("heun")).run(system, DT, STEPS))
    assert identify(deaf, system, DT, STEPS, changes).identified_as is None


def test_steppers_of_rods_do_not_enter_where_there_are_none() -> None:
    """On a stretched string the catalogue has no pendulum candidates; a rope's rods are brought to their lengths."""
    _, trajectories = known("plain")
    assert set(trajectories) == {*schemes(), *wide_schemes(), ROPE_KICK_DRIFT.name}


def stretched_by(ratios: list[float], off: dict[int, float]) -> Trajectory:
    """A spring of 1 m, so many times as long in each frame; in some frames its mass is off sideways [m]."""
    positions = np.zeros((len(ratios), 2, 2))
    positions[:, 1, 0] = ratios
    positions[list(off), 1, 1] = list(off.values())
    return Trajectory(np.arange(len(ratios)) * DT, positions, np.zeros_like(positions))


@pytest.mark.parametrize(("frame", "seen"), [(1, True), (4, True), (5, False), (6, False)])
def test_a_blow_up_is_compared_while_springs_are_up_to_three_times_as_long(frame: int, seen: bool) -> None:
    """A micrometre off in a frame before counts, and in one after that counts for nothing."""
    system = find_scene("spring").system({"rest_length": 1.0, "stretch": 0.0})
    ratios = [1.0, 1.0, 2.0, 2.5, 2.99, 3.01, 200.0]
    outcome = Outcome("diverged", "gone", stretched_by(ratios, {frame: 1e-6}))
    found = identify_run("it", outcome, system, {"simple": stretched_by(ratios, {})})
    assert found.error == pytest.approx(1e-6 if seen else 0.0)
    assert found.identified_as == (None if seen else "simple")
