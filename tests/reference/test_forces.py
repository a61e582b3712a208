"""The force law: by hand, its symmetries, and the energy it is the slope of."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.conserved import energy
from reference.forces import SpringMotion, springs_of_masses
from reference.scenes import find as find_scene
from reference.state import Array, State
from reference.system import MassSpringSystem
from tests import wrong
from tests.reference.systems import free_meshes, label, meshes, property_test, random_mesh, seeds, with_fields

#: Anything that gives a system's accelerations: the reference's own law, or a wrong one.
RIGHT: wrong.Law = SpringMotion.acceleration
WRONG = [wrong.gravity_turned, wrong.damping_turned, wrong.one_sided, wrong.sideways, wrong.slightly_stronger]


def accelerations(law: wrong.Law, system: MassSpringSystem, state: State | None = None) -> Array:
    """The accelerations of all masses under a law, at the start unless a state is given."""
    return law(SpringMotion(system), state or system.start)


def forces(law: wrong.Law, system: MassSpringSystem, state: State | None = None) -> Array:
    """The forces on all masses [N]; on fixed ones nothing is reported."""
    return system.masses[:, None] * accelerations(law, system, state)


def largest_force(system: MassSpringSystem) -> float:
    """A force [N] to measure rounding against: all springs' parts at their largest, and the weight."""
    a, b = system.springs.T
    length = np.linalg.norm(system.positions[b] - system.positions[a], axis=1)
    speed = np.abs(system.velocities).max() * 2
    parts = system.stiffness * (length + system.rest_lengths) + system.damping * speed
    return float(parts.sum() + system.drag * speed + (system.masses * np.abs(system.gravity).max()).max())


# --- By hand ---


def check_by_hand(law: wrong.Law) -> None:
    """F = k (L - L0) + c dL/dt along the spring, the weight m g downwards, the drag -Cd v, on the spring of slide 4.

    Stretched by 1 cm, moving upwards at 3 m/s: (2 + 0.1 * -3 pulls upwards) - 0.02 * 10 - 0.05 * 3 N. Rounding of
    the length, 0.135 m, is 2e-17 m * k = 4e-15 N.
    """
    parameters = {"stretch": 0.01, "velocity": 3.0, "damping": 0.1, "drag": 0.05, "gravity": 10.0}
    system = find_scene("spring").system(parameters)
    upwards = 200.0 * 0.01 - 0.1 * 3.0 - 0.02 * 10.0 - 0.05 * 3.0
    assert forces(law, system)[1] == pytest.approx([0.0, upwards], rel=1e-13)


def test_force_on_a_spring_by_hand() -> None:
    """The four parts of the force add up."""
    check_by_hand(RIGHT)


@pytest.mark.parametrize(
    "law", [wrong.gravity_turned, wrong.damping_turned, wrong.one_sided, wrong.slightly_stronger], ids=label
)
def test_force_by_hand_fails_on_wrong_laws(law: wrong.Law) -> None:
    """Each wrong law shows on a single spring, a part in 1e9 included."""
    with pytest.raises(AssertionError):
        check_by_hand(law)


def check_against_formula(law: wrong.Law, system: MassSpringSystem) -> None:
    """m_i a_i = sum over its springs of the formula in `reference.forces`, + m_i g - Cd v_i, written with NumPy only.

    The same numbers in another order: some eps of the largest parts.
    """
    a, b = system.springs.T
    gap = system.positions[b] - system.positions[a]
    length = np.linalg.norm(gap, axis=1)
    along = gap / length[:, None]
    lengthening = ((system.velocities[b] - system.velocities[a]) * along).sum(axis=1)
    pull = (system.stiffness * (length - system.rest_lengths) + system.damping * lengthening)[:, None] * along
    total = system.masses[:, None] * system.gravity - system.drag * system.velocities
    np.add.at(total, a, pull)
    np.add.at(total, b, -pull)
    total[system.fixed] = 0.0
    assert np.abs(forces(law, system) - total).max() < 1e-14 * largest_force(system)


