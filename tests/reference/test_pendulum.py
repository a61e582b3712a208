"""The n-fold pendulum: energy, small swings, and that it is what a string becomes as it stiffens."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.conserved import energy
from reference.errors import InputError
from reference.pendulum import PendulumMotion, why_no_pendulum
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from reference.state import Array, State
from reference.system import MassSpringSystem
from reference.theory.exact import exact
from reference.theory.modes import laguerre_frequencies
from tests import wrong
from tests.reference.systems import label, moving_string, property_test, random_mesh, seeds, with_fields

#: Makes equations of motion of a system: the right ones, or wrong ones.
EquationsOf = Callable[[MassSpringSystem], PendulumMotion]


def hanging(masses: int, seed: int, drag: float = 0.0) -> MassSpringSystem:
    """A string of unequal masses and lengths at random angles, turning as rods can."""
    rng = np.random.default_rng(seed)
    mass, lengths = rng.uniform(0.01, 0.1, masses), rng.uniform(0.05, 0.3, masses)
    system = find_scene("string").system(
        {"masses": masses, "mass": mass.tolist(), "rest_length": lengths.tolist(), "drag": drag, "x0": 0.2, "y0": 0.4}
    )
    angles, rates = rng.uniform(-np.pi, np.pi, masses), rng.normal(size=masses)
    along = np.stack([np.sin(angles), -np.cos(angles)], axis=1)
    across = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    still = np.zeros((1, 2))
    positions = system.positions[0] + np.concatenate([still, np.cumsum(lengths[:, None] * along, axis=0)])
    velocities = np.concatenate([still, np.cumsum((lengths * rates)[:, None] * across, axis=0)])
    return replace(system, positions=positions, velocities=velocities)


class Upwards(PendulumMotion):
    """Gravity's torque has the wrong sign."""

    def __init__(self, system: MassSpringSystem) -> None:
        super().__init__(replace(system, gravity=-system.gravity))


class WithoutSwing(PendulumMotion):
    """The terms in the squares of the angular velocities are forgotten."""

    def acceleration(self, state: State) -> Array:
        """As if at rest, but for drag."""
        return super().acceleration(State(state.time, state.positions, 0.0 * state.velocities))


class Weak(PendulumMotion):
    """Gravity too weak by a part in a million."""

    def __init__(self, system: MassSpringSystem) -> None:
        super().__init__(replace(system, gravity=(1 - 1e-6) * system.gravity))


# --- Energy ---


def check_energy(scheme: Scheme, equations: EquationsOf) -> None:
    """Kinetic plus potential energy of the masses is constant, by rk4 with dt = 0.1 ms to 1e-9 of what turns over.

    rk4 gains or loses about (dt w)^5 a step: with w < 50/s some 3e-12/72, over 1000 steps 1e-10.
    """
    system = hanging(3, 4)
    run = simulate(system, scheme, 1e-4, 0.1, equations=equations)
    energies = np.array([energy(system, s) for s in run.states()])
    kinetic = 0.5 * (run.velocities**2).sum(axis=2) @ system.masses
    assert np.ptp(energies) < 1e-9 * kinetic.max()
    assert np.ptp(kinetic) > 0.1 * kinetic.max()


def test_rk4_keeps_the_pendulums_energy() -> None:
    """A triple pendulum of unequal rods, thrown."""
    check_energy(find("rk4"), PendulumMotion)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("equations", [Upwards, WithoutSwing, Weak], ids=label)
def test_energy_fails_on_wrong_equations(equations: EquationsOf) -> None:
    """Gravity upwards, or too weak by 1e-6, or no centrifugal terms."""
    with pytest.raises(AssertionError):
        check_energy(find("rk4"), equations)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("scheme", [find("euler"), wrong.rk4_equally_weighted, wrong.heun_without_half], ids=label)
def test_energy_fails_on_wrong_integrators(scheme: Scheme) -> None:
    """Of lower order or wrong."""
    with pytest.raises(AssertionError):
        check_energy(scheme, PendulumMotion)


# --- Newton ---


