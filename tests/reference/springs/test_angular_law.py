"""Springs that resist bending: their law by differences, and their motion and rest by closed forms."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from reference.assembly import assemble, spring_blocks
from reference.compiled.kernels import advance
from reference.conserved import angular_momentum, energies, momentum
from reference.errors import Unsupported
from reference.forces import SpringMotion
from reference.lecture.listings import why_no_string
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.springs.angular import AngularSprings
from reference.springs.angular_law import (
    bends,
    bends_and_torques,
    derivatives,
    energy_of_bends,
    forces_on_masses,
    torques,
)
from reference.springs.bending import with_bending
from reference.state import Array, State
from reference.stepper import stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.modes import natural_modes
from reference.theory.parts import parts_of
from tests.wrong import heun_without_half

#: Corners of three masses: bent in the plane and in space, and in line.
CORNERS = {
    "plane": [[0.3, 0.1], [0.0, 0.0], [-0.1, 0.4]],
    "plane, in line": [[0.3, 0.0], [0.0, 0.0], [-0.4, 0.0]],
    "space": [[0.3, 0.1, -0.2], [0.0, 0.0, 0.1], [-0.1, 0.4, 0.0]],
    "space, in line": [[0.3, 0.3, 0.3], [0.1, 0.1, 0.1], [-0.2, -0.2, -0.2]],
    "space, in line between two axes": [[0.3, 0.1, 0.3], [0.0, 0.1, 0.0], [-0.2, 0.1, -0.2]],
}


def three(corner: list[list[float]], stiffness: float = 0.7, **more: Any) -> MassSpringSystem:
    """Three masses a, b, c on springs that are as long as at the start, an angular spring at b, and no gravity."""
    fields: dict[str, Any] = {"masses": np.array([0.2, 0.5, 0.3]), "fixed": np.zeros(3, dtype=bool), **more}
    x = np.array(corner)
    angular = AngularSprings(np.array([[0, 1, 2]]), np.array(stiffness), fields.pop("rest_angles", np.array(np.nan)))
    return MassSpringSystem(
        positions=x,
        springs=np.array([[0, 1], [1, 2]]),
        rest_lengths=np.linalg.norm(np.diff(x, axis=0), axis=1),
        stiffness=np.array(4e3),
        gravity=np.zeros(x.shape[1]),
        angular_springs=angular,
        **fields,
    )


def angular_of(system: MassSpringSystem) -> AngularSprings:
    """Those it has."""
    assert system.angular_springs is not None
    return system.angular_springs


def without_reaction(springs: AngularSprings, positions: Array) -> Array:
    """A wrong law: the force on the middle mass left out."""
    forces = forces_on_masses(springs, positions)
    forces[springs.masses[:, 1]] = 0.0
    return forces


def check_forces(law: Callable[[AngularSprings, Array], Array], corner: list[list[float]]) -> None:
    """F = -dV/dx by central differences, an error of h^2 = 1e-12 of it; and no sum, nor torque, to rounding."""
    system = three(corner)
    springs, x, h = angular_of(system), np.array(corner), 1e-6
    x = x + 0.02 * np.random.default_rng(1).normal(size=x.shape)  # off the rest angle
    forces = law(springs, x)
    for i, axis in np.ndindex(*x.shape):
        step = np.zeros_like(x)
        step[i, axis] = h
        slope = (energy_of_bends(springs, x + step) - energy_of_bends(springs, x - step)).sum() / (2 * h)
        assert forces[i, axis] == pytest.approx(-slope, rel=1e-6, abs=1e-7)
    assert forces.sum(axis=0) == pytest.approx(np.zeros(x.shape[1]), abs=1e-14)
    still = State(0.0, x, forces)  # the torque of forces is the angular momentum of velocities that are as large
    assert angular_momentum(replace(system, masses=np.ones(3)), still) == pytest.approx(np.zeros(3), abs=1e-14)


@pytest.mark.parametrize("corner", CORNERS.values(), ids=list(CORNERS))
def test_forces_are_the_slope_of_the_energy_and_add_up_to_nothing(corner: list[list[float]]) -> None:
    """And a law that leaves out the reaction on the middle mass is seen."""
    check_forces(forces_on_masses, corner)
    with pytest.raises(AssertionError):  # shown to fail
        check_forces(without_reaction, corner)


@pytest.mark.parametrize("off", [0.0, 0.05], ids=["at rest", "bent"])
@pytest.mark.parametrize("corner", CORNERS.values(), ids=list(CORNERS))
def test_jacobians_are_the_derivatives_of_the_forces(corner: list[list[float]], off: float) -> None:
    """Of springs and bends together by central differences of h = 1e-6; also where three masses are in line."""
    system = three(corner)
    moved = off * np.random.default_rng(2).normal(size=system.positions.shape)
    state = State(0.0, system.positions + moved, np.zeros_like(moved))
    motion, columns, h = SpringMotion(system), [], 1e-6
    for i, axis in np.ndindex(*moved.shape):
        step = np.zeros_like(moved)
        step[i, axis] = h
        ends = [
            motion.acceleration(State(0.0, state.positions + s * step, state.velocities)) * system.masses[:, None]
            for s in (1, -1)
        ]
        columns.append((ends[0] - ends[1]).ravel() / (2 * h))
    matrix = assemble(system, spring_blocks(system, state)[0], sparse=False)
    assert matrix == pytest.approx(np.stack(columns, axis=1), abs=1e-7 * 4e3)
    assert matrix == pytest.approx(matrix.T, abs=1e-11)


def test_a_right_angle_at_rest_straight_is_bent_by_a_quarter_turn() -> None:
    """-pi/2 from pi, and kappa times that; of none both are empty, for every frame."""
    corner = np.array([[1.0, 0.0], [0.0, 0.0], [0.0, 2.0]])
    one = AngularSprings(np.array([[0, 1, 2]]), np.array([3.0]), np.array([np.pi]))
    bent, torque = bends_and_torques(one, corner)
    assert bent == pytest.approx([-np.pi / 2], rel=1e-15)
    assert torque == pytest.approx([-3 * np.pi / 2], rel=1e-15)
    assert [found.shape for found in bends_and_torques(None, np.zeros((7, 3, 2)))] == [(7, 0), (7, 0)]


def test_many_in_space_are_as_each_alone() -> None:
    """Three in line along different axes, with arms of different lengths, and two bent: forces and derivatives."""
    x = np.random.default_rng(5).normal(size=(15, 3))
    x[2], x[5], x[8] = x[1] - 0.3 * (x[0] - x[1]), x[4] - 1.7 * (x[3] - x[4]), x[7] - 0.9 * (x[6] - x[7])
    x[6], x[8] = x[7] + [0.0, 0.4, 0.0], x[7] - [0.0, 0.7, 0.0]
    masses, stiffness = np.arange(15).reshape(5, 3), np.array([0.3, 0.4, 0.5, 0.6, 0.7])
    rest = np.array([np.pi, np.pi, np.pi, 1.0, 2.0])
    forces = forces_on_masses(AngularSprings(masses, stiffness, rest), x)
    matrices = derivatives(AngularSprings(masses, stiffness, rest), x)
    for j in range(5):
        alone = AngularSprings(masses[j : j + 1], stiffness[j : j + 1], rest[j : j + 1])
        one = forces_on_masses(alone, x)
        assert forces[3 * j : 3 * j + 3] == pytest.approx(one[3 * j : 3 * j + 3], abs=1e-12)
        assert matrices[j] == pytest.approx(derivatives(alone, x)[0], abs=1e-12 * np.abs(matrices[j]).max())


@pytest.mark.parametrize("dimension", [2, 3])
def test_arms_in_line_that_rest_bent_have_a_direction_in_the_plane_only(dimension: int) -> None:
    """Of four masses in line; forces there are kappa beta/l. Without stiffness there are none, and no derivatives."""
    x = np.pad(np.array([[0.0], [0.5], [1.0], [2.0]]), ((0, 0), (0, dimension - 1)))
    rests, kappa = np.array([np.pi - 0.5, np.pi - 0.5]), np.array([0.7, 0.0])
    forces = forces_on_masses(AngularSprings(np.array([[0, 1, 2], [1, 2, 3]]), kappa, rests), x)
    if dimension == 3:
        assert np.isnan(forces[:3]).all()
        assert not forces[3].any()
    else:
        assert forces[:, 1] == pytest.approx(0.7 * 0.5 / 0.5 * np.array([1, -2, 1, 0]) * np.sign(forces[0, 1]))
        assert forces[:, 0] == pytest.approx(np.zeros(4), abs=1e-15)
    straight = AngularSprings(np.array([[0, 1, 2], [1, 2, 3]]), kappa, np.full(2, np.pi))
    slopes = derivatives(straight, x)
    assert np.isfinite(slopes).all()
    assert slopes[0].any()
    assert not slopes[1].any()


def bent_pair(**more: Any) -> MassSpringSystem:
    """Two masses on arms of 0.3 and 0.4 m at a right angle, about a middle that is held."""
    corner = [[0.3, 0.0], [0.0, 0.0], [0.0, 0.4]]
    return three(corner, fixed=np.array([False, True, False]), **more)


#: Two arms turn against one another: kappa (1/(m_a l_a^2) + 1/(m_c l_c^2)); each along itself: k/m.
OF_BEND = 0.7 * (1 / (0.2 * 0.3**2) + 1 / (0.3 * 0.4**2))


def test_a_bent_pair_swings_as_two_arms_against_one_another() -> None:
    """Its frequencies to rounding; a run's bend is cos(w t), to RK4's (w dt)^4 and the amplitude's square."""
    system = bent_pair()
    rest = spring_equilibrium(system)
    assert rest.linear is not None
    squares = (2 * np.pi * natural_modes(rest.linear).frequencies) ** 2
    assert squares == pytest.approx(sorted([0.0, OF_BEND, 4e3 / 0.2, 4e3 / 0.3]), rel=1e-10)
    start = 1e-5 * np.array([[0.0, -0.3 / (0.2 * 0.3**2)], [0.0, 0.0], [-0.4 / (0.3 * 0.4**2), 0.0]])
    thrown = replace(system, velocities=start)

    def check(scheme: Any) -> None:
        run = simulate(thrown, scheme, 2e-3, 0.5)
        bend = bends(angular_of(system), run.positions)[:, 0]
        w = np.sqrt(OF_BEND)
        size = 1e-5 * (1 / (0.2 * 0.3**2) + 1 / (0.3 * 0.4**2)) / w
        assert bend == pytest.approx(size * np.sin(w * run.times), abs=1e-4 * size)

    check(find("rk4"))
    with pytest.raises(AssertionError):  # shown to fail
        check(heun_without_half)


