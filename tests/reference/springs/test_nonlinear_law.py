"""Springs that are not linear: their law by differences, and their motion by closed forms and quadrature."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

from reference.assembly import assemble, spring_blocks
from reference.compiled.in_place import step_of
from reference.compiled.kernels import advance
from reference.conserved import energies
from reference.errors import InputError, SolverError, Unsupported
from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.springs.breaking import tensions, without_force
from reference.springs.kinds import KINDS, NonlinearSprings
from reference.springs.nonlinear_law import (
    damping_at,
    energy_of_springs,
    secant_stiffness,
    tangent_stiffness,
    tangent_system,
)
from reference.state import Array, State
from reference.stepper import stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.exact import exact
from tests.reference.systems import moving_string
from tests.wrong import heun_without_half

LAWS: dict[str, dict[str, Any]] = {
    "tension_only": {"tension_only": True},
    "compression_only": {"compression_only": True},
    "hardening": {"hardening": 3e4},
    "largest_force": {"largest_force": 2.0},
    "rope that hardens": {"tension_only": True, "hardening": 3e4},
    "strut that yields": {"compression_only": True, "largest_force": 2.0},
}


def on_wall(mass: float = 0.5, stiffness: float = 200.0, velocity: float = 1.5, **law: Any) -> MassSpringSystem:
    """A mass on a spring of 1 m to a wall at the origin, along a line, thrown from where the spring has its length."""
    nonlinear = NonlinearSprings(**{name: np.array(value) for name, value in law.items()})
    return MassSpringSystem(
        positions=np.array([[0.0], [1.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array(mass),
        rest_lengths=np.array(1.0),
        stiffness=np.array(stiffness),
        gravity=np.zeros(1),
        velocities=np.array([[0.0], [velocity]]),
        fixed=np.array([True, False]),
        nonlinear=nonlinear,
    )


def moving(law: dict[str, Any], **more: Any) -> MassSpringSystem:
    """A string in which some springs are stretched and some pushed together, with a law."""
    string = moving_string(4, damping=0.3)
    x = string.positions.copy()
    x[2] -= 0.1 * (x[2] - x[1])
    x[3] += 0.05 * (x[3] - x[2])
    return replace(string, positions=x, nonlinear=NonlinearSprings(**{k: np.array(v) for k, v in law.items()}), **more)


@pytest.mark.parametrize("law", LAWS.values(), ids=list(LAWS))
def test_the_parts_of_a_law_belong_together(law: dict[str, Any]) -> None:
    """F = dE/ds and k = dF/ds by central differences, away from corners: their error is of h^2 = 1e-12 of the force."""
    system = on_wall(**law)
    stretch, h = np.array([-0.3, -0.02, -0.004, 0.003, 0.013, 0.4]), 1e-6

    def force(s: Array) -> Array:
        return secant_stiffness(system, s) * s

    slope = (energy_of_springs(system, stretch + h) - energy_of_springs(system, stretch - h)) / (2 * h)
    assert force(stretch) == pytest.approx(slope, rel=1e-6, abs=1e-8)
    tangent = (force(stretch + h) - force(stretch - h)) / (2 * h)
    assert tangent_stiffness(system, stretch) == pytest.approx(tangent, rel=1e-6, abs=1e-6)
    slack = force(stretch) == 0
    assert (damping_at(replace(system, damping=np.array([2.0])), stretch) == np.where(slack, 0.0, 2.0)).all()


@pytest.mark.parametrize("law", LAWS.values(), ids=list(LAWS))
def test_jacobians_are_the_derivatives_of_the_forces(law: dict[str, Any]) -> None:
    """By positions and velocities, in the plane, damped, by central differences; springs that are slack among them."""
    system = moving(law)
    motion, free, state = SpringMotion(system), ~system.fixed, system.start

    def force(x: Array, v: Array) -> Array:
        return (motion.acceleration(State(0.0, x, v)) * system.masses[:, None])[free].ravel()

    x, v, h = state.positions, state.velocities, 1e-6
    for blocks, of_x in zip(spring_blocks(system, state), (True, False), strict=True):
        columns = []
        for i, axis in np.argwhere(np.broadcast_to(free[:, None], x.shape)):
            step = np.zeros_like(x)
            step[i, axis] = h
            ends = [force(x + s * step, v) if of_x else force(x, v + s * step) for s in (1, -1)]
            columns.append((ends[0] - ends[1]) / (2 * h))
        matrix = assemble(system, blocks, sparse=False)
        assert matrix == pytest.approx(np.stack(columns, axis=1), abs=1e-6 * np.abs(matrix).max())


@pytest.mark.parametrize("law", LAWS.values(), ids=list(LAWS))
def test_one_mass_alone_is_given_the_bits_it_has_within_the_whole(law: dict[str, Any]) -> None:
    """As of linear springs; and the compiled step of an in-place scheme gives way to the scheme as it is written."""
    system = moving(law)
    motion = SpringMotion(system)
    whole = motion.acceleration(system.start)
    for i in range(len(system.masses)):
        assert motion.acceleration_of(i, system.start).tolist() == whole[i].tolist()
    large = find_scene("string").system({"masses": 250, "tension_only": 1})
    in_place = find("euler_in_place")
    one, two = (
        step(large.start, 1e-3) for step in (step_of(in_place, SpringMotion(large)), in_place.on(SpringMotion(large)))
    )
    assert (one.positions == two.positions).all()


def bounced(times: Array, mass: float = 0.5, stiffness: float = 200.0, velocity: float = 1.5) -> Array:
    """On a spring that only pulls: half a swing of pi sqrt(m/k), then flight with the velocity turned round."""
    w = np.sqrt(stiffness / mass)
    return np.where(times < np.pi / w, velocity / w * np.sin(w * times), -velocity * (times - np.pi / w))


def check_bounce(motion: Array, times: Array, within: float) -> None:
    """The mass is where it should be, to a part of its swing."""
    true = bounced(times)
    assert np.abs(motion - true).max() < within * true.max()


@pytest.mark.rotating(2, in_turn=True)
def test_a_mass_on_a_rope_swings_half_a_period_and_flies() -> None:
    """The exact motion to 1e-11; RK4's to h^4, and at the corner h^2, of w h = 0.02; the same of a strut, mirrored."""
    rope = on_wall(tension_only=True)
    run = exact(rope, 1e-3, 400)
    check_bounce(run.positions[:, 1, 0] - 1.0, run.times, 1e-11)
    rk4 = simulate(rope, find("rk4"), 1e-3, 0.4)
    check_bounce(rk4.positions[:, 1, 0] - 1.0, rk4.times, 1e-4)
    assert np.ptp(energies(rope, rk4)) < 1e-4 * 0.5 * 0.5 * 1.5**2
    strut = simulate(on_wall(velocity=-1.5, compression_only=True), find("rk4"), 1e-3, 0.4)
    check_bounce(1.0 - strut.positions[:, 1, 0], strut.times, 1e-4)
    wrong = simulate(rope, heun_without_half, 1e-3, 0.4)
    with pytest.raises(AssertionError):  # shown to fail
        check_bounce(wrong.positions[:, 1, 0] - 1.0, wrong.times, 1e-4)