def check_newton(equations: EquationsOf, system: MassSpringSystem) -> None:
    """The masses move as Newton says: m a - m g + Cd v is, on each mass, the pull of its rods, and of nothing else.

    From the tip: what is left on mass i, with what its lower rod hands on, lies along rod i. With th the angles, the
    masses' accelerations are sums of l (th'' (cos, sin) + th'^2 (-sin, cos)). Rounding is multiplied by the condition
    of the inertia matrix, up to some 1e4 where rods nearly line up: 1e-10 of the forces.
    """
    motion = equations(system)
    angles, rates, bends = motion.start.positions, motion.start.velocities, motion.acceleration(motion.start)
    across, inwards = (
        np.stack(v, axis=1) for v in ((np.cos(angles), np.sin(angles)), (-np.sin(angles), np.cos(angles)))
    )
    of_rods = system.rest_lengths[:, None] * (bends[:, None] * across + rates[:, None] ** 2 * inwards)
    accelerations = np.cumsum(of_rods, axis=0)
    left = system.masses[1:, None] * (accelerations - system.gravity) + system.drag * system.velocities[1:]
    pulls = np.cumsum(left[::-1], axis=0)[::-1]
    assert np.abs((pulls * across).sum(axis=1)).max() < 1e-10 * np.abs(pulls).max()


@property_test
@given(seed=seeds, masses=st.integers(1, 6), drag=st.floats(0.0, 0.1))
def test_rods_only_pull_along_themselves(seed: int, masses: int, drag: float) -> None:
    """D'Alembert's principle, with unequal masses, lengths, velocities and drag: what defines the pendulum."""
    check_newton(PendulumMotion, hanging(masses, seed, drag))


class Dragless(PendulumMotion):
    """Drag is forgotten."""

    def __init__(self, system: MassSpringSystem) -> None:
        super().__init__(replace(system, drag=0.0))


@pytest.mark.parametrize("equations", [Upwards, WithoutSwing, Dragless], ids=label)
def test_newton_fails_on_wrong_equations(equations: EquationsOf) -> None:
    """Each would need a rod that pushes sideways."""
    with pytest.raises(AssertionError):
        check_newton(equations, hanging(4, 1, 0.05))


# --- Small swings ---


def small_frequencies(equations: EquationsOf, masses: int) -> Array:
    """The squares of the frequencies about hanging straight, from differences of the angular accelerations."""
    system = find_scene("string").system({"masses": masses, "angle": 90.0})
    motion = equations(system)
    h = 1e-3
    columns = []
    for push in h * np.eye(masses):
        at = {i: motion.acceleration(State(0.0, i * push, np.zeros(masses))) for i in (-2, -1, 1, 2)}
        columns.append((8 * (at[1] - at[-1]) - (at[2] - at[-2])) / (12 * h))
    return np.sort(-np.linalg.eigvals(np.array(columns).T).real)


def check_laguerre(equations: EquationsOf, masses: int) -> None:
    """Squares are (g/l) x_i with x_i the zeros of L_n.

    Differences of fourth order are off by h^4 times the fifth derivative, which for ten rods is some 1e3 times w^2.
    """
    squares = small_frequencies(equations, masses)
    assert squares == pytest.approx(laguerre_frequencies(masses, 0.125, 9.81), rel=1e-7)


@pytest.mark.parametrize("masses", [1, 2, 3, 10])
def test_small_swings_have_laguerres_frequencies(masses: int) -> None:
    """One mass: g/l. Ten: from 0.138 to 29.9 times that."""
    check_laguerre(PendulumMotion, masses)


def test_small_swings_of_one_mass() -> None:
    """Closed form: w^2 = g/l."""
    assert small_frequencies(PendulumMotion, 1)[0] == pytest.approx(9.81 / 0.125, rel=1e-8)


@pytest.mark.parametrize("equations", [Upwards, Weak], ids=label)
def test_laguerre_fails_on_wrong_gravity(equations: EquationsOf) -> None:
    """Hanging upwards there are no frequencies; a part in a million is seen."""
    with pytest.raises(AssertionError):
        check_laguerre(equations, 3)


# --- The stiff limit ---


