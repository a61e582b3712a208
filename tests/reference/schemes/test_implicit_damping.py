"""The engines' schemes for damped springs: what a step leaves of a motion, in closed form.

Order, momentum, one-mass step matrices and renumbering are with the checks for all schemes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.conserved import energy
from reference.forces import SpringMotion
from reference.schemes import implicit_damping
from reference.schemes.catalogue import Scheme, find
from reference.schemes.implicit_damping import effective_masses, sequential_impulses, slowed, spring_directions
from reference.simulate import simulate
from reference.state import Array, State
from reference.system import MassSpringSystem
from tests import wrong
from tests.reference.systems import (
    SOLVED,
    SOLVED_TO,
    label,
    meshes,
    moving_string,
    property_test,
    random_mesh,
    with_fields,
)

ENGINE_SCHEMES = [s for s in SOLVED if s.kind == "engine_scheme"]

# --- Two masses and a spring ---


def pair(damping: float) -> MassSpringSystem:
    """0.02 and 0.06 kg, joined by a damper without stiffness, flying apart and sideways in free space."""
    return MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.3, 0.4]]),
        springs=np.array([[0, 1]]),
        masses=np.array([0.02, 0.06]),
        rest_lengths=np.array(0.5),
        stiffness=np.array(0.0),
        damping=np.array(damping),
        gravity=np.array(0.0),
        velocities=np.array([[1.0, -2.0], [0.5, 3.0]]),
    )


def kept_rate(scheme: Scheme, damping: float, dt: float) -> float:
    """What a step leaves of the rate at which the pair's spring lengthens, along the direction the scheme damps in."""
    system = pair(damping)
    end = scheme.step(SpringMotion(system), system.start, dt)
    moved = system.start.drift(dt) if np.array_equal(end.positions, system.start.drift(dt).positions) else system.start
    along = spring_directions(system, moved)[0]
    return float((along @ np.diff(end.velocities, axis=0)[0]) / (along @ np.diff(system.velocities, axis=0)[0]))


#: What is kept, of z = dt c/m with m = 1/(1/0.02 + 1/0.06) = 0.015 kg: explicit, implicit, or as if alone.
KEPT: dict[str, Callable[[float], float]] = {
    "kick_drift": lambda z: 1 - z,
    "kick_drift_implicit_drag": lambda z: 1 - z,
    "kick_drift_implicit_damping": lambda z: 1 / (1 + z),
    "kick_drift_implicit_damping_and_drag": lambda z: 1 / (1 + z),
    "kick_drift_truncated_damping": lambda z: 1 / (1 + z),
    "drift_kick_implicit_damping": lambda z: 1 / (1 + z),
    "drift_kick_sequential_damping": lambda z: float(np.exp(-z)),
    "drift_kick_exponential_damping": lambda z: float(np.exp(-z)),
}


def check_kept_rate(scheme: Scheme, kept: Callable[[float], float], damping: float, dt: float) -> None:
    """A damper between two masses keeps its closed form of their rate, to rounding (or the solver's 1e-8 m/s)."""
    tolerance = 1e-13 + 2 * SOLVED_TO.get(scheme, 0.0)
    assert kept_rate(scheme, damping, dt) == pytest.approx(kept(dt * damping / 0.015), abs=tolerance)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("name", KEPT)
@property_test
@given(damping=st.floats(0.0, 10.0), dt=st.floats(1e-4, 1e-2))
def test_a_damper_alone_keeps_its_closed_form_of_the_rate(name: str, damping: float, dt: float) -> None:
    """For 1 - z, 1/(1 + z) and exp(-z), z = dt c/m up to 7."""
    check_kept_rate(find(name), KEPT[name], damping, dt)


def test_every_scheme_of_this_file_has_its_closed_form_here() -> None:
    """One that enters there brings its own."""
    assert {s.name for s in ENGINE_SCHEMES if s.step.__module__ == implicit_damping.__name__} <= set(KEPT)


@pytest.mark.parametrize(
    ("scheme", "name"),
    [
        (wrong.stepped(wrong.damping_turned, find("kick_drift")), "kick_drift_implicit_damping"),
        (wrong.kick_drift_kicked_twice, "kick_drift"),
        (wrong.stepped(wrong.one_sided, find("kick_drift")), "kick_drift"),
        (find("drift_kick_exponential_damping"), "drift_kick_implicit_damping"),
        (find("kick_drift"), "kick_drift_implicit_damping"),
    ],
    ids=label,
)
def test_kept_rate_fails_on_wrong_schemes(scheme: Scheme, name: str) -> None:
    """Damping that drives, kicks twice, acts on one mass, or is another scheme's."""
    with pytest.raises(AssertionError):
        check_kept_rate(scheme, KEPT[name], 1.0, 1e-3)


