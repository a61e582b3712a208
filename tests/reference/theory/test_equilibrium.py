"""Where strings and meshes come to rest: all forces balance, and the closed forms say the same."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.errors import InputError, SolverError
from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.springs.bending import with_bending
from reference.state import State
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.equilibrium import equilibrium, hanging_string
from reference.theory.limits import stability_limit
from tests import wrong
from tests.reference.systems import label, moving_string, property_test, random_mesh, seeds, with_fields


def check_balanced(system: MassSpringSystem, rest: State, law: wrong.Law = SpringMotion.acceleration) -> None:
    """All forces on free masses balance: to 1e-11 of the whole weight.

    The stiffest spring's force rounds by k eps L = 1e-14 N times some; the weight is at least 0.1 N.
    """
    weight = float(system.masses.sum() * np.linalg.norm(system.gravity))
    assert np.abs(law(SpringMotion(system), rest) * system.masses[:, None]).max() < 1e-11 * weight
    assert not rest.velocities.any()


@property_test
@given(seed=seeds, masses=st.integers(1, 8))
def test_a_hanging_string_is_in_balance(seed: int, masses: int) -> None:
    """Each spring carries all that is below it: L_j = L0_j + (m_{j+1} + ... + m_n) g / k_j."""
    rng = np.random.default_rng(seed)
    per_item = {
        "mass": rng.uniform(0.01, 0.1, masses).tolist(),
        "rest_length": rng.uniform(0.05, 0.2, masses).tolist(),
        "stiffness": rng.uniform(50, 500, masses).tolist(),
    }
    system = find_scene("string").system({"masses": masses, "x0": 0.3, "y0": -0.2, **per_item})
    check_balanced(system, hanging_string(system))


def test_forces_all_too_strong_balance_at_the_same_place() -> None:
    """What is zero stays zero: this check sees where a string hangs, not how hard it pulls."""
    system = find_scene("string").system({})
    check_balanced(system, hanging_string(system), wrong.slightly_stronger)


@pytest.mark.parametrize("law", [wrong.gravity_turned, wrong.one_sided], ids=label)
def test_balance_fails_on_wrong_forces(law: wrong.Law) -> None:
    """Under other forces it would hang elsewhere."""
    system = find_scene("string").system({})
    with pytest.raises(AssertionError):
        check_balanced(system, hanging_string(system), law)


def test_balance_fails_on_an_unstretched_string() -> None:
    """Hanging straight down at its rest lengths, it does not carry its weight."""
    system = find_scene("string").system({"angle": 90.0})
    with pytest.raises(AssertionError):
        check_balanced(system, system.start)


@pytest.mark.parametrize("masses", [1, 2, 5, 10])
def test_equilibrium_of_a_string_is_the_hanging_one(masses: int) -> None:
    """In closed form, to the bit."""
    system = find_scene("string").system({"masses": masses, "angle": 60.0})
    assert equilibrium(system).positions.tolist() == hanging_string(system).positions.tolist()


@pytest.mark.parametrize("masses", [1, 2, 5, 10])
def test_least_energy_finds_where_a_string_hangs(masses: int) -> None:
    """Numbered from below it is any mesh, found by least energy and Newton's method: to 1e-11 of the size.

    The softest swing resists with m g/l x_1/... ~ 0.05 N/m; forces balance to 1e-14 N.
    """
    system = find_scene("string").system({"masses": masses, "angle": 60.0})
    backwards = system.renumbered(np.arange(masses + 1)[::-1])
    assert not backwards.is_string
    found, straight = equilibrium(backwards), hanging_string(system)
    assert np.abs(found.positions[::-1] - straight.positions).max() < 1e-11 * system.size


def test_a_string_hangs_along_gravity_whichever_way_that_is() -> None:
    """L_j = L0_j + (m_{j+1} + ... + m_n) |g| / k_j along g/|g|: as under gravity downwards, turned. To 1e-11."""
    system = find_scene("string").system({"masses": 4, "angle": 60.0, "gravity": 5.0})
    tilted = replace(system, gravity=np.array([3.0, -4.0]))
    turn = np.array([[0.8, -0.6], [0.6, 0.8]])
    assert turn @ system.gravity == pytest.approx(tilted.gravity)
    expected = hanging_string(system).positions @ turn.T
    assert np.abs(equilibrium(tilted).positions - expected).max() < 1e-11 * system.size


def test_what_a_spring_without_stiffness_does_not_hold_is_at_rest_as_it_falls() -> None:
    """The first mass hangs on its spring, L0 + m g / k; the two below fall with theirs at its rest length."""
    rest = equilibrium(find_scene("string").system({"masses": 3, "stiffness": [200.0, 0.0, 200.0]}))
    lengths = np.linalg.norm(np.diff(rest.positions, axis=0), axis=1)
    assert lengths[0] == pytest.approx(0.125 + 0.02 * 9.81 / 200, abs=1e-12)
    assert lengths[2] == pytest.approx(0.125, abs=1e-12)


def test_a_damper_that_holds_nothing_creeps() -> None:
    """A mass that hangs on a spring with damping and no stiffness never comes to rest."""
    with pytest.raises(SolverError, match="spring 1 has damping and no stiffness"):
        equilibrium(find_scene("string").system({"masses": 3, "stiffness": [200.0, 0.0, 200.0], "damping": 0.1}))


def dashpot(damping: float) -> MassSpringSystem:
    """A mass of 0.02 kg on a spring of 200 N/m, and between it and the ground a damper without stiffness."""
    return MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.0, -0.125], [0.0, -0.5]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array(0.02),
        rest_lengths=np.array(0.125),
        stiffness=np.array([200.0, 0.0]),
        damping=np.array([0.0, damping]),
        fixed=np.array([True, False, True]),
    )


def check_dashpot(damping: float) -> None:
    """It hangs at L0 + m g/k; kick-drift is stable while h^2 k/m + 2 h c/m < 4, c = 0.5 N s/m, found to 1e-8."""
    rest = spring_equilibrium(dashpot(damping))
    assert rest.state.positions[1] == pytest.approx([0.0, -0.125 - 0.02 * 9.81 / 200], abs=1e-12)
    assert stability_limit(find("kick_drift"), rest).dt == pytest.approx((np.sqrt(25**2 + 4e4) - 25) / 1e4, rel=1e-7)


def test_a_dashpot_beside_a_spring_is_its_damping() -> None:
    """A damper without stiffness from a mass that a spring holds to the ground."""
    check_dashpot(0.5)


def test_another_dashpot_is_told_from_it() -> None:
    """Of a hundredth less damping."""
    with pytest.raises(AssertionError):
        check_dashpot(0.495)


@pytest.mark.parametrize("seed", range(8))
def test_equilibrium_of_any_held_mesh_is_in_balance(seed: int) -> None:
    """Random meshes in 2D and 3D with two fixed masses."""
    system = random_mesh(seed, 6, 2 + seed % 2, anchors=2)
    check_balanced(system, equilibrium(system))


def test_equilibrium_between_two_anchors_by_hand() -> None:
    """A mass between two anchors: by symmetry in the middle, 2 k (L - L0) sin = m g.

    With L = 0.5 m, anchors 0.8 m apart and so 0.3 m above it: sin = 0.6; m = 2 * 100 * (0.5 - 0.4) * 0.6 / 10.
    """
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.35, -0.1], [0.8, 0.0]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array(1.2),
        rest_lengths=np.array(0.4),
        stiffness=np.array(100.0),
        gravity=np.array(10.0),
        fixed=np.array([True, False, True]),
    )
    assert equilibrium(system).positions[1] == pytest.approx([0.4, -0.3], abs=1e-12)


def test_a_falling_system_is_at_rest_in_the_frame_that_falls_with_it() -> None:
    """No spring is stretched there."""
    rest = equilibrium(with_fields(find_scene("string").system({"masses": 2}), fixed=False))
    assert np.linalg.norm(np.diff(rest.positions, axis=0), axis=1) == pytest.approx([0.125, 0.125], abs=1e-12)


def test_masses_that_drag_holds_back_unequally_stretch_their_spring_as_they_fall() -> None:
    """Of masses m1 < m2 that fall for long at V = (m1 + m2) g / (2 Cd), the spring carries (m2 - m1) g / 2."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.0, -1.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array([1.0, 3.0]),
        rest_lengths=np.array(1.0),
        stiffness=np.array(100.0),
        drag=0.5,
        gravity=np.array(10.0),
    )
    rest = equilibrium(system)
    assert np.linalg.norm(rest.positions[1] - rest.positions[0]) == pytest.approx(
        1.0 + 2.0 * 10.0 / 2 / 100.0, abs=1e-10
    )