def test_a_free_linear_molecule_bends_alike_in_both_directions() -> None:
    """w^2 = 2 kappa (2 m + M) / (l^2 m M), twice in space (Landau and Lifshitz, *Mechanics*, 24, problem 1)."""
    line = [[-0.4, 0.0, 0.0], [0.0, 0.0, 0.0], [0.4, 0.0, 0.0]]
    system = three(line, masses=np.array([0.2, 0.5, 0.2]))
    rest = spring_equilibrium(system)
    assert rest.linear is not None
    squares = (2 * np.pi * natural_modes(rest.linear).frequencies) ** 2
    bend = 2 * 0.7 * (2 * 0.2 + 0.5) / (0.4**2 * 0.2 * 0.5)
    assert squares == pytest.approx([0.0] * 5 + [bend, bend, 4e3 / 0.2, 4e3 * (2 * 0.2 + 0.5) / (0.2 * 0.5)], rel=1e-9)


def cantilever(gravity: float, dimension: int = 2) -> MassSpringSystem:
    """Twelve masses, 0.1 m apart along the first axis, the first two held: a beam of springs that are very stiff."""
    x = np.zeros((12, dimension))
    x[:, 0] = 0.1 * np.arange(12)
    plain = MassSpringSystem(
        positions=x,
        springs=np.stack([np.arange(11), np.arange(1, 12)], axis=1),
        masses=np.array(0.05),
        rest_lengths=np.array(0.1),
        stiffness=np.array(1e5),
        gravity=np.array(gravity),
        fixed=np.arange(12) < 2,
    )
    return with_bending(plain, 2.0)


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_cantilever_hangs_where_its_torques_balance(dimension: int) -> None:
    """About every mass: kappa beta_i = sum of m g (x_j - x_i) over those further out, however far it bends.

    What a spring pulls passes through the mass it ends at, and has no torque about it. (The discrete elastica.) To a
    millionth: what is left of the forces in balance, times the length.
    """
    system = cantilever(9.81, dimension)
    x = spring_equilibrium(system).state.positions
    assert x[-1, 1] < -0.3
    moments = [0.05 * 9.81 * (x[i + 1 :, 0] - x[i, 0]).sum() for i in range(1, 11)]
    assert np.abs(torques(angular_of(system), x)) == pytest.approx(moments, rel=1e-6)


