"""The bridges: how they are built; their forces by the method of joints, their sag and swings by direct stiffness."""

from __future__ import annotations

from dataclasses import replace
from math import pi, sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.conserved import energy
from reference.outcome import outcome_of
from reference.scenes import find as find_scene
from reference.scenes.trusses import truss
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from reference.system import MassSpringSystem
from reference.theory.equilibrium import equilibrium
from reference.theory.modes import squared_frequencies
from tests import wrong
from tests.reference.scenes.direct_stiffness import bar_forces, deflection, forces_by_joints, measured_period, modes
from tests.reference.systems import label, property_test, with_fields

KINDS = ("warren", "pratt", "howe")
kinds = st.sampled_from(KINDS)

#: As a part of the earth's: strains of some 1e-2 become some 1e-7, and so does what small-displacement theory leaves
#: out. A displacement of 1e-6 m is then known to 1e-9 of itself, as positions of 24 m round by 4e-15 m.
LIGHT = 1e-5 * 9.81


def bridge(kind: str = "warren", gravity: float = LIGHT, **settings: Any) -> MassSpringSystem:
    """The scene, with next to no weight."""
    return find_scene("bridge").system({"kind": kind, "gravity": gravity, **settings})


# --- How they are built ---


@property_test
@given(kind=kinds, half=st.integers(1, 12), panel=st.floats(0.1, 10.0), height=st.floats(0.1, 10.0))
def test_trusses_are_statically_determinate(kind: Any, half: int, panel: float, height: float) -> None:
    """2 j = m + 3, no member twice, and the joint equations have one solution: the truss is rigid too."""
    built = truss(kind, 2 * half, panel, height)
    assert 2 * len(built.joints) == len(built.members) + 3
    assert len({frozenset(pair) for pair in built.members.tolist()}) == len(built.members)
    loads = np.tile([0.0, -1.0], (len(built.joints), 1))
    forces, (pin_x, pin_y, roller_y) = forces_by_joints(built.joints, built.members, loads, 0, 2 * half)
    assert np.isfinite(forces).all()
    assert pin_x == pytest.approx(0.0, abs=1e-9 * len(loads))
    assert [pin_y, roller_y] == pytest.approx([len(loads) / 2] * 2)


@pytest.mark.parametrize(("kind", "sign"), [("pratt", 1), ("howe", -1)])
def test_pratts_diagonals_are_pulled_and_howes_are_pushed(kind: Any, sign: int) -> None:
    """Under a load that is the same at every joint; so the patents say."""
    built = truss(kind, 8, 3.0, 3.0)
    forces, _ = forces_by_joints(built.joints, built.members, np.tile([0.0, -1.0], (16, 1)), 0, 8)
    diagonals = np.ptp(built.joints[built.members], axis=1).all(axis=1)
    diagonals[14:16] = False  # the end posts
    assert diagonals.sum() == 6
    assert (sign * forces[diagonals] > 0).all()


def test_joints_carry_their_members_the_deck_and_the_truck() -> None:
    """Two panels of 4 m, 3 m high, by hand: end posts of 5 m, a vertical of 3 m, each half at its joints."""
    built = truss("pratt", 2, 4.0, 3.0)
    assert built.lengths.tolist() == [4.0, 4.0, 5.0, 5.0, 3.0]
    masses = built.masses(per_length=2.0, deck=10.0, truck=100.0, truck_position=5.0)
    assert masses.tolist() == [4 + 5 + 20, 4 + 4 + 3 + 40 + 75, 4 + 5 + 20 + 25, 5 + 5 + 3]


@property_test
@given(kind=kinds, part=st.floats(0.0, 1.0))
def test_the_truck_weighs_the_same_wherever_it_stands(kind: str, part: float) -> None:
    """Its mass, and where its middle is, are kept by the joints that share it."""
    empty = bridge(kind, truck=0.0)
    loaded = bridge(kind, truck=7000.0, truck_position=24 * part)
    more = (loaded.masses - empty.masses)[:-1]
    more[8] = loaded.masses[8] - empty.masses[8]
    assert more.sum() == pytest.approx(7000.0)
    assert more @ empty.positions[:-1, 0] == pytest.approx(7000.0 * 24 * part, abs=1e-6)


def test_the_bridge_stands_on_a_pin_and_a_rocker() -> None:
    """The left end is fixed, and the foot straight below the right one, which is not."""
    system = bridge()
    assert np.flatnonzero(system.fixed).tolist() == [0, 17]
    assert system.positions[8].tolist() == [24.0, 0.0]
    assert system.positions[17].tolist() == [24.0, -3.0]
    assert system.springs[-1].tolist() == [8, 17]


