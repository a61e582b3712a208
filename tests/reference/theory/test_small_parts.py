"""Small parts of theory by hand: what hangs together, what it carries, linear motion, impulses, shares of a mode."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.schemes.catalogue import find
from reference.springs.angular import AngularSprings
from reference.state import State
from reference.system import MassSpringSystem
from reference.theory import linear_motion
from reference.theory.critical_mode import critical_mode
from reference.theory.definite import Definiteness
from reference.theory.equilibria import spring_equilibrium
from reference.theory.exact import damped_oscillator
from reference.theory.gauss_seidel import impulse_matrix
from reference.theory.linear_motion import LinearMotion
from reference.theory.parts import falling_velocities, loads, parts_of
from reference.theory.strong_damping import drowned_from
from tests.reference.systems import random_mesh

# --- Parts ---


def parted(**more: Any) -> MassSpringSystem:
    """A fixed mass 0 with 1 and 2 on it; 3 and 4 on a spring of their own; 5 on a spring without stiffness from 2."""
    fields: dict[str, Any] = {
        "positions": np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 3.0], [1.0, 3.0], [3.0, 0.0]]),
        "springs": np.array([[0, 1], [2, 1], [3, 4], [2, 5]]),
        "masses": np.array([1.0, 2.0, 3.0, 4.0, 6.0, 7.0]),
        "rest_lengths": np.array(1.0),
        "stiffness": np.array([10.0, 20.0, 30.0, 0.0]),
        "gravity": np.array([0.5, -2.0]),
        "fixed": np.arange(6) == 0,
        **more,
    }
    return MassSpringSystem(**fields)


def test_parts_by_hand() -> None:
    """Springs of stiffness hold together, a fixed mass joins nothing; also three masses that an angle holds."""
    found = parts_of(parted())
    assert found.of_mass.tolist() == [-1, 0, 0, 1, 1, 2]
    assert found.held.tolist() == [True, False, False]
    assert found.loose.tolist() == [3, 4, 5]
    for masses, parts in (([3, 5, 4], [-1, 0, 0, 1, 1, 1]), ([5, 2, 1], [-1, 0, 0, 1, 1, 0])):
        bent = parted(angular_springs=AngularSprings(np.array([masses]), np.array(2.0)))
        assert parts_of(bent).of_mass.tolist() == parts
    middle_held = parted(fixed=np.isin(np.arange(6), [0, 1]))
    assert parts_of(middle_held).of_mass.tolist() == [-1, -1, 0, 1, 1, 2]
    assert parts_of(middle_held).held.tolist() == [True, False, False]


def test_loads_by_hand() -> None:
    """Weight of what is held; of what falls nothing, or with drag what is more than its part's mean; pulls likewise."""
    gravity = np.array([0.5, -2.0])
    system = parted()
    expected = np.array([0, 2, 3, 0, 0, 0])[:, None] * gravity
    assert loads(system, parts_of(system)) == pytest.approx(expected)
    assert not falling_velocities(system).any()
    slowed = parted(drag=0.25)
    expected = np.array([0, 2, 3, -1, 1, 0])[:, None] * gravity
    assert loads(slowed, parts_of(slowed)) == pytest.approx(expected)
    velocities = np.array([0, 0, 0, 5, 5, 7])[:, None] * gravity / 0.25
    assert falling_velocities(slowed) == pytest.approx(velocities)
    pulls = np.array([[9.0, 9.0], [1.0, 0.0], [0.0, 2.0], [0.0, 5.0], [10.0, 0.0], [3.0, 3.0]])
    pulled = parted(pulls=pulls)
    # masses of 4 and 6 kg are accelerated together by (1, 1/2) m/s^2
    more = [[0, 0], [1, 0], [0, 2], [-4, 3], [4, -3], [0, 0]]
    plain = np.array([0, 2, 3, 0, 0, 0])[:, None] * gravity
    assert loads(pulled, parts_of(pulled)) == pytest.approx(plain + more)
    with pytest.raises(SolverError, match="with drag, that nothing holds"):
        loads(parted(pulls=pulls, drag=0.1), parts_of(pulled))


def test_what_creeps_is_named() -> None:
    """The first damper without stiffness between two parts; within one part it creeps nowhere, nor without gravity."""
    creeping = parted(damping=np.array([1.0, 0.0, 0.0, 2.0]))
    with pytest.raises(SolverError, match="spring 3 has damping and no stiffness"):
        loads(creeping, parts_of(creeping))
    weightless = replace(creeping, gravity=np.zeros(2))
    assert not loads(weightless, parts_of(weightless)).any()
    within = parted(springs=np.array([[0, 1], [2, 1], [3, 4], [1, 2]]), damping=np.array([0.0, 0.0, 0.0, 2.0]))
    loads(within, parts_of(within))


# --- Motion ---