@property_test
@given(system=meshes)
def test_kernels_are_the_formula_on_any_mesh(system: MassSpringSystem) -> None:
    """In 2D and 3D, with random springs, parameters and velocities."""
    check_against_formula(RIGHT, system)


@pytest.mark.parametrize("law", WRONG, ids=label)
def test_formula_fails_on_wrong_laws(law: wrong.Law) -> None:
    """Every wrong law is off it."""
    with pytest.raises(AssertionError):
        check_against_formula(law, random_mesh(1, 6, 3))


@property_test
@given(system=meshes)
def test_a_mass_alone_feels_exactly_what_it_feels_among_all(system: MassSpringSystem) -> None:
    """acceleration_of(i) has the bits of acceleration()[i]: in-place schemes differ by when they read only."""
    motion = SpringMotion(system)
    every = motion.acceleration(system.start)
    alone = [motion.acceleration_of(i, system.start).tolist() for i in range(len(system.masses))]
    assert alone == every.tolist()


@property_test
@given(system=meshes)
def test_damping_left_out_is_a_system_without_damping(system: MassSpringSystem) -> None:
    """acceleration(damping=False) keeps springs, weight and drag, to the bit."""
    undamped = SpringMotion(system).acceleration(system.start, damping=False)
    assert undamped.tolist() == SpringMotion(system.with_parameter("damping", 0.0)).acceleration(system.start).tolist()


# --- Symmetries ---


def check_third_law(law: wrong.Law, system: MassSpringSystem) -> None:
    """Forces between masses cancel: sum F = M g - Cd sum v, to the rounding of the largest."""
    outside = system.masses.sum() * system.gravity - system.drag * system.velocities.sum(axis=0)
    assert np.abs(forces(law, system).sum(axis=0) - outside).max() < 1e-14 * len(system.masses) * largest_force(system)


@property_test
@given(system=free_meshes)
def test_forces_cancel_by_newtons_third_law(system: MassSpringSystem) -> None:
    """What one end of a spring feels, the other feels opposite."""
    check_third_law(RIGHT, system)


@pytest.mark.parametrize("law", [wrong.gravity_turned, wrong.damping_turned, wrong.one_sided], ids=label)
def test_third_law_fails_on_wrong_laws(law: wrong.Law) -> None:
    """One-sided springs leave a force on the whole; so do weight or drag the wrong way round."""
    with pytest.raises(AssertionError):
        check_third_law(law, random_mesh(1, 6, 2, anchors=0))


def check_torque(law: wrong.Law, system: MassSpringSystem) -> None:
    """Forces between masses have no moment: sum x cross (F - m g + Cd v) = 0, to the rounding of the largest."""
    inner = forces(law, system) - system.masses[:, None] * system.gravity + system.drag * system.velocities
    x, f = (np.pad(a, ((0, 0), (0, 3 - system.dimension))) for a in (system.positions, inner))
    assert np.abs(np.cross(x, f).sum(axis=0)).max() < 1e-14 * len(system.masses) * largest_force(system) * system.size


@property_test
@given(system=free_meshes)
def test_spring_forces_have_no_moment(system: MassSpringSystem) -> None:
    """A spring pulls along the line between its masses, damping included."""
    check_torque(RIGHT, system)


@pytest.mark.parametrize("law", [wrong.one_sided, wrong.sideways], ids=label)
def test_moment_fails_on_wrong_laws(law: wrong.Law) -> None:
    """Sideways forces cancel and yet turn the whole."""
    with pytest.raises(AssertionError):
        check_torque(law, random_mesh(1, 6, 2, anchors=0))


def turned(system: MassSpringSystem, seed: int) -> tuple[MassSpringSystem, Array]:
    """The system under a random rotation, gravity and velocities turned with it, and the rotation, shape (d, d)."""
    q, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(system.dimension, system.dimension)))
    rotation = q * np.sign(np.linalg.det(q))
    fields = {n: getattr(system, n) @ rotation.T for n in ("positions", "velocities", "gravity")}
    return replace(system, **fields), rotation