@pytest.mark.parametrize("kind", KINDS)
def test_the_soil_carries_the_bridge_by_two_masses_of_its_surface(kind: str) -> None:
    """Its mass and the bridge's; the lowest row fixed; nothing stretched at the start."""
    settings = {"kind": kind, "panels": 4, "rows": 3, "margin": 1, "truck_position": 6.0}
    system = find_scene("soil").system(settings)
    built = truss(kind, 4, 3.0, 3.0)  # type: ignore[arg-type]
    assert len(system.masses) == 3 * 7 + len(built.joints) - 2
    assert len(system.springs) == (3 * 6 + 2 * 7 + 2 * 2 * 6) + len(built.members)
    assert system.masses.sum() == pytest.approx(21 * 4000.0 + built.masses(200.0, 400.0, 5000.0, 6.0).sum())
    assert np.flatnonzero(system.fixed).tolist() == list(range(7))
    ends = np.flatnonzero((system.positions == [0.0, 0.0]).all(1) | (system.positions == [12.0, 0.0]).all(1))
    assert ends.tolist() == [15, 19]
    a, b = system.springs.T
    assert np.linalg.norm(system.positions[b] - system.positions[a], axis=1) == pytest.approx(system.rest_lengths)
    joined = system.positions[system.springs[-len(built.members) :]]
    assert joined == pytest.approx(built.joints[built.members])


@pytest.mark.parametrize("name", ["bridge", "soil"])
@pytest.mark.parametrize("scheme", ["kick_drift", "heun"])
def test_their_own_step_is_a_stable_one(name: str, scheme: str) -> None:
    """For as long as they are shown, the whole energy stays within a hundredth of what is lost or turned over."""
    scene = find_scene(name)
    system = scene.system({})
    outcome = outcome_of(system, simulate(system, find(scheme), scene.dt, scene.duration))
    assert outcome.ending == "done"
    assert outcome.trajectory is not None
    states = outcome.trajectory.states()
    turned_over = 0.5 * max(float(system.masses @ (s.velocities**2).sum(axis=1)) for s in states)
    assert energy(system, states[-1]) < energy(system, states[0]) + 0.01 * turned_over


# --- Member forces, against the method of joints ---


def check_forces(system: MassSpringSystem, kind: str, part: float = 1e-6) -> None:
    """At rest, k (L - L0) is what the joint equations ask of every member, and of the rocker as the right reaction.

    To 1e-6 of the largest: see LIGHT.
    """
    built = truss(kind, 8, 3.0, 3.0)  # type: ignore[arg-type]
    found = bar_forces(system, equilibrium(system).positions)
    loads = system.masses[:-1, None] * system.gravity
    forces, reactions = forces_by_joints(built.joints, built.members, loads, 0, 8)
    expected = np.append(forces, -reactions[2])
    assert np.abs(found - expected).max() < part * np.abs(expected).max()


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("truck_position", [0.0, 4.5, 12.0])
def test_member_forces_are_those_of_the_method_of_joints(kind: str, truck_position: float) -> None:
    """With a truck at the end, within a panel, and in the middle."""
    check_forces(bridge(kind, truck_position=truck_position), kind)


@pytest.mark.parametrize("kind", KINDS)
def test_in_a_determinate_truss_stiffness_changes_no_force(kind: str) -> None:
    """Members of all stiffnesses, from a half to twice: the joint equations know none."""
    uneven = np.random.default_rng(3).uniform(2.5e7, 1e8, 31 if kind == "warren" else 29)
    check_forces(bridge(kind, axial_stiffness=uneven.tolist()), kind)


def test_member_forces_fail_on_another_structure() -> None:
    """Both ends pinned; the whole weight, at which the bridge sags by a hundredth; another truss."""
    good = bridge()
    pinned = with_fields(good, fixed=np.isin(np.arange(18), [0, 8, 17]))
    for system in (pinned, bridge(gravity=9.81)):
        with pytest.raises(AssertionError):
            check_forces(system, "warren")
    with pytest.raises(AssertionError):
        check_forces(bridge("pratt"), "howe")


def test_the_middle_of_the_bottom_chord_by_hand() -> None:
    """Ritter's cut: its force is M/h. Eight panels of 3 m, 1 N at each inner bottom joint, Pratt, 3 m high.

    Reactions are 3.5 N. About the top joint above joint 4: M = 3.5 * 12 - (3 + 6 + 9) = 24 N m, so the top chord has
    -8 N; about joint 3's top for the bottom member from 3 to 4: M = 3.5 * 9 - (3 + 6) = 22.5 N m, so 7.5 N.
    """
    built = truss("pratt", 8, 3.0, 3.0)
    loads = np.zeros((16, 2))
    loads[1:8, 1] = -1.0
    forces, _ = forces_by_joints(built.joints, built.members, loads, 0, 8)
    assert forces[3] == pytest.approx(7.5)
    assert forces[10] == pytest.approx(-8.0)
    assert built.members[10].tolist() == [11, 12]


# --- Deflection and frequencies, against direct stiffness ---


