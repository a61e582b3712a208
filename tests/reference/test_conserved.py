"""Momentum, angular momentum and energy: what they are, and which schemes keep them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.conserved import angular_momentum, energies, energy, momentum
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from reference.state import Array, Trajectory
from reference.system import MassSpringSystem
from reference.theory.exact import exact
from tests import wrong
from tests.reference.systems import IN_PLACE, SOLVED, SOLVED_TO, free_string, label, moving_string

#: Right, but their damping is solved by conjugate residuals, whose steps do not know of momentum.
(TRUNCATED,) = SOLVED_TO

#: The schemes that keep angular momentum exactly. Kick: the forces are central at the positions they act at, so
#: sum m x cross dv = 0; drift: v cross v = 0. Euler and its Runge-Kutta kin mix positions of one time with forces of
#: another; the midpoint rule keeps every quadratic invariant (HLW IV.2.1).
KEEP_ANGULAR_MOMENTUM = [
    *(find(name) for name in ("kick_drift", "drift_kick", "velocity_verlet", "implicit_midpoint")),
    *(s for s in SOLVED if s.kind == "engine_scheme" and s is not TRUNCATED),
]

#: The schemes that keep a modified energy, and so keep the energy near its value for ever (HLW IX.8).
SYMPLECTIC = [find(name) for name in ("kick_drift", "drift_kick", "velocity_verlet", "implicit_midpoint")]

DAMPINGS = (0.0, 0.05, 0.5)
TURNED_SIDEWAYS = wrong.stepped(wrong.sideways, find("kick_drift"))
ONE_SIDED = wrong.stepped(wrong.one_sided, find("kick_drift"))


def momentum_scale(system: MassSpringSystem) -> float:
    """Sum of m |v| [kg m/s]: what rounding of momentum is measured against."""
    return float(system.masses @ np.linalg.norm(system.velocities, axis=1))


def drift(values: list[Array]) -> float:
    """How far a quantity gets from its first value."""
    return float(np.abs(np.array(values) - values[0]).max())


def momentum_error(scheme: Scheme, damping: float) -> float:
    """How far, over 200 steps of a free string, momentum gets from its start, as a part of its scale."""
    system = free_string(damping)
    states = simulate(system, scheme, 1e-3, 0.2).states()
    return drift([momentum(system, s) for s in states]) / momentum_scale(system)


def angular_momentum_error(scheme: Scheme, damping: float) -> float:
    """The same for angular momentum, as a part of momentum's scale times the size."""
    system = free_string(damping)
    states = simulate(system, scheme, 1e-3, 0.2).states()
    return drift([angular_momentum(system, s) for s in states]) / momentum_scale(system) / system.size


def check_momentum(scheme: Scheme, damping: float) -> None:
    """d/dt sum m v = 0 on a free string.

    200 steps with five springs round some 2,000 times: as a random walk about 45 eps = 1e-14 of the scale.
    """
    assert momentum_error(scheme, damping) < 5e-14


def check_angular_momentum(scheme: Scheme, damping: float) -> None:
    """d/dt sum m x cross v = 0 on a free string, to the same rounding."""
    assert angular_momentum_error(scheme, damping) < 5e-14


@pytest.mark.rotating(3)
@pytest.mark.parametrize("damping", DAMPINGS)
@pytest.mark.parametrize("scheme", [s for s in SOLVED if s is not TRUNCATED], ids=label)
def test_whole_state_schemes_keep_momentum_to_rounding(scheme: Scheme, damping: float) -> None:
    """Every spring's two forces are opposite and taken from one state."""
    check_momentum(scheme, damping)


@pytest.mark.parametrize(
    "scheme", [*IN_PLACE, wrong.in_order_of_number, wrong.last_mass_forgotten, ONE_SIDED], ids=label
)
def test_momentum_fails_on_in_place_and_one_sided(scheme: Scheme) -> None:
    """Forces taken from two states, or on one mass only, do not cancel: momentum is off by over 1 % of its scale."""
    with pytest.raises(AssertionError):
        check_momentum(scheme, 0.0)
    assert momentum_error(scheme, 0.0) > 1e-2