@property_test
@given(system=meshes, seed=seeds)
def test_forces_turn_with_the_system(system: MassSpringSystem, seed: int) -> None:
    """F(R x, R v, R g) = R F(x, v, g): no direction is special. To the rounding of the largest force."""
    other, rotation = turned(system, seed)
    expected = forces(RIGHT, system) @ rotation.T
    assert np.abs(forces(RIGHT, other) - expected).max() < 2e-14 * largest_force(system)


@property_test
@given(system=meshes, shift=st.floats(-10, 10))
def test_forces_do_not_depend_on_the_place(system: MassSpringSystem, shift: float) -> None:
    """F(x + s) = F(x). Positions 10 m away round by 2e-15 m, which springs turn into k times as many newtons."""
    moved = replace(system, positions=system.positions + shift)
    rounding = 4e-15 * (system.stiffness.sum() * (1 + system.rest_lengths.max() / 0.1)) + 1e-14 * largest_force(system)
    assert np.abs(forces(RIGHT, moved) - forces(RIGHT, system)).max() < 2 * rounding


def check_galilean(law: wrong.Law, system: MassSpringSystem, velocity: float) -> None:
    """F(x, v + u) = F(x, v) - Cd u: springs and their damping do not see a motion of the whole (Galilei), drag does."""
    free = with_fields(system, fixed=False)
    moving = State(0.0, free.positions, free.velocities + velocity)
    expected = forces(law, free) - free.drag * velocity
    scale = largest_force(free) + (free.damping.sum() + free.drag) * abs(velocity)
    assert np.abs(forces(law, free, moving) - expected).max() < 2e-14 * scale


@property_test
@given(system=meshes, velocity=st.floats(-10, 10))
def test_forces_do_not_depend_on_a_motion_of_the_whole(system: MassSpringSystem, velocity: float) -> None:
    """Damping acts on the rate at which springs lengthen only."""
    check_galilean(RIGHT, system, velocity)


def test_galilean_invariance_fails_on_drag_turned_round() -> None:
    """Drag that pushes gives + Cd u."""
    with pytest.raises(AssertionError):
        check_galilean(wrong.damping_turned, random_mesh(1, 6, 2, anchors=0), 1.0)


# --- Energy ---


def check_slope_of_energy(law: wrong.Law, system: MassSpringSystem) -> None:
    """F = -dE/dx at rest, by central differences of the energy over h = 1e-5 m.

    Truncation is h^2/6 E''' with E''' of about k/L per spring: 1e-11 * k/L ~ 1e-8 N; rounding eps E/h ~ 1e-10 N.
    """
    still = with_fields(system, velocities=0.0)
    slope = np.zeros_like(still.positions)
    for index in np.ndindex(still.positions.shape):
        push = np.zeros_like(still.positions)
        push[index] = 1e-5
        ends = (energy(still, State(0.0, still.positions + sign * push, still.velocities)) for sign in (1, -1))
        slope[index] = -(next(ends) - next(ends)) / 2e-5
    slope[still.fixed] = 0.0
    shortest = min(np.linalg.norm(np.diff(still.positions[pair], axis=0)) for pair in still.springs)
    tolerance = 1e-10 * still.stiffness.sum() * max(still.rest_lengths.max(), shortest) / shortest**2
    assert np.abs(forces(law, still) - slope).max() < tolerance


@property_test
@given(system=meshes)
def test_forces_are_the_slope_of_the_energy(system: MassSpringSystem) -> None:
    """Springs and gravity are conservative, and the energy is theirs."""
    check_slope_of_energy(RIGHT, system)


@pytest.mark.parametrize("law", [wrong.gravity_turned, wrong.one_sided, wrong.sideways], ids=label)
def test_slope_of_energy_fails_on_wrong_laws(law: wrong.Law) -> None:
    """They are the slope of another energy, or of none."""
    with pytest.raises(AssertionError):
        check_slope_of_energy(law, random_mesh(1, 6, 2))


def check_dissipation(law: wrong.Law, system: MassSpringSystem) -> None:
    """The power of damping and drag, sum v . (F(x, v) - F(x, 0)), is never positive."""
    still = State(0.0, system.positions, np.zeros_like(system.velocities))
    power = (system.velocities * (forces(law, system) - forces(law, system, still))).sum()
    assert power <= 1e-14 * largest_force(system) * np.abs(system.velocities).max()