@pytest.mark.parametrize("order", [[0, 1], [1, 0]])
def test_a_mass_above_its_anchor_is_a_saddle_and_comes_down(order: list[int]) -> None:
    """However it is numbered: it hangs at L0 + m g / k below, where pushes come back."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.0, 1.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array(0.1),
        rest_lengths=np.array(1.0),
        stiffness=np.array(50.0),
        fixed=np.array([True, False]),
    ).renumbered(order)
    rest = equilibrium(system)
    assert rest.positions[~system.fixed][0] == pytest.approx([0.0, -1.0 - 0.1 * 9.81 / 50.0], abs=1e-9)


def test_upward_gravity_turns_a_string_upside_down() -> None:
    """By symmetry."""
    down, up = (equilibrium(find_scene("string").system({"masses": 4, "gravity": g})) for g in (9.81, -9.81))
    assert up.positions == pytest.approx(-down.positions * [-1, 1], abs=1e-12)


def test_a_mass_pressed_between_two_springs_buckles() -> None:
    """Two springs of 1 m in 1.8 m, no weight: straight, each in compression, is a saddle; aside, each has its length.

    The mass is then sqrt(1 - 0.81) m off the line.
    """
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.9, 0.0], [1.8, 0.0]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(100.0),
        gravity=np.array(0.0),
        fixed=np.array([True, False, True]),
    )
    assert abs(equilibrium(system).positions[1, 1]) == pytest.approx(np.sqrt(1 - 0.81), abs=1e-9)


@pytest.mark.parametrize("gravity", [9.81, 0.0, -9.81])
def test_strings_rest_in_three_dimensions(gravity: float) -> None:
    """Along gravity, or where there is none at their rest lengths."""
    flat = find_scene("string").system({"masses": 3, "gravity": gravity, "angle": 20.0})
    deep = replace(flat, positions=np.pad(flat.positions, ((0, 0), (0, 1))), gravity=np.append(flat.gravity, 0.0),
                   velocities=np.zeros((4, 3)))  # fmt: skip
    lengths = np.linalg.norm(np.diff(equilibrium(deep).positions, axis=0), axis=1)
    below = np.array([3, 2, 1]) * 0.02 * abs(gravity) / 200.0
    assert lengths == pytest.approx(0.125 + below, abs=1e-10)


def test_a_free_system_without_gravity_relaxes() -> None:
    """Every spring at its rest length: no forces."""
    stretched = with_fields(moving_string(3), fixed=False, gravity=0.0)
    relaxed = equilibrium(stretched)
    lengths = np.linalg.norm(np.diff(relaxed.positions, axis=0), axis=1)
    assert lengths == pytest.approx(stretched.rest_lengths, abs=1e-12)


@pytest.mark.parametrize(
    "system",
    [
        random_mesh(1, 5, 2),
        find_scene("string").system({"stiffness": 0.0}),
        replace(find_scene("string").system({"masses": 2}), fixed=np.array([True, False, True])),
        find_scene("string").system({"hardening": "100"}),
        with_bending(find_scene("string").system({}), 0.1),
        replace(find_scene("string").system({}), pulls=np.array([1.0, 0.0]) * np.ones((11, 1))),
    ],
    ids=["mesh", "no stiffness", "held at both ends", "no linear springs", "resists bending", "pulled"],
)
def test_only_strings_hang_straight(system: MassSpringSystem) -> None:
    """Any other system is refused."""
    with pytest.raises(InputError, match="system is no string"):
        hanging_string(system)