def test_a_cantilever_that_bends_little_does_as_its_linear_solution() -> None:
    """y_j = sum of the bends before it times their distance, of the straight beam's moments; to the bend's square."""
    gravity = 1e-3
    x = spring_equilibrium(cantilever(gravity)).state.positions
    along = 0.1 * np.arange(12)
    bend = np.array([0.05 * gravity * (along[i + 1 :] - along[i]).sum() / 2.0 for i in range(1, 11)])
    sag = [sum(bend[: j - 1] * (along[j] - along[1:j])) for j in range(2, 12)]
    assert -x[2:, 1] == pytest.approx(sag, rel=1e-6)


@pytest.mark.rotating(2)
@pytest.mark.parametrize("dimension", [2, 3])
def test_what_is_free_keeps_energy_and_both_momenta(dimension: int) -> None:
    """A wire thrown into the air: momenta to rounding, RK4's energy to (w dt)^4 over 300 steps."""
    wire = find_scene("string").system({"masses": 5, "gravity": 0.0})
    x = np.pad(wire.positions, ((0, 0), (0, dimension - 2)))
    v = 0.3 * np.random.default_rng(3).normal(size=x.shape)
    loose = replace(wire, positions=x, velocities=v, gravity=np.zeros(dimension), fixed=np.zeros(6, dtype=bool))
    free = with_bending(loose, 0.02)
    run = simulate(free, find("rk4"), 1e-3, 0.3)
    assert np.abs(bends(angular_of(free), run.positions)).max() > 0.2
    first, last = run.states()[0], run.states()[-1]
    assert momentum(free, last) == pytest.approx(momentum(free, first), abs=1e-13)
    assert angular_momentum(free, last) == pytest.approx(angular_momentum(free, first), abs=1e-8)
    energy = energies(free, run)
    assert np.ptp(energy) < 1e-4 * energy[0]
    wrong = energies(free, simulate(free, heun_without_half, 5e-4, 0.05))
    assert np.ptp(wrong) > 1e-2 * wrong[0]  # shown to fail