@property_test
@given(system=meshes)
def test_damping_and_drag_take_energy(system: MassSpringSystem) -> None:
    """-sum c (dL/dt)^2 - Cd sum v^2 <= 0."""
    check_dissipation(RIGHT, system)


def test_dissipation_fails_on_damping_turned_round() -> None:
    """Damping with the wrong sign feeds energy in."""
    with pytest.raises(AssertionError):
        check_dissipation(wrong.damping_turned, random_mesh(1, 6, 2))


# --- Around it ---


def test_forces_of_a_spring_of_no_length_are_not_numbers() -> None:
    """A spring whose masses have met has no direction; a run there diverges, and nothing is raised."""
    system = find_scene("string").system({"masses": 2})
    met = State(0.0, np.zeros((3, 2)), np.zeros((3, 2)))
    motion = SpringMotion(system)
    assert np.isnan(motion.acceleration(met)[1:]).all()
    assert np.isnan(motion.acceleration_of(1, met)).all()


def test_fixed_masses_do_not_accelerate() -> None:
    """Whatever pulls at them."""
    system = random_mesh(3, 6, 3, anchors=2)
    assert not SpringMotion(system).acceleration(system.start)[:2].any()


def test_slope_is_velocity_and_acceleration() -> None:
    """d/dt (t, x, v) = (1, v, a)."""
    system = random_mesh(3, 6, 3)
    motion = SpringMotion(system)
    slope = motion.slope(system.start)
    assert slope.time == 1.0
    assert slope.positions.tolist() == system.velocities.tolist()
    assert slope.velocities.tolist() == motion.acceleration(system.start).tolist()


def test_springs_of_masses_in_their_order_with_their_sign() -> None:
    """A star: mass 1 is first of springs 0 and 2 and second of spring 1; mass 4 has none."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 1.0], [9.0, 9.0]]),
        springs=np.array([[1, 0], [2, 1], [1, 3]]),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
    )
    first, spring, sign = springs_of_masses(system)
    of_each = [list(zip(spring[a:b].tolist(), sign[a:b].tolist(), strict=True)) for a, b in pairwise(first.tolist())]
    assert of_each == [[(0, -1.0)], [(0, 1.0), (1, -1.0), (2, 1.0)], [(1, 1.0)], [(2, -1.0)], []]


@pytest.mark.parametrize("scene", ["cloth", "jello", "bridge", "string"])
def test_every_mass_adds_its_springs_in_their_order(scene: str) -> None:
    """Whatever the masses are numbered by: sums of floats depend on it. A sort that is not stable loses it here."""
    plain = find_scene(scene).system({})
    system = plain.renumbered(np.random.default_rng(3).permutation(len(plain.masses)))
    first, spring, sign = springs_of_masses(system)
    for i, (a, b) in enumerate(pairwise(first.tolist())):
        joined = [(j, 1.0 if s[0] == i else -1.0) for j, s in enumerate(system.springs.tolist()) if i in s]
        assert list(zip(spring[a:b].tolist(), sign[a:b].tolist(), strict=True)) == joined


def test_a_system_without_springs_falls() -> None:
    """With the acceleration g."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0, 0.0]]),
        springs=np.zeros((0, 2), dtype=np.int64),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
    )
    assert SpringMotion(system).acceleration(system.start).tolist() == [[0.0, -9.81, 0.0]]


def test_a_pull_on_one_mass_of_many_is_its_force_over_its_mass() -> None:
    """On top of all else; none where nothing pulls, and none on what is fixed."""
    system = find_scene("string").system({"masses": 3, "mass": [0.1, 0.2, 0.4]})
    pulls = np.zeros_like(system.positions)
    pulls[0], pulls[2] = [9.0, 9.0], [0.6, -1.0]
    plain, pulled = (SpringMotion(s).acceleration(s.start) for s in (system, replace(system, pulls=pulls)))
    assert pulled - plain == pytest.approx(np.array([[0.0, 0.0], [0.0, 0.0], [3.0, -5.0], [0.0, 0.0]]), abs=1e-12)