def period(positions: Array, dt: float) -> float:
    """From where it crosses its rest upwards to where it does again, by straight lines between steps."""
    up = np.flatnonzero((positions[:-1] < 0) & (positions[1:] >= 0))
    crossings = dt * (up - positions[up] / (positions[up + 1] - positions[up]))
    return float(crossings[-1] - crossings[0]) / (len(crossings) - 1)


def duffing_period(mass: float, stiffness: float, hardening: float, amplitude: float) -> float:
    """4 times the integral over a quarter of sqrt(m / (k + k3 A^2 (1 + sin^2) / 2)): energy, with s = A sin(theta)."""
    return (
        4
        * quad(
            lambda th: np.sqrt(mass / (stiffness + hardening * amplitude**2 * (1 + np.sin(th) ** 2) / 2)), 0, np.pi / 2
        )[0]
    )


@pytest.mark.rotating(2, in_turn=True)
@pytest.mark.parametrize("stiffness", [200.0, 0.0])
def test_a_spring_that_hardens_swings_as_duffings(stiffness: float) -> None:
    """Its period by quadrature, and without stiffness 7.4163 sqrt(m/k3) / A; to 1e-6, RK4's and interpolation's error.

    (Nayfeh and Mook, *Nonlinear Oscillations*, 2.) Shown to fail: the linear period is another.
    """
    amplitude, hardening = 0.1, 4e4
    start = np.sqrt((stiffness * amplitude**2 + hardening * amplitude**4 / 2) / 0.5)
    system = on_wall(stiffness=stiffness, velocity=start, hardening=hardening)
    run = simulate(system, find("rk4"), 5e-4, 0.8)
    true = duffing_period(0.5, stiffness, hardening, amplitude)
    assert period(run.positions[:, 1, 0] - 1.0, 5e-4) == pytest.approx(true, rel=1e-6)
    assert np.abs(run.positions[:, 1, 0] - 1.0).max() == pytest.approx(amplitude, rel=1e-3)
    if stiffness:
        assert true != pytest.approx(2 * np.pi * np.sqrt(0.5 / stiffness), rel=0.1)
    else:
        assert true == pytest.approx(7.4163 * np.sqrt(0.5 / hardening) / amplitude, rel=1e-5)