def test_one_mass_alone_is_given_the_bits_it_has_within_the_whole() -> None:
    """As of springs alone."""
    system = find_scene("string").system({"masses": 5, "angle": 20.0, "angular_stiffness": 0.02})
    moved = replace(system.start, positions=system.positions + 0.01 * np.arange(12).reshape(6, 2) ** 2)
    motion = SpringMotion(system)
    whole = motion.acceleration(moved)
    for i in range(6):
        assert motion.acceleration_of(i, moved).tolist() == whole[i].tolist()


def test_limits_are_about_the_state_that_is_taken() -> None:
    """Kick-drift's is 2 over the fastest frequency: that of the bend, of a pair on springs that are soft beside it."""
    rest = spring_equilibrium(replace(bent_pair(), stiffness=np.array([1.0, 1.0])))
    assert stability_limit(find("kick_drift"), rest).dt == pytest.approx(2 / np.sqrt(OF_BEND), rel=1e-6)


def test_an_implicit_scheme_steps_many_of_them_as_few() -> None:
    """A system too large for small matrices is solved as the same one by itself: to 1e-10 of its size."""
    wire = cantilever(9.81)
    one = simulate(wire, find("backward_euler"), 1e-3, 0.01).positions[-1]
    copies = 20
    many = MassSpringSystem(
        positions=np.concatenate([wire.positions + np.array([0.0, 5.0 * i]) for i in range(copies)]),
        springs=np.concatenate([wire.springs + 12 * i for i in range(copies)]),
        masses=np.array(0.05),
        rest_lengths=np.array(0.1),
        stiffness=np.array(1e5),
        fixed=np.tile(wire.fixed, copies),
    )
    all_of_them = simulate(with_bending(many, 2.0), find("backward_euler"), 1e-3, 0.01).positions[-1]
    assert all_of_them[-12:] - [0.0, 5.0 * (copies - 1)] == pytest.approx(one, abs=1e-10)