@pytest.mark.parametrize("dense_up_to", [10**6, 0])
def test_linear_motion_is_the_slope_of_the_forces(monkeypatch: pytest.MonkeyPatch, dense_up_to: int) -> None:
    """By central differences of h = 1e-6, of unequal masses with damping and drag; of all masses and of one alone."""
    monkeypatch.setattr(linear_motion, "DENSE_UP_TO", dense_up_to)
    system = random_mesh(4, 6, 3, anchors=2)
    at = State(0.0, system.positions, np.zeros_like(system.velocities))
    motion, springs, h = LinearMotion(system, at), SpringMotion(system), 1e-6
    rng = np.random.default_rng(1)
    free = ~system.fixed[:, None]
    x, v = (free * rng.normal(size=at.positions.shape) for _ in range(2))
    ends = [springs.acceleration(State(0.0, at.positions + s * h * x, s * h * v)) for s in (1, -1)]
    expected = (ends[0] - ends[1]) / (2 * h)
    state = State(0.0, x, v)
    assert motion.acceleration(state) == pytest.approx(expected, rel=1e-6, abs=1e-4)
    for i in range(6):
        assert motion.acceleration_of(i, state) == pytest.approx(motion.acceleration(state)[i], rel=1e-12, abs=1e-10)
    ends = [springs.acceleration(State(0.0, at.positions + s * h * x, s * h * v), damping=False) for s in (1, -1)]
    assert motion.acceleration(state, damping=False) == pytest.approx((ends[0] - ends[1]) / (2 * h), rel=1e-6, abs=1e-4)
    slope = motion.slope(state)
    assert slope.time == 1.0
    assert np.array_equal(slope.positions, v)


@pytest.mark.parametrize(("mass", "c"), [(2.0, 30.0), (0.25, 5.0), (2.0, 1.0)])
def test_damped_swings_by_their_roots(mass: float, c: float) -> None:
    """Y = A e^(p t) + B e^(q t) with p, q the roots of m s^2 + c s + k = 0, over- and under-damped."""
    k, y0, v0, t = 10.0, 0.3, -1.5, np.linspace(0, 2, 9)
    p, q = np.roots([mass, c, k]).astype(complex)
    a, b = np.linalg.solve(np.array([[1, 1], [p, q]]), np.array([y0, v0], dtype=complex))
    y, v = damped_oscillator(mass, k, c, y0, v0, t)
    assert y == pytest.approx((a * np.exp(p * t) + b * np.exp(q * t)).real, abs=1e-13)
    assert v == pytest.approx((a * p * np.exp(p * t) + b * q * np.exp(q * t)).real, abs=1e-12)


# --- Of steps ---


def test_impulses_of_one_spring_in_another() -> None:
    """At a mass of 0.5 kg where two springs meet at 60 degrees: -cos(60 degrees)/m; else what is implicit."""
    up = np.array([0.5, np.sqrt(0.75)])
    system = MassSpringSystem(
        positions=np.array([[-1.0, 0.0], [0.0, 0.0], up]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array([1.0, 0.5, 2.0]),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
        damping=np.array([0.3, 0.8]),
        fixed=np.array([True, False, False]),
    )
    # effective masses of 0.5 kg, as mass 0 is fixed, and 1/(1/0.5 + 1/2) = 0.4 kg
    diagonal = [-1 / (m * np.expm1(-0.1 * c / m)) for m, c in ((0.5, 0.3), (0.4, 0.8))]
    assert impulse_matrix(system, 0.1) == pytest.approx(np.array([[diagonal[0], -1.0], [-1.0, diagonal[1]]]), rel=1e-12)


def in_a_row(**more: Any) -> MassSpringSystem:
    """0.5 kg on 100 N/m and 0.3 m, 1 kg below it on 300 N/m and 0.9 m, along a line."""
    fields: dict[str, Any] = {
        "positions": np.array([[0.0], [-0.3], [-1.2]]),
        "springs": np.array([[0, 1], [1, 2]]),
        "masses": np.array([1.0, 0.5, 1.0]),
        "rest_lengths": np.array([0.3, 0.9]),
        "stiffness": np.array([100.0, 300.0]),
        "gravity": np.zeros(1),
        "fixed": np.array([True, False, False]),
        **more,
    }
    return MassSpringSystem(**fields)


def test_springs_share_the_energy_of_the_mode_that_limits() -> None:
    """K (difference of moves)^2 of the faster of two modes, by the 2 x 2 eigenproblem; and its frequency."""
    linear = spring_equilibrium(in_a_row()).linear
    assert linear is not None
    values, vectors = np.linalg.eig(np.array([[800.0, -600.0], [-300.0, 300.0]]))
    fastest = int(np.argmax(values))
    u, w = vectors[:, fastest], np.sqrt(values[fastest])
    mode = critical_mode(find("kick_drift"), linear, 2 / w)
    energies = np.array([100 * u[0] ** 2, 300 * (u[1] - u[0]) ** 2])
    assert mode.shares == pytest.approx(energies / energies.sum(), rel=1e-9)
    assert mode.frequency == pytest.approx(w / (2 * np.pi), rel=1e-9)
    assert np.abs(mode.shape[1:, 0]) == pytest.approx(np.abs(u) / np.abs(u).max(), rel=1e-9)
    assert not mode.shape[0].any()


@pytest.mark.parametrize(
    ("name", "rate"),
    [
        # dampers of 4 and 1 N s/m on effective masses of 0.5 and 1/3 kg; drag of 2 N s/m on half a kilogram
        ("drift_kick_exponential_damping", 8.0),
        ("kick_drift_exponential_drag", 4.0),
        ("kick_drift", None),
    ],
)
def test_where_damping_drowns_the_rest(name: str, rate: float | None) -> None:
    """From h c/m = 18 on, or h Cd/m, of a scheme that takes it by exponentials: e^-18 is 2e-8."""
    linear = spring_equilibrium(in_a_row(damping=np.array([4.0, 1.0]), drag=2.0)).linear
    assert linear is not None
    found = drowned_from(Definiteness(find(name), linear, 0.01))
    assert found == (pytest.approx(18 / rate, rel=1e-12) if rate else np.inf)