@pytest.mark.rotating(2, in_turn=True)
def test_beyond_its_largest_force_a_spring_slows_a_mass_down_evenly() -> None:
    """Half of m v^2 = E(s_y) + F (s - s_y): how far it comes, and that it comes back as fast as it went."""
    system = on_wall(velocity=3.0, largest_force=5.0)
    run = exact(system, 1e-3, 1000)
    yields = 5.0 / 200.0
    furthest = yields + (0.5 * 0.5 * 3.0**2 - 0.5 * 200.0 * yields**2) / 5.0
    out = run.positions[:, 1, 0] - 1.0
    assert out.max() == pytest.approx(furthest, rel=1e-5)  # between two steps it is h^2 F / 8 m higher at most
    beyond = np.diff(run.velocities[:, 1, 0][out > yields + 0.01]) / 1e-3
    assert beyond == pytest.approx(np.full(len(beyond), -10.0), rel=1e-9)
    back = np.flatnonzero(out[1:] * out[:-1] < 0)[0]
    assert abs(run.velocities[back, 1, 0]) == pytest.approx(3.0, rel=1e-3)


def test_theory_is_about_the_state_that_is_taken() -> None:
    """A string of ropes hangs and swings as one of springs; one of them that is slack is as good as none."""
    string = find_scene("string").system({"masses": 3})
    ropes = replace(string, nonlinear=NonlinearSprings(tension_only=np.array(True)))
    one, two = (spring_equilibrium(system) for system in (string, ropes))
    assert one.state.positions == pytest.approx(two.state.positions, abs=1e-9)
    assert two.system.nonlinear is None
    assert two.system.rest_lengths == pytest.approx(string.rest_lengths, abs=1e-15)
    # one more rope, from the anchor to the last mass, longer than they hang: slack
    spare = replace(
        ropes,
        springs=np.vstack([string.springs, [0, 3]]),
        **{
            name: np.append(getattr(string, name), value)
            for name, value in (("rest_lengths", 1.0), ("stiffness", 500.0), ("damping", 0.0))
        },
        nonlinear=NonlinearSprings(tension_only=np.array(True)),
    )
    rest = spring_equilibrium(spare)
    assert rest.system.stiffness.tolist() == [200.0, 200.0, 200.0, 0.0]
    assert rest.state.positions == pytest.approx(one.state.positions, abs=1e-9)


def test_hardening_raises_the_frequency_about_rest_as_its_tangent_does() -> None:
    """A mass that hangs at s with k s + k3 s^3 = m g swings with w^2 = (k + 3 k3 s^2) / m."""
    system = find_scene("oscillator").system({"mass": 0.5, "hardening": 4e4})
    rest = spring_equilibrium(system)
    (stretch,) = -0.125 - rest.state.positions[1]
    assert 200.0 * stretch + 4e4 * stretch**3 == pytest.approx(0.5 * 9.81, rel=1e-12)
    assert rest.linear is not None
    assert rest.linear.scaled_stiffness.toarray() == pytest.approx(np.array([[(200.0 + 1.2e5 * stretch**2) / 0.5]]))