def test_what_cannot_step_them_refuses() -> None:
    """Compiled loops, rods, the lecture's listings, solvers of constraints: in a line."""
    string = find_scene("string").system({"angular_stiffness": 0.1})
    with pytest.raises(Unsupported, match="resist bending"):
        advance(string, find("heun"), 1e-3, 1)
    for name in ("pendulum_heun", "rope_kick_drift", "xpbd_jacobi"):
        outcome = stepper_named(name).run(string, 1e-3, 1)
        assert (outcome.ending, "bending" in outcome.reason) == ("unsupported", True), name
    assert "bending" in (why_no_string(string) or "")


def test_systems_keep_their_angular_springs_when_they_are_renumbered() -> None:
    """The same forces, mass by mass; the plain lists make the same again."""
    system = three(CORNERS["space"], velocities=np.zeros((3, 3)))
    turned = system.renumbered([2, 0, 1])
    moved = system.positions + 0.1 * np.eye(3)
    forces = forces_on_masses(angular_of(system), moved)
    assert forces_on_masses(angular_of(turned), moved[[2, 0, 1]]) == pytest.approx(forces[[2, 0, 1]], abs=1e-15)
    again = AngularSprings(**{name: np.array(value) for name, value in system.to_dict()["angular_springs"].items()})
    assert replace(system, angular_springs=again).to_dict() == system.to_dict()


def test_what_only_an_angle_holds_is_of_one_part() -> None:
    """A mass that no spring holds, only the angle: its part is held, and without the angle it is loose."""
    one = {"springs": np.array([[0, 1]]), "damping": np.zeros(1)}
    system = replace(bent_pair(), **one, rest_lengths=np.array([0.3]), stiffness=np.array([4e3]))
    assert parts_of(system).held.all()
    assert not parts_of(replace(system, angular_springs=None)).held.all()


@pytest.mark.parametrize("dimension", [2, 3])
def test_an_angular_spring_goes_with_the_spring_along_its_arm(dimension: int) -> None:
    """What is cut off falls by y = -g t^2/2, to rounding in RK4; a second spring there, or none from the start, holds.

    The bend is set off its rest, in space to a straight line, so that what is left of it would show at once.
    """
    corner = np.pad([[0.2, 0.2], [0.1, 0.0], [0.0, 0.0]], ((0, 0), (0, dimension - 2)))
    system = three(corner.tolist(), fixed=np.array([False, True, True]))
    falling = replace(system, gravity=np.array([0.0, -9.81, 0.0][:dimension])).with_parameter("break", [0])
    fell = simulate(falling, find("rk4"), 1e-3, 0.1).positions[-1, 0] - corner[0]
    assert fell == pytest.approx([0.0, -9.81 * 0.1**2 / 2, 0.0][:dimension], abs=1e-14)
    straight = np.pad([[0.2, 0.0], [0.1, 0.0], [0.0, 0.0]], ((0, 0), (0, dimension - 2)))
    cut = angular_of(falling)
    for positions in (straight, np.zeros_like(straight)):
        assert not forces_on_masses(cut, positions).any()
        assert not derivatives(cut, positions).any()
    one = {"rest_lengths": np.array(0.1), "stiffness": np.array(4e3), "damping": np.zeros(1)}
    cases = (([[0, 1], [1, 0], [1, 2]], False), ([[0, 2], [1, 2]], False), ([[1, 2]], True))
    for springs, goes in cases:
        held = replace(system, springs=np.array(springs), **one).with_parameter("break", [0])
        assert (angular_of(held).stiffness == 0).all() == goes, springs