# --- Any mesh ---


def dense_damping(system: MassSpringSystem, state: State) -> Array:
    """C = sum c_j J_j^T J_j, (n d, n d), from the rates J_j v = u_j . (v_b - v_a)."""
    n, d = system.positions.shape
    along = spring_directions(system, state)
    rates = np.zeros((len(system.springs), n, d))
    for j, (a, b) in enumerate(system.springs.tolist()):
        rates[j, a], rates[j, b] = -along[j], along[j]
    flat = rates.reshape(len(system.springs), n * d)
    damping: Array = flat.T @ (system.damping[:, None] * flat)
    return damping


def implicit_step(system: MassSpringSystem, dt: float, drag_too: bool) -> Array:
    """(M + dt C) v = M v* by hand, over the free masses; v* from forces without what is implicit."""
    motion, free = SpringMotion(system), ~system.fixed
    damping = dense_damping(system, system.start)
    rows = np.repeat(free, system.dimension)
    mass = np.repeat(system.masses, system.dimension)
    explicit = motion.acceleration(system.start, damping=False)
    kicked = (system.velocities + dt * explicit).ravel()
    if drag_too:
        kicked = kicked + dt * system.drag * system.velocities.ravel() / mass
        damping = damping + system.drag * np.eye(len(mass))
    matrix = np.diag(mass) + dt * damping
    velocities = np.zeros(len(mass))
    velocities[rows] = np.linalg.solve(matrix[np.ix_(rows, rows)], (mass * kicked)[rows])
    return velocities.reshape(system.velocities.shape)


def check_implicit(scheme: Scheme, system: MassSpringSystem, drag_too: bool) -> None:
    """A step's velocities solve (M + dt C) v = M v*, written out with NumPy, to 1e-12 (or the solver's tolerance)."""
    expected = implicit_step(system, 5e-3, drag_too)
    velocities = scheme.step(SpringMotion(system), system.start, 5e-3).velocities
    tolerance = 1e-12 * max(1.0, np.abs(expected).max()) + 100 * SOLVED_TO.get(scheme, 0.0)
    assert np.abs(velocities - expected).max() < tolerance


@pytest.mark.parametrize(
    ("name", "drag_too"),
    [
        ("kick_drift_implicit_damping", False),
        ("kick_drift_truncated_damping", False),
        ("kick_drift_implicit_damping_and_drag", True),
    ],
)
@property_test
@given(system=meshes)
def test_implicit_damping_solves_its_equations_on_any_mesh(name: str, drag_too: bool, system: MassSpringSystem) -> None:
    """In 2D and 3D, with fixed masses; every other spring has no damping."""
    undamped = np.arange(len(system.springs)) % 2 == 1
    check_implicit(find(name), with_fields(system, damping=np.where(undamped, 0.0, system.damping)), drag_too)


@pytest.mark.parametrize(
    "scheme",
    [
        find("kick_drift"),
        find("kick_drift_implicit_drag"),
        wrong.stepped(wrong.damping_turned, find("kick_drift")),
        wrong.last_mass_forgotten,
    ],
    ids=label,
)
def test_implicit_damping_fails_on_others(scheme: Scheme) -> None:
    """Explicit damping, and wrong ones, do not solve them."""
    with pytest.raises(AssertionError):
        check_implicit(scheme, random_mesh(1, 6, 2), drag_too=False)


@pytest.mark.parametrize("scheme", ENGINE_SCHEMES, ids=label)
def test_without_damping_they_are_a_plain_scheme_to_the_bit(scheme: Scheme) -> None:
    """Kick-drift or drift-kick: what else they do is to damping and drag only."""
    system = moving_string(6)
    run = simulate(system, scheme, 1e-3, 0.05).positions.tolist()
    plain = [simulate(system, find(name), 1e-3, 0.05).positions.tolist() for name in ("kick_drift", "drift_kick")]
    assert run in plain


@pytest.mark.parametrize("name", ["kick_drift_implicit_drag", "kick_drift_implicit_damping_and_drag"])
def test_implicit_drag_slows_a_free_mass_by_its_closed_form(name: str) -> None:
    """No springs, no gravity: v_n = v_0 (1 + dt Cd/m)^-n, to rounding."""
    free = with_fields(
        pair(0.0).with_parameter("drag", 3.0), springs=np.zeros((0, 2), dtype=np.int64), rest_lengths=1.0
    )
    free = with_fields(free, stiffness=1.0, damping=0.0)
    run = simulate(free, find(name), 1e-2, 0.1)
    expected = free.velocities / (1 + 1e-2 * 3.0 / free.masses[:, None]) ** 10
    assert run.velocities[-1] == pytest.approx(expected, rel=1e-13)