def check_sag(system: MassSpringSystem, by_the_textbook: MassSpringSystem) -> None:
    """Every joint is where K u = M g has it, to 1e-6 of the largest displacement: see LIGHT."""
    moved = equilibrium(system).positions - system.positions
    expected = deflection(by_the_textbook)
    assert np.abs(moved - expected).max() < 1e-6 * np.abs(expected).max()


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("panels", [4, 8, 40])
def test_the_bridge_sags_as_direct_stiffness_says(kind: str, panels: int) -> None:
    """Short and long; with 40 panels it is a large system. Longer bridges sag more, so they weigh less."""
    light = LIGHT * min(1.0, (8 / panels) ** 4)
    system = bridge(kind, panels=panels, gravity=light, truck_position=1.5 * panels)
    check_sag(system, system)


def test_a_bridge_on_soil_settles_as_direct_stiffness_says() -> None:
    """With a truck on it."""
    system = find_scene("soil").system({"gravity": LIGHT})
    check_sag(system, system)
    with pytest.raises(AssertionError):
        check_sag(system, find_scene("soil").system({"gravity": LIGHT, "truck": 5001.0}))


def test_sag_fails_on_other_members_other_loads_and_a_whole_weight() -> None:
    """One member stiffer by a ten-thousandth; a kilogram more of a truck of five tonnes; the whole weight."""
    good = bridge()
    stiffer = [5e7] * 31
    stiffer[4] *= 1 + 1e-4
    for system, other in (
        (bridge(axial_stiffness=stiffer), good),
        (bridge(truck=5001.0), good),
        (bridge(gravity=9.81), bridge(gravity=9.81)),
    ):
        with pytest.raises(AssertionError):
            check_sag(system, other)


def check_frequencies(system: MassSpringSystem, by_the_textbook: MassSpringSystem) -> None:
    """The eight slowest w^2 about the unloaded bridge, to 1e-9: eps times the condition of K, 1e4."""
    squares, _ = modes(by_the_textbook, 8)
    assert squared_frequencies(system, system.start)[:8] == pytest.approx(np.sort(squares), rel=1e-9)


@pytest.mark.parametrize("kind", KINDS)
def test_the_unloaded_bridges_frequencies_are_the_eigenvalues(kind: str) -> None:
    """And not those of a bridge with a kilogram more on it."""
    system = bridge(kind, gravity=0.0)
    check_frequencies(system, system)
    with pytest.raises(AssertionError):
        check_frequencies(system, bridge(kind, gravity=0.0, truck=5001.0))


def check_swing(scheme: Scheme, mode: int, by_the_textbook: MassSpringSystem) -> None:
    """Pushed along a mode by 10 um, it swings with 2 pi / w to 1e-6.

    RK4's phase error is (w dt)^4/120 = 1e-9 at 300 steps a period; members of 3 m turn by 1e-5, and w changes by the
    square of that times what bars lengthen less when they turn, 1e-8 at most.
    """
    system = bridge(gravity=0.0)
    squares, shapes = modes(by_the_textbook, mode + 1)
    shape, period = shapes[mode] / np.abs(shapes[mode]).max(), 2 * pi / sqrt(squares[mode])
    dt = period / 300
    pushed = replace(system, positions=system.positions + 1e-5 * shape)
    trajectory = simulate(pushed, scheme, dt, 2.6 * period)
    assert len(trajectory) > 750, "it blew up"
    assert measured_period(trajectory, system.positions, shape, system.masses) == pytest.approx(period, rel=1e-6)


@pytest.mark.parametrize("mode", range(3))
def test_the_bridge_swings_as_its_eigenvalues_say(mode: int) -> None:
    """Its three slowest modes, seen in runs."""
    check_swing(find("rk4"), mode, bridge(gravity=0.0))


@pytest.mark.parametrize(
    "scheme",
    [wrong.heun_without_half, wrong.kick_drift_kicked_twice, wrong.stepped(wrong.one_sided, find("rk4"))],
    ids=label,
)
def test_swing_fails_on_wrong_integrators(scheme: Scheme) -> None:
    """Twice as fast, too stiff, or members that only pull."""
    with pytest.raises(AssertionError):
        check_swing(scheme, 0, bridge(gravity=0.0))


def test_swing_fails_on_another_bridge() -> None:
    """A truck heavier by a kilogram."""
    with pytest.raises(AssertionError):
        check_swing(find("rk4"), 0, bridge(gravity=0.0, truck=5001.0))


# --- Settlement ---


def settlement(settings: dict[str, Any]) -> float:
    """How much lower the bridge's two ends are with it than without it [m], on the average."""
    loaded = find_scene("soil").system(settings)
    bare = find_scene("soil").system({**settings, "mass_per_length": 1e-6, "deck": 0.0, "truck": 0.0})
    ends = np.flatnonzero((loaded.positions == [0.0, 0.0]).all(1) | (loaded.positions == [18.0, 0.0]).all(1))
    heights = [equilibrium(system).positions[ends, 1].mean() for system in (bare, loaded)]
    return float(heights[0] - heights[1])


def test_the_bridge_settles_more_on_softer_soil_and_under_a_truck() -> None:
    """The order of what is measured; not how much."""
    plain = settlement({"truck": 0.0})
    assert 0 < plain < settlement({"truck": 0.0, "soil_stiffness": 8e5})
    assert plain < settlement({"truck": 20000.0})