def test_what_has_no_linear_motion_is_told() -> None:
    """At rest exactly where a rope goes slack, and beyond a largest force: one line, no number."""
    still = replace(on_wall(tension_only=True), velocities=np.zeros((2, 1)))
    with pytest.raises(SolverError, match="spring 0 is at its rest length"):
        spring_equilibrium(still)
    with pytest.raises(SolverError, match="no equilibrium"):
        spring_equilibrium(find_scene("oscillator").system({"largest_force": 0.1}))


def test_what_cannot_step_them_refuses() -> None:
    """Compiled loops, rods, the lecture's listings: with the kind that they lack."""
    string = find_scene("string").system({"tension_only": 1})
    with pytest.raises(Unsupported, match="tension_only"):
        advance(string, find("heun"), 1e-3, 1)
    for name in ("pendulum_heun", "rope_kick_drift"):
        outcome = stepper_named(name).run(string, 1e-3, 1)
        assert (outcome.ending, "tension_only" in outcome.reason) == ("unsupported", True)


@pytest.mark.parametrize(
    ("law", "said"),
    [
        ({"hardening": -1.0}, "hardening = -1: expected a number >= 0 [N/m^3]"),
        ({"largest_force": 0.0}, "largest_force = 0: expected a number > 0 [N]"),
        ({"breaking_force": float("nan")}, "breaking_force = nan: expected a number > 0 [N]"),
        ({"breaking_stretch": -1.0}, "breaking_stretch = -1: expected a number > 0 [m]"),
        ({"breaking_stretch": [1.0, 2.0]}, "breaking_stretch has shape"),
        ({"tension_only": 3}, "tension_only = "),
        ({"tension_only": True, "compression_only": True}, "tension_only and compression_only of spring 0"),
        ({"hardening": 1.0, "largest_force": 1.0}, "hardening and largest_force of spring 0"),
    ],
)
def test_a_wrong_number_is_named(law: dict[str, Any], said: str) -> None:
    """With its field, value, and what was expected."""
    with pytest.raises(InputError) as refused:
        on_wall(**law)
    assert str(refused.value).startswith(said)


@pytest.mark.parametrize("law", [{"hardening": 3e4}, {"tension_only": True}, {"compression_only": True}], ids=str)
def test_the_linear_system_at_a_state_has_its_forces_and_their_derivatives(law: dict[str, Any]) -> None:
    """A spring of length L that pulls with F, of tangent stiffness k, has the rest length L - F/k: to rounding.

    With damping; that of slack springs is none.
    """
    system = moving(law)
    state = State(0.0, system.positions, system.velocities)
    linear = tangent_system(system, state)
    assert linear.nonlinear is None
    for one, other in zip(SpringMotion(linear).jacobians(state), SpringMotion(system).jacobians(state), strict=True):
        assert one.springs == pytest.approx(other.springs, rel=1e-12, abs=1e-9)
    found, expected = (SpringMotion(each).acceleration(state) for each in (linear, system))
    assert found == pytest.approx(expected, rel=1e-11, abs=1e-9)


def test_springs_without_force_have_neither_stiffness_nor_damping_nor_hardening() -> None:
    """Each of the three alone is a force."""
    string = find_scene("string").system({"masses": 4, "stiffness": "0,5,0,0", "damping": "0,0,1,0"})
    assert without_force(string).tolist() == [True, False, False, True]
    harder = replace(string, nonlinear=NonlinearSprings(hardening=np.array([0.0, 0.0, 0.0, 2.0])))
    assert without_force(harder).tolist() == [True, False, False, False]


def test_a_law_is_not_written_to() -> None:
    """As nothing of a system is: it is shared between them."""
    law = moving({"tension_only": True}).nonlinear
    assert law is not None
    assert not any(getattr(law, name).flags.writeable for name in KINDS)


def test_springs_of_the_usual_kind_are_linear() -> None:
    """Whatever is said of them that makes no difference; lists of springs keep theirs when they are turned round."""
    assert on_wall(hardening=0.0, tension_only=False).nonlinear is None
    string = find_scene("string").system({"masses": 3, "breaking_force": "1,2,3"})
    backwards = string.with_springs_reversed().nonlinear
    assert backwards is not None
    assert backwards.breaking_force.tolist() == [3.0, 2.0, 1.0]
    assert string.to_dict()["nonlinear"] == {"breaking_force": [1.0, 2.0, 3.0]}
    assert tensions(string, string.positions, string.velocities) == pytest.approx(np.zeros(3), abs=1e-12)
