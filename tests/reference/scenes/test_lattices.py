"""Cloth and jello: how they are built, and how they move, against direct stiffness, a run's period, a run to rest."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.conserved import energy
from reference.outcome import outcome_of
from reference.scenes import find as find_scene
from reference.scenes.lattices import NEIGHBOURS, TETRAHEDRA, lattice, springs_between
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from reference.system import MassSpringSystem
from reference.theory.equilibrium import equilibrium
from reference.theory.modes import squared_frequencies
from tests import wrong
from tests.reference.scenes.direct_stiffness import deflection, measured_period, modes
from tests.reference.systems import label, property_test

# --- How they are built ---


def lengths_at_the_start(system: MassSpringSystem) -> Any:
    """Of all springs [m]."""
    a, b = system.springs.T
    return np.linalg.norm(system.positions[b] - system.positions[a], axis=1)


def check_built(system: MassSpringSystem, springs: int) -> None:
    """So many springs, no pair of masses twice, and none stretched: lengths round by eps times the size."""
    assert len(system.springs) == springs
    assert len({frozenset(pair) for pair in system.springs.tolist()}) == springs
    assert np.abs(lengths_at_the_start(system) - system.rest_lengths).max() < 1e-15 * max(system.size, 1e-300) * 4


@property_test
@given(rows=st.integers(2, 9), columns=st.integers(2, 9), side=st.floats(1e-3, 10.0))
def test_cloth_has_as_many_springs_as_its_grid_says(rows: int, columns: int, side: float) -> None:
    """r(c-1) + (r-1)c along the threads, 2(r-1)(c-1) across the cells, r(c-2) + (r-2)c over one mass."""
    r, c = rows, columns
    threads, diagonals, over_one = r * (c - 1) + (r - 1) * c, 2 * (r - 1) * (c - 1), r * (c - 2) + (r - 2) * c
    cloth = find_scene("cloth")
    size = {"rows": rows, "columns": columns, "rest_length": side}
    check_built(cloth.system(size), threads + diagonals + over_one)
    check_built(cloth.system({**size, "bend": 0}), threads + diagonals)
    check_built(cloth.system({**size, "bend": 0, "shear": 0}), threads)
    stiffness = cloth.system({**size, "stiffness": 3.0, "shear": 2.0, "bend": 1.0}).stiffness.tolist()
    assert stiffness == [3.0] * threads + [2.0] * diagonals + [1.0] * over_one


@pytest.mark.parametrize(
    ("pinned", "held"), [("corners", [0, 3]), ("four_corners", [0, 3, 8, 11]), ("edge", [0, 1, 2, 3])]
)
def test_cloth_is_held_where_it_is_pinned(pinned: str, held: list[int]) -> None:
    """Three rows of four masses; it lies level, gravity across it."""
    cloth = find_scene("cloth").system({"rows": 3, "columns": 4, "rest_length": 1.0, "pinned": pinned})
    assert np.flatnonzero(cloth.fixed).tolist() == held
    assert cloth.positions[5].tolist() == [1.0, 0.0, 1.0]
    assert cloth.positions[11].tolist() == [3.0, 0.0, 2.0]
    assert cloth.gravity.tolist() == [0.0, -9.81, 0.0]


@property_test
@given(across=st.integers(2, 5), high=st.integers(2, 5), deep=st.integers(2, 5))
def test_jello_has_as_many_springs_as_its_block_says(across: int, high: int, deep: int) -> None:
    """Over an offset (i, j, k) there are (a-|i|)(h-|j|)(d-|k|) springs: 13 offsets as a lattice, 7 as tetrahedra."""
    size = {"across": across, "high": high, "deep": deep}

    def count(offsets: Any) -> int:
        sides = np.array([across, high, deep])
        return int(sum(np.prod(sides - np.abs(offset)) for offset in offsets))

    assert (len(NEIGHBOURS), len(TETRAHEDRA)) == (13, 7)
    check_built(find_scene("jello").system(size), count(NEIGHBOURS))
    check_built(find_scene("jello").system({**size, "cells": "tetrahedra"}), count(TETRAHEDRA))


def test_tetrahedra_of_four_by_four_by_four_have_279_edges() -> None:
    """As were measured in the engines; each cell falls into six tetrahedra, whose corners are all joined."""
    jello = find_scene("jello").system({"across": 4, "high": 4, "deep": 4, "cells": "tetrahedra"})
    assert len(jello.springs) == 279
    cell = lattice(x=2, y=2, z=2)
    joined = {frozenset(pair) for pair in springs_between(cell, TETRAHEDRA).tolist()}
    corners = [[0, a, a + b, 7] for a in (1, 2, 4) for b in (1, 2, 4) if a != b]
    assert all(frozenset((p, q)) in joined for four in corners for p in four for q in four if p != q)
    assert joined == {frozenset((p, q)) for four in corners for p in four for q in four if p != q}


def test_jello_starts_sheared_on_from_its_fixed_face() -> None:
    """The fixed face stands still, the other moves at `speed`, the middle at half of it."""
    for held, speeds in (("bottom", [0.0, 0.5, 1.0]), ("top", [1.0, 0.5, 0.0])):
        jello = find_scene("jello").system({"high": 3, "rest_length": 0.25, "speed": 1.0, "held": held})
        for height, speed in zip((0.0, 0.25, 0.5), speeds, strict=True):
            layer = jello.positions[:, 1] == height
            assert jello.velocities[layer] == pytest.approx(np.tile([speed, 0.0, 0.0], (16, 1)), abs=1e-15)
            assert jello.fixed[layer].all() == (speed == 0.0)


def check_drop(scheme: Scheme) -> None:
    """Jello that is dropped falls as one: y = -g t^2/2 by Heun, exact for it, to rounding, until it touches the floor.

    From 0.05 m that is after sqrt(2 * 0.05/9.81) s = 0.10096 s, so from step 101 on. Then no mass is ever below the
    floor, and of its energy there is never more than at first: the floor takes and gives none. Heun's own gain is below
    1e-4 of it.
    """
    system = find_scene("drop").system({})
    motion = simulate(system, scheme, 1e-3, 0.3)
    fall = motion.positions[:101] - system.positions
    t = motion.times[:101]
    assert fall[:, :, 1] == pytest.approx(np.tile(-9.81 / 2 * t[:, None] ** 2, (1, 64)), abs=1e-14)
    heights = motion.positions[:, :, 1].min(axis=1)
    assert heights[100] > -0.05
    assert heights.min() == pytest.approx(-0.05, abs=1e-15)
    energies = np.array([energy(system, state) for state in motion.states()])
    at_first = 0.64 * 9.81 * 0.05
    assert (energies - energies[0]).max() < 1e-4 * at_first


def test_dropped_jello_falls_freely_and_stays_above_the_floor() -> None:
    """And no mass of it is held."""
    check_drop(find("heun"))
    assert not find_scene("drop").system({}).fixed.any()


@pytest.mark.rotating(3, in_turn=True)
def test_the_drop_fails_on_wrong_integrators() -> None:
    """Euler falls too slowly; gravity that points up does not fall; what gains energy has more than at first."""
    for scheme in (find("euler"), wrong.stepped(wrong.gravity_turned, find("heun")), wrong.kick_drift_gaining_energy):
        with pytest.raises(AssertionError):
            check_drop(scheme)


@pytest.mark.parametrize("name", ["cloth", "jello"])
@pytest.mark.parametrize("scheme", ["kick_drift", "heun"])
def test_their_own_step_is_a_stable_one(name: str, scheme: str) -> None:
    """For as long as they are shown, no spring is ever twice its length."""
    scene = find_scene(name)
    system = scene.system({})
    outcome = outcome_of(system, simulate(system, find(scheme), scene.dt, scene.duration))
    assert outcome.ending == "done"
    assert outcome.trajectory is not None
    a, b = system.springs.T
    x = outcome.trajectory.positions
    assert (np.linalg.norm(x[:, b] - x[:, a], axis=2) < 2 * system.rest_lengths).all()


# --- Jello hung by one face, against direct stiffness ---


def hung(gravity: float = 9.81, cells: str = "lattice") -> MassSpringSystem:
    """A block hung by its top face, at rest."""
    size = {"across": 4, "high": 5, "deep": 4}
    return find_scene("jello").system({**size, "held": "top", "speed": 0.0, "gravity": gravity, "cells": cells})


def check_stretch(system: MassSpringSystem, by_the_textbook: MassSpringSystem) -> None:
    """Where it hangs is K u = M g, in the limit of small displacements, to 1e-6.

    With a millionth of a weight that stretches it by 3 %, strains are 3e-8 and with them what K leaves out; positions
    of 0.1 m round by 1e-17 m, which is 3e-9 of the displacement.
    """
    moved = equilibrium(system).positions - system.positions
    expected = deflection(by_the_textbook)
    assert np.abs(moved - expected).max() < 1e-6 * np.abs(expected).max()


@pytest.mark.parametrize("cells", ["lattice", "tetrahedra"])
def test_jello_stretches_under_its_weight_as_direct_stiffness_says(cells: str) -> None:
    """Both kinds of cells."""
    system = hung(9.81e-6, cells)
    check_stretch(system, system)


def one_spring_changed(system: MassSpringSystem, factor: float = 1 + 1e-3) -> MassSpringSystem:
    """One spring in the middle is a thousandth stiffer."""
    stiffness = system.stiffness.copy()
    stiffness[len(stiffness) // 2] *= factor
    return replace(system, stiffness=stiffness)


def test_stretch_fails_on_other_springs_other_cells_and_a_whole_weight() -> None:
    """One spring stiffer by a thousandth is seen; so is that real weights stretch it by more than the limit says."""
    light = hung(9.81e-6)
    for system, other in ((one_spring_changed(light), light), (hung(), hung())):
        with pytest.raises(AssertionError):
            check_stretch(system, other)
    upright = find_scene("jello").system({"across": 4, "high": 5, "deep": 4, "speed": 0.0, "gravity": 9.81e-6})
    with pytest.raises(AssertionError):
        check_stretch(upright, light)


Simulated = Callable[[MassSpringSystem, float, float], Any]


def under(scheme: Scheme) -> Simulated:
    """Runs by a scheme."""
    return lambda system, dt, duration: simulate(system, scheme, dt, duration)


def check_wobble(run: Simulated, by_the_textbook: MassSpringSystem, mode: int) -> None:
    """Pushed along a mode, it swings with 2 pi / w, from K q = w^2 M q, to 1e-6.

    RK4's phase error is (w dt)^4/120, below 1e-9 with w dt < 0.02. Springs of 30 mm pushed by 1e-7 m turn by 3e-6,
    which changes w by its square.
    """
    system = hung(0.0)
    squares, shapes = modes(by_the_textbook, mode + 1)
    shape = shapes[mode] / np.abs(shapes[mode]).max()
    period = 2 * np.pi / np.sqrt(squares[mode])
    pushed = replace(system, positions=system.positions + 1e-7 * shape)
    trajectory = run(pushed, period / 400, 2.6 * period)
    assert measured_period(trajectory, system.positions, shape, system.masses) == pytest.approx(period, rel=1e-6)


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize("mode", range(4))
def test_jello_wobbles_as_slowly_as_its_eigenvalues_say(mode: int) -> None:
    """The four slowest: two sideways, one twisting, one up and down."""
    check_wobble(under(find("rk4")), hung(0.0), mode)


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize(
    "scheme",
    [wrong.heun_without_half, wrong.kick_drift_kicked_twice, wrong.stepped(wrong.one_sided, find("rk4"))],
    ids=label,
)
def test_wobble_fails_on_wrong_integrators(scheme: Scheme) -> None:
    """Twice as fast, too stiff, or springs that only pull."""
    with pytest.raises(AssertionError):
        check_wobble(under(scheme), hung(0.0), 0)


def test_wobble_fails_on_another_block() -> None:
    """All springs stiffer by a hundred-thousandth: w by half of that."""
    system = hung(0.0)
    with pytest.raises(AssertionError):
        check_wobble(under(find("rk4")), replace(system, stiffness=system.stiffness * (1 + 1e-5)), 0)


def check_frequencies(system: MassSpringSystem, by_the_textbook: MassSpringSystem) -> None:
    """The six slowest w^2, about the start, where every spring has its rest length: to 1e-10, eps cond being 1e-12."""
    squares, _ = modes(by_the_textbook, 6)
    assert squared_frequencies(system, system.start, lowest=6) == pytest.approx(np.sort(squares), rel=1e-10)


def test_frequencies_of_the_reference_are_those_of_direct_stiffness() -> None:
    """Without weight; and not if all springs are stiffer by 1e-9."""
    system = hung(0.0)
    check_frequencies(system, system)
    with pytest.raises(AssertionError):
        check_frequencies(system, replace(system, stiffness=system.stiffness * (1 + 1e-9)))


# --- Cloth that comes to rest ---


def slowing_cloth(**settings: Any) -> MassSpringSystem:
    """A cloth in thick air: with Cd/m = 9 /s its slowest swings, 4.4 /s, are nearly critically damped."""
    return find_scene("cloth").system(
        {"rows": 8, "columns": 9, "rest_length": 0.07, "mass": 0.004, "drag": 0.036, **settings}
    )


def check_rest(run: Simulated, system: MassSpringSystem, rests_as: MassSpringSystem) -> None:
    """After 6 s it is where energy is least, to 1e-6 of its size: exp(-4.5 * 6) = 2e-12 of the motion is left."""
    last = run(system, 1e-3, 6.0).positions[-1]
    assert np.abs(last - equilibrium(rests_as).positions).max() < 1e-6 * system.size


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize("pinned", ["corners", "four_corners"])
def test_cloth_comes_to_rest_where_energy_is_least(pinned: str) -> None:
    """Two ways there: it falls, swings and slows down; and downhill in energy."""
    system = slowing_cloth(pinned=pinned)
    check_rest(under(find("velocity_verlet")), system, system)


@pytest.mark.rotating(5, in_turn=True)
def test_rest_fails_on_other_cloth_and_on_wrong_integrators() -> None:
    """A spring ten per cent stiffer; a last mass that never falls; gravity turned to the side."""
    system = slowing_cloth()
    with pytest.raises(AssertionError):
        check_rest(under(find("velocity_verlet")), system, one_spring_changed(system, 1.1))
    for scheme in (wrong.last_mass_forgotten, wrong.stepped(wrong.gravity_turned, find("velocity_verlet"))):
        with pytest.raises(AssertionError):
            check_rest(under(scheme), system, system)


def mirrored(system: MassSpringSystem, positions: Any, rows: int, columns: int) -> Any:
    """The cloth seen from its other side, mass by mass."""
    grid = positions.reshape(rows, columns, 3)[:, ::-1].copy()
    grid[:, :, 0] = system.positions[:, 0].max() - grid[:, :, 0]
    return grid.reshape(-1, 3)


def check_symmetric(system: MassSpringSystem) -> None:
    """Left and right are alike at rest, to 1e-12 of the size: the solver's, 1e-14, times a condition of 1e2."""
    positions = equilibrium(system).positions
    assert np.abs(positions - mirrored(system, positions, 8, 9)).max() < 1e-12 * system.size


def test_cloth_hangs_symmetrically() -> None:
    """By two corners, by four, by an edge."""
    for pinned in ("corners", "four_corners", "edge"):
        check_symmetric(slowing_cloth(pinned=pinned))


def test_symmetry_fails_on_a_cloth_with_one_stiffer_spring() -> None:
    """By a thousandth."""
    with pytest.raises(AssertionError):
        check_symmetric(one_spring_changed(slowing_cloth()))