def check_stiff_limit(equations: EquationsOf) -> None:
    """Strings of stiffness k come to the pendulum as 1/k: a hundredth of the distance at a hundred times the stiffness.

    The next term goes as 1/k of the first: from k = 2e3 to 2e5 N/m the ratio is 100 to some per cent.
    """
    still = find_scene("string").system({"masses": 3})
    rods = exact(still, 0.01, 15, equations=equations)
    far, near = (
        float(exact(find_scene("string").system({"masses": 3, "stiffness": k}), 0.01, 15).distance(rods).max())
        for k in (2e3, 2e5)
    )
    assert far / near == pytest.approx(100.0, rel=0.1)


def test_a_stiff_string_is_a_pendulum() -> None:
    """Let go horizontally."""
    check_stiff_limit(PendulumMotion)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("equations", [Upwards, WithoutSwing], ids=label)
def test_stiff_limit_fails_on_wrong_equations(equations: EquationsOf) -> None:
    """Strings come to another motion."""
    with pytest.raises(AssertionError):
        check_stiff_limit(equations)


# --- Around it ---


@property_test
@given(seed=seeds, masses=st.integers(1, 8))
def test_angles_say_where_the_masses_are(seed: int, masses: int) -> None:
    """System -> angles -> masses gives the same positions and velocities, to rounding."""
    system = hanging(masses, seed)
    motion = PendulumMotion(system)
    start = motion.trajectory([motion.start])
    assert np.abs(start.positions[0] - system.positions).max() < 1e-14
    assert np.abs(start.velocities[0] - system.velocities).max() < 1e-13


def test_rods_keep_their_length_whatever_the_scheme() -> None:
    """Even Euler with large steps: the angles may be wrong, not the rods."""
    system = hanging(4, 3)
    run = simulate(system, find("euler"), 0.01, 0.2, equations=PendulumMotion)
    lengths = np.linalg.norm(np.diff(run.positions, axis=1), axis=2)
    assert np.abs(lengths - system.rest_lengths).max() < 1e-14


def test_tilted_gravity_tilts_the_rest() -> None:
    """Along gravity there is no torque."""
    system = replace(find_scene("string").system({"masses": 2}), gravity=np.array([3.0, -4.0]))
    motion = PendulumMotion(system)
    angle = np.arctan2(3.0, 4.0)
    assert np.abs(motion.acceleration(State(0.0, np.full(2, angle), np.zeros(2)))).max() < 1e-14


def stretching() -> MassSpringSystem:
    """A string whose mass moves along its spring."""
    system = find_scene("string").system({"masses": 1})
    return replace(system, velocities=np.array([[0.0, 0.0], [0.1, 0.2]]))


@pytest.mark.parametrize(
    ("system", "reason"),
    [
        (random_mesh(1, 5, 2), "expected a string in 2D, fixed at its first mass only"),
        (random_mesh(1, 5, 3), "expected a string in 2D, fixed at its first mass only"),
        (
            replace(find_scene("string").system({}), fixed=np.arange(11) % 10 == 0),
            "expected a string in 2D, fixed at its first mass only",
        ),
        (
            with_fields(find_scene("string").system({}), fixed=False),
            "expected a string in 2D, fixed at its first mass only",
        ),
        (
            find_scene("string").system({}).renumbered(np.arange(11)[::-1]),
            "expected a string in 2D, fixed at its first mass only",
        ),
        (moving_string(3), "expected every spring to start at its rest length"),
        (stretching(), "expected velocities that do not stretch any spring"),
        (
            replace(find_scene("string").system({"masses": 3}), rest_lengths=np.array([0.125, 0.126, 0.125])),
            "expected every spring to start at its rest length",
        ),
        (
            replace(
                find_scene("string").system({"masses": 2}), velocities=np.array([[0.0, 0.0], [0.0, 1.0], [0.1, 1.0]])
            ),
            "expected velocities that do not stretch any spring",
        ),
    ],
)
def test_other_systems_are_refused_with_the_reason(system: MassSpringSystem, reason: str) -> None:
    """By the question and by the equations alike."""
    assert why_no_pendulum(system) == reason
    with pytest.raises(InputError) as refused:
        PendulumMotion(system)
    assert str(refused.value) == f"no pendulum: {reason}"


@pytest.mark.parametrize("system", [find_scene("string").system({"angle": 33.0}), hanging(5, 2), hanging(1, 9, 0.1)])
def test_strings_at_their_rest_lengths_are_pendulums(system: MassSpringSystem) -> None:
    """At any angle, and turning."""
    assert why_no_pendulum(system) is None