def check_damping_takes_energy(scheme: Scheme) -> None:
    """Strong damping (dt c/m = 10) of a string in free space without stiffness: kinetic energy grows in no step."""
    system = with_fields(moving_string(6, gravity=0.0, damping=100.0, stiffness=0.0), fixed=False)
    energies = [energy(system, s) for s in simulate(system, scheme, 1e-3, 0.05).states()]
    assert all(after <= before * (1 + 1e-12) for before, after in pairwise(energies))
    assert energies[-1] < 0.9 * energies[0]


IMPLICIT = [s for s in ENGINE_SCHEMES if s is not find("kick_drift_implicit_drag")]


@pytest.mark.parametrize("scheme", IMPLICIT, ids=label)
def test_implicit_damping_never_adds_energy(scheme: Scheme) -> None:
    """However strong it is."""
    check_damping_takes_energy(scheme)


@pytest.mark.parametrize("scheme", [find("kick_drift"), find("kick_drift_implicit_drag"), find("heun")], ids=label)
def test_explicit_damping_as_strong_blows_up(scheme: Scheme) -> None:
    """A factor of 1 - 10 a step is no damping."""
    with pytest.raises(AssertionError), np.errstate(over="ignore", invalid="ignore"):
        check_damping_takes_energy(scheme)


# --- Sequential impulses ---


def impulses(system: MassSpringSystem, dt: float, rounds: int) -> Array:
    """The velocities after sequential impulses alone."""
    mass = effective_masses(system)
    inverse = np.where(system.fixed, 0.0, 1 / system.masses)
    velocities = system.velocities.copy()
    part = -np.expm1(-dt * system.damping / mass)
    directions = spring_directions(system, system.start)
    sequential_impulses(velocities[:, :, None], system.springs, directions, inverse, mass, part, rounds)
    return velocities


@pytest.mark.parametrize("damping", [0.05, 1.0, 5.0])
def test_rounds_converge_to_the_exponential_solve(damping: float) -> None:
    """With more rounds they solve (M + sum m_j (exp(dt c/m_j) - 1) J_j^T J_j) v = M v*, whatever their order."""
    system = moving_string(6, damping=damping)
    mass = effective_masses(system)
    coefficients = mass * np.expm1(1e-3 * system.damping / mass)
    solved = slowed(SpringMotion(system), system.start, coefficients).velocities
    backwards = system.with_springs_reversed()
    assert np.abs(impulses(system, 1e-3, 2000) - solved).max() < 1e-13
    assert np.abs(impulses(backwards, 1e-3, 2000) - solved).max() < 1e-13
    one, two = (np.abs(impulses(system, 1e-3, rounds) - solved).max() for rounds in (1, 2))
    assert 1e-13 < two < one / 2


def test_a_spring_between_fixed_masses_damps_nothing() -> None:
    """It has no effective mass; the mass that can move does so, in numbers, and the fixed ones stay."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array(0.1),
        rest_lengths=np.array(1.0),
        stiffness=np.array(10.0),
        damping=np.array(1.0),
        fixed=np.array([True, True, False]),
    )
    alone = with_fields(system, springs=np.array([[1, 2]]), rest_lengths=1.0, stiffness=10.0, damping=1.0)
    for scheme in ENGINE_SCHEMES:
        run, expected = (simulate(s, scheme, 1e-2, 0.2).positions for s in (system, alone))
        assert run[:, 2] == pytest.approx(expected[:, 2], abs=1e-14)


def test_effective_masses_by_hand() -> None:
    """1/(1/0.02 + 1/0.06) = 0.015 kg; a fixed mass counts as infinite."""
    system = pair(0.0)
    assert effective_masses(system).tolist() == pytest.approx([0.015])
    held = replace(system, fixed=np.array([True, False]), velocities=np.zeros(1))
    assert effective_masses(held).tolist() == [0.06]


def test_truncated_damping_does_nothing_below_its_tolerance() -> None:
    """A damper lengthening at 1e-8 m/s keeps its rate: the first residual is below 1e-8 m/s. A faster one does not."""
    truncated = find("kick_drift_truncated_damping")
    for speed, kept in ((1e-8, 1.0), (1e-3, 1 / (1 + 1e-3 * 1.0 / 0.015))):
        system = replace(pair(1.0), velocities=np.array([[0.0, 0.0], [0.6 * speed, 0.8 * speed]]))
        end = truncated.step(SpringMotion(system), system.start, 1e-3)
        rate = np.array([0.6, 0.8]) @ (end.velocities[1] - end.velocities[0])
        assert rate == pytest.approx(kept * speed, abs=1e-13 if kept == 1.0 else 2e-8)
