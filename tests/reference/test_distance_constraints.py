"""Rods in the masses' own coordinates: that they are the pendulum, and how MuJoCo's scheme keeps their lengths."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.collisions.round_masses import Collisions
from reference.distance_constraints import DENSE_UP_TO, Rods, RopeMotion
from reference.errors import InputError, SolverError
from reference.motion import MotionOfRods
from reference.pendulum import PendulumMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme
from reference.schemes.constrained import COMPLIANCE, IMPEDANCE, ROPE_KICK_DRIFT
from reference.simulate import simulate
from reference.springs.angular import AngularSprings
from reference.springs.kinds import NonlinearSprings
from reference.state import Array, State
from reference.stepper import catalogued
from reference.system import MassSpringSystem
from reference.theory.equilibria import equilibrium_of
from reference.theory.exact import exact
from reference.theory.limits import growth
from tests.reference.systems import label, property_test, random_mesh, seeds
from tests.reference.test_pendulum import hanging

#: Makes equations of motion of a system: the right ones, or wrong ones.
EquationsOf = Callable[[MassSpringSystem], RopeMotion]


class WithoutTurning(RopeMotion):
    """Rods pull as if they did not turn."""

    def rods(self, state: State) -> Rods:
        """Nothing across."""
        return replace(super().rods(state), across=np.zeros_like(super().rods(state).across))


class Dragless(RopeMotion):
    """Drag is forgotten."""

    def __init__(self, system: MassSpringSystem) -> None:
        super().__init__(replace(system, drag=0.0))


class OneSided(RopeMotion):
    """Rods pull at their second masses only."""

    def rows(self, rods: Rods) -> Array:
        """No entries for the first."""
        found = super().rows(rods)
        found[np.arange(len(found)), self._ends[0]] = 0.0
        return found


WRONG = [WithoutTurning, Dragless, OneSided]


# --- The equations ---


def check_is_the_pendulum(equations: EquationsOf, system: MassSpringSystem) -> None:
    """The masses' accelerations are those that the pendulum's angles give: sums of l (th'' (c, s) + th'^2 (-s, c)).

    Rounding is multiplied by the condition of J M^-1 J^T, up to some 1e4 where rods nearly line up: 1e-10.
    """
    pendulum = PendulumMotion(system)
    angles, rates, bends = pendulum.start.positions, pendulum.start.velocities, pendulum.acceleration(pendulum.start)
    c, s = np.cos(angles), np.sin(angles)
    of_rods = bends[:, None] * np.stack([c, s], axis=1) + (rates**2)[:, None] * np.stack([-s, c], axis=1)
    expected = np.cumsum(system.rest_lengths[:, None] * of_rods, axis=0)
    found = equations(system).acceleration(system.start)
    assert not found[0].any()
    assert np.abs(found[1:] - expected).max() < 1e-10 * np.abs(expected).max()


@property_test
@given(seed=seeds, masses=st.integers(1, 6), drag=st.floats(0.0, 0.1))
def test_a_string_of_rods_is_the_pendulum(seed: int, masses: int, drag: float) -> None:
    """In other coordinates, by other equations: with unequal masses and lengths, thrown, with drag."""
    check_is_the_pendulum(RopeMotion, hanging(masses, seed, drag))


@pytest.mark.parametrize("equations", WRONG, ids=label)
def test_it_is_not_with_wrong_equations(equations: EquationsOf) -> None:
    """Each mistake shows."""
    with pytest.raises(AssertionError):
        check_is_the_pendulum(equations, hanging(4, 1, 0.05))


def test_the_true_motion_is_the_pendulums() -> None:
    """Both solved by DOP853, to 1e-11 of the size each; rods that are only told to stay so may drift off by as much."""
    system = hanging(3, 2, 0.02)
    rope, pendulum = (exact(system, 0.02, 10, equations=e) for e in (RopeMotion, PendulumMotion))
    assert rope.distance(pendulum).max() < 1e-10 * system.size


def check_rods(equations: EquationsOf, system: MassSpringSystem) -> None:
    """On any mesh: no rod begins to lengthen, u.(a_b - a_a) + |w across u|^2 / L = 0. And the pulls cancel.

    The sum of m a is that of weights and drag where nothing is fixed. Rounding as above, relative to accelerations.
    """
    motion, state = equations(system), system.start
    accelerations = motion.acceleration(state)
    a, b = system.springs.T
    gap, w = state.positions[b] - state.positions[a], state.velocities[b] - state.velocities[a]
    length = np.linalg.norm(gap, axis=1)
    u = gap / length[:, None]
    along = (u * w).sum(axis=1)
    lengthening = (u * (accelerations[b] - accelerations[a])).sum(axis=1) + ((w**2).sum(axis=1) - along**2) / length
    assert np.abs(lengthening).max() < 1e-9 * np.abs(accelerations).max()
    outer = system.masses[:, None] * system.gravity - system.drag * state.velocities
    left = (system.masses[:, None] * accelerations - outer).sum(axis=0)
    assert np.abs(left).max() < 1e-9 * np.abs(system.masses[:, None] * accelerations).max()


def tree(seed: int, masses: int) -> MassSpringSystem:
    """A random tree in three dimensions that nothing holds: its rods can always move."""
    mesh, rng = random_mesh(seed, masses, 3, anchors=0), np.random.default_rng(seed)
    springs = np.array([[rng.integers(i), i] for i in range(1, masses)])
    gap = np.linalg.norm(mesh.positions[springs[:, 1]] - mesh.positions[springs[:, 0]], axis=1)
    ones = np.ones(len(springs))
    return replace(mesh, springs=springs, rest_lengths=gap, stiffness=ones, damping=ones, drag=0.02)


@property_test
@given(seed=seeds, masses=st.integers(2, 8))
def test_rods_of_a_tree_neither_lengthen_nor_push_it_away(seed: int, masses: int) -> None:
    """In three dimensions, flying freely."""
    check_rods(RopeMotion, tree(seed, masses))


def test_many_rods_without_give_are_held_exactly() -> None:
    """A chain of more than are solved for as a whole where they have some give, thrown in space."""
    count, rng = DENSE_UP_TO + 11, np.random.default_rng(3)
    chain = MassSpringSystem(
        positions=np.cumsum(rng.normal(size=(count, 3)), axis=0),
        springs=np.stack([np.arange(count - 1), np.arange(1, count)], axis=1),
        masses=rng.uniform(0.1, 1.0, count),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
        drag=0.02,
        velocities=rng.normal(size=(count, 3)),
    )
    check_rods(RopeMotion, chain)


@pytest.mark.parametrize("equations", WRONG, ids=label)
def test_the_check_of_rods_fails_on_wrong_equations(equations: EquationsOf) -> None:
    """Each mistake shows here too."""
    with pytest.raises(AssertionError):
        check_rods(equations, tree(1, 6))


def test_rods_that_hold_one_another_have_no_definite_pulls() -> None:
    """Two between the same masses: only with some give do they share the load, and move as one."""
    one = find_scene("string").system({"masses": 1, "angle": 30})
    two = replace(
        one,
        springs=np.repeat(one.springs, 2, axis=0),
        **{n: np.ones(2) for n in ("stiffness", "damping")},
        rest_lengths=np.repeat(one.rest_lengths, 2),
    )
    with pytest.raises(SolverError, match="definite"):
        RopeMotion(two).acceleration(two.start)
    runs = [catalogued()["rope_kick_drift"].run(system, 1e-3, 100).trajectory for system in (one, two)]
    assert runs[0] is not None
    assert runs[1] is not None
    # twice the rods give half as much: COMPLIANCE of what a step moves
    assert runs[0].distance(runs[1]).max() < 1e-6 * one.size


# --- The scheme ---


def stretching(scheme: Scheme, dt: float, steps: int) -> Array:
    """How much too long a rod is, shape (steps + 1,), and how fast it lengthens: let go stretched, without weight."""
    system = find_scene("spring").system({"gravity": 0.0, "stretch": 0.01})
    run = simulate(system, scheme, dt, steps * dt, equations=RopeMotion)
    gap = run.positions[:, 1] - run.positions[:, 0]
    length = np.linalg.norm(gap, axis=1)
    rate = ((run.velocities[:, 1] - run.velocities[:, 0]) * gap).sum(axis=1) / length
    return np.stack([length - system.rest_lengths[0], rate])


def check_return(scheme: Scheme, dt: float) -> None:
    """One rod, r too long, lengthening at w: w' = w + (-w/d - r/(4 d dt)) / (1 + give), r' = r + dt w'.

    Rounding of lengths only: 1e-15 of the length of about a metre, some steps.
    """
    shares = np.array([[0.0, 1.0], [-1 / (4 * IMPEDANCE * dt), -1 / IMPEDANCE]])
    rate = np.array([0.0, 1.0]) + shares[1] / (1 + COMPLIANCE)
    step = np.array([np.array([1.0, 0.0]) + dt * rate, rate])
    found = stretching(scheme, dt, 20)
    for n in range(21):
        assert np.linalg.matrix_power(step, n) @ found[:, 0] == pytest.approx(found[:, n], abs=1e-13 / dt * 1e-3)


def lazy(motion: MotionOfRods, state: State, dt: float) -> State:
    """With twice the time constant."""
    rods = motion.rods(state)
    asked = -rods.rates / (2 * IMPEDANCE * dt) - (rods.lengths - motion.rest_lengths) / (16 * IMPEDANCE * dt**2)
    return state.kick(dt * motion.constrained(state, rods, asked, COMPLIANCE)).drift(dt)


def careless(motion: MotionOfRods, state: State, dt: float) -> State:
    """True accelerations only: what is too long stays so."""
    return state.kick(dt * motion.acceleration(state)).drift(dt)


WRONG_SCHEMES = [Scheme(step, 1, "engine_scheme") for step in (lazy, careless)]


@pytest.mark.parametrize("dt", [1e-4, 1e-3, 0.02])
def test_a_rod_that_is_too_long_comes_back_as_said(dt: float) -> None:
    """A quarter of what is left in each step, whatever dt."""
    check_return(ROPE_KICK_DRIFT, dt)
    r = stretching(ROPE_KICK_DRIFT, dt, 20)[0]
    assert r[1:] / r[:-1] == pytest.approx(0.75, abs=1e-3)


@pytest.mark.parametrize("scheme", WRONG_SCHEMES, ids=label)
def test_the_check_of_the_return_fails_on_others(scheme: Scheme) -> None:
    """With another time constant, or none."""
    with pytest.raises(AssertionError):
        check_return(scheme, 1e-3)


def check_turning(scheme: Scheme) -> None:
    """A mass that swings at the speed v on a rod of length l keeps it too long by r = 2 d dt^2 v^2 / l.

    Each step goes off the circle by (dt v)^2 / (2 l), and gives back r / (4 d). To the next order in dt, here 1 %.
    """
    system, dt = find_scene("string").system({"masses": 1, "angle": 0}), 1e-4
    run = simulate(system, scheme, dt, 0.1, equations=RopeMotion)
    length = np.linalg.norm(run.positions[-1, 1] - run.positions[-1, 0])
    speed = np.linalg.norm(run.velocities[-1, 1])
    expected = 2 * IMPEDANCE * dt**2 * speed**2 / system.rest_lengths[0]
    assert length - system.rest_lengths[0] == pytest.approx(expected, rel=0.02)


def test_turning_costs_some_length() -> None:
    """To second order in dt."""
    check_turning(ROPE_KICK_DRIFT)


@pytest.mark.parametrize("scheme", WRONG_SCHEMES, ids=label)
def test_the_check_of_turning_fails_on_others(scheme: Scheme) -> None:
    """With another time constant, or none."""
    with pytest.raises(AssertionError):
        check_turning(scheme)


def test_small_swings_are_stable_up_to_the_pendulums_limit() -> None:
    """About hanging straight: dt w < 2 with w^2 = 9.39507 g/l, the largest zero of L_4; within the give, 1e-6."""
    system = find_scene("string").system({"masses": 4})
    rest = equilibrium_of(RopeMotion, system)
    limit = 2 / np.sqrt(9.395070912301133 * 9.81 / 0.125)
    assert growth(ROPE_KICK_DRIFT, rest, (1 - 1e-4) * limit) == pytest.approx(1.0, abs=1e-6)
    assert growth(ROPE_KICK_DRIFT, rest, (1 + 1e-4) * limit) > 1.01


def test_rods_between_fixed_masses_hold_nothing() -> None:
    """They are left out, and so a mesh with some runs to its end; one that is all fixed, too."""
    system = find_scene("string").system({"masses": 3})
    for fixed in ([True, True, False, False], [True] * 4):
        outcome = catalogued()["rope_kick_drift"].run(replace(system, fixed=np.array(fixed)), 1e-3, 10)
        assert outcome.ending == "done"


@pytest.mark.parametrize("motion", [RopeMotion, PendulumMotion], ids=label)
@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"rest_lengths": np.array([0.125, 0.0, 0.125])}, "expected rest lengths > 0"),
        ({"pulls": np.array([[0.0, 0.0], [0.0, 0.0], [0.0, 1.0], [0.0, 0.0]])}, "expected no force that pulls"),
        ({"collisions": Collisions(np.array([0.01, 0.0, 0.01, 0.0]))}, "expected masses that do not collide"),
        ({"nonlinear": NonlinearSprings(hardening=np.array([0.0, 1.0, 0.0]))}, "rods have no hardening"),
        ({"angular_springs": AngularSprings(np.array([[0, 1, 2]]), np.array(1.0))}, "no springs that resist bending"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_what_rods_do_not_have_is_refused(motion: EquationsOf, fields: dict[str, Any], said: str) -> None:
    """One such spring, force or pair among others is enough."""
    system = find_scene("string").system({"masses": 3})
    with pytest.raises(InputError, match=said):
        motion(replace(system, **fields))