def test_truncated_damping_keeps_momentum_to_its_solvers_tolerance() -> None:
    """Each of 200 steps may leave a residual of 1e-8 m/s in each component of each mass; undamped it is exact."""
    system = free_string(0.5)
    per_step = SOLVED_TO[TRUNCATED] * system.masses.sum() * system.dimension / momentum_scale(system)
    assert 1e-12 < momentum_error(TRUNCATED, 0.5) < 200 * per_step
    check_momentum(TRUNCATED, 0.0)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("damping", DAMPINGS)
@pytest.mark.parametrize("scheme", KEEP_ANGULAR_MOMENTUM, ids=label)
def test_schemes_that_keep_angular_momentum(scheme: Scheme, damping: float) -> None:
    """Symplectic schemes keep it, with damping along the springs too: that is a central force."""
    check_angular_momentum(scheme, damping)


@pytest.mark.rotating(3)
@pytest.mark.parametrize(
    "scheme", [find("euler"), find("backward_euler"), find("heun"), find("rk4"), *IN_PLACE, TURNED_SIDEWAYS], ids=label
)
def test_angular_momentum_fails_on_others(scheme: Scheme) -> None:
    """Euler: x1 cross v1 has the extra dt^2 v0 cross a0; its kin have higher powers of dt; sideways forces turn it."""
    with pytest.raises(AssertionError):
        check_angular_momentum(scheme, 0.0)


def test_sideways_forces_keep_momentum() -> None:
    """Opposite forces off the line between two masses keep momentum: only the check of angular momentum sees them."""
    check_momentum(TURNED_SIDEWAYS, 0.0)


def check_energy_of_motion(true: Trajectory, system: MassSpringSystem) -> None:
    """Kinetic + elastic + gravitational energy is constant, to 1e-9 of the largest kinetic energy there is.

    The solver's tolerance is 1e-12 a step; it takes some hundred.
    """
    energies = np.array([energy(system, s) for s in true.states()])
    kinetic = 0.5 * (true.velocities**2).sum(axis=2) @ system.masses
    assert np.ptp(energies) < 1e-9 * kinetic.max()


def test_exact_motion_keeps_energy() -> None:
    """An undamped string under gravity turns its energies into one another: E(t) = E(0)."""
    system = moving_string(6)
    check_energy_of_motion(exact(system, 0.01, 50), system)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("law", [wrong.gravity_turned, wrong.one_sided, wrong.sideways], ids=label)
def test_energy_fails_on_wrong_forces(law: wrong.Law) -> None:
    """Forces that are not those of the energy do not keep it."""
    system = moving_string(6)
    with pytest.raises(AssertionError):
        check_energy_of_motion(exact(system, 0.01, 20, equations=wrong.under(law)), system)


@pytest.mark.parametrize("scheme", [find("euler"), wrong.kick_drift_gaining_energy], ids=label)
def test_energy_fails_on_wrong_integrators(scheme: Scheme) -> None:
    """A step that gains energy is seen, even a part in a million a step."""
    system = moving_string(6)
    with pytest.raises(AssertionError):
        check_energy_of_motion(simulate(system, scheme, 1e-3, 0.2), system)


def check_energy_stays(scheme: Scheme) -> None:
    """Over 5,000 steps of an undamped string the energy error has no trend: HLW IX.8.

    A symplectic scheme keeps E up to an oscillation of about (dt w)^p of the energies; with w <= 2 sqrt(k/m) = 200/s
    dt w is 0.4, and 5,000 steps are 300 of the fastest periods. The mean over the last fifth may differ from that over
    the first by a tenth of the oscillation's width there, which anything that grows by 1e-6 a step exceeds.
    """
    system = find_scene("string").system({"masses": 2, "angle": 60.0})
    trajectory = simulate(system, scheme, 2e-3, 10.0)
    with np.errstate(over="ignore", invalid="ignore"):
        found = energies(system, trajectory)
    assert np.isfinite(found).all()
    first, last = found[:1000], found[-1000:]
    assert np.ptp(last) < 2 * np.ptp(first)
    assert abs(last.mean() - first.mean()) < 0.1 * np.ptp(first)


@pytest.mark.rotating(2)
@pytest.mark.parametrize("scheme", SYMPLECTIC, ids=label)
def test_symplectic_schemes_keep_energy_near_for_ever(scheme: Scheme) -> None:
    """The energy error is bounded and has no trend."""
    check_energy_stays(scheme)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("scheme", [find("euler"), find("heun"), wrong.kick_drift_gaining_energy], ids=label)
def test_long_run_energy_fails_on_schemes_that_gain_or_lose(scheme: Scheme) -> None:
    """Euler and Heun gain energy, and so does a right scheme nudged by 1e-6 a step."""
    with pytest.raises(AssertionError):
        check_energy_stays(scheme)


def test_energy_of_a_stretched_moving_spring() -> None:
    """E = m v^2/2 + k (L - L0)^2/2 + m g y, by hand: 0.02*9/2 + 200*0.01^2/2 - 0.02*10*0.135 J."""
    system = find_scene("spring").system({"gravity": 10.0, "stretch": 0.01, "velocity": 3.0})
    assert energy(system, system.start) == pytest.approx(0.09 + 0.01 - 0.027, rel=1e-12)


def test_momentum_and_angular_momentum_by_hand() -> None:
    """Momentum is sum m v, angular momentum sum m (x v_y - y v_x): of two masses, in 2D and, turned, in 3D."""
    flat = MassSpringSystem(
        positions=np.array([[1.0, 0.0], [0.0, 2.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array([2.0, 3.0]),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
        velocities=np.array([[0.0, 5.0], [7.0, 0.0]]),
    )
    assert momentum(flat, flat.start).tolist() == [21.0, 10.0]
    assert angular_momentum(flat, flat.start).tolist() == [0.0, 0.0, 2 * 1 * 5.0 - 3 * 2 * 7.0]
    solid = MassSpringSystem(
        positions=np.array([[0.0, 0.0, 1.0]]),
        springs=np.zeros((0, 2), dtype=np.int64),
        masses=np.array(2.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
        velocities=np.array([[5.0, 0.0, 0.0]]),
    )
    assert angular_momentum(solid, solid.start).tolist() == [0.0, 10.0, 0.0]


def test_energies_of_a_trajectory_are_those_of_its_states() -> None:
    """Added up in another order: to a few roundings of what is added, the largest part of it, some J."""
    for name in ("string", "jello"):
        system = find_scene(name).system({})
        trajectory = simulate(system, find("heun"), 1e-3, 0.05)
        one_by_one = [energy(system, state) for state in trajectory.states()]
        size = max(1.0, float(np.abs(one_by_one).max()))
        np.testing.assert_allclose(energies(system, trajectory), one_by_one, rtol=0, atol=1e-14 * size)


def test_energy_from_where_a_motion_begins_is_not_changed_by_weights_that_change_there() -> None:
    """At the start m g.(x - x0) = 0 whatever g; and it is the energy from the origin but for one constant."""
    system = moving_string()
    begin = system.positions + 7.0
    state = replace(system.start, positions=system.positions + 7.0)
    turned = system.with_parameter("gravity", (3.0, -2.0))
    kept = [energy(one, state, begin) for one in (system, turned)]
    assert kept[0] == pytest.approx(kept[1], rel=1e-12)  # to rounding of m g.x, some ten times as large
    assert energy(system, state) != pytest.approx(energy(turned, state), rel=0.1)
    along = system.masses @ (begin @ system.gravity)
    assert energy(system, system.start, begin) - energy(system, system.start) == pytest.approx(along)
