"""Equilibria of large systems: sparse steps downhill end where the small systems' dense ones do, and in balance."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.sparse import csc_matrix

from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.scenes import find
from reference.state import State
from reference.system import MassSpringSystem
from reference.theory.equilibrium import equilibrium, hanging_string
from reference.theory.least_energy import _solve, least_energy
from reference.theory.modes import squared_frequencies
from reference.theory.parts import parts_of
from tests import wrong
from tests.reference.systems import random_mesh

LARGE: dict[str, tuple[str, dict[str, Any]]] = {
    "cloth by two corners": ("cloth", {"rows": 25, "columns": 20}),
    "cloth by four corners": ("cloth", {"rows": 15, "columns": 15, "pinned": "four_corners"}),
    "cloth by an edge": ("cloth", {"pinned": "edge", "bend": 0.0, "shear": 0.0}),
    "jello": ("jello", {"across": 8, "high": 8, "deep": 8}),
    "bridge": ("bridge", {"panels": 100, "height": 30.0}),
    "soil": ("soil", {}),
}


def check_balanced(system: MassSpringSystem, rest: State, law: wrong.Law = SpringMotion.acceleration) -> None:
    """All forces on free masses balance, to 1e-9 of the whole weight: rounding of k eps x is 1e-12 of it and less."""
    weight = float(system.masses.sum() * np.linalg.norm(system.gravity))
    assert np.abs(law(SpringMotion(system), rest) * system.masses[:, None]).max() < 1e-9 * weight
    assert not rest.velocities.any()
    assert (rest.positions[system.fixed] == system.positions[system.fixed]).all()


@pytest.mark.rotating(2)
@pytest.mark.parametrize(("scene", "settings"), LARGE.values(), ids=LARGE)
def test_large_systems_come_to_balance_where_they_are_stable(scene: str, settings: dict[str, Any]) -> None:
    """Forces balance, and every small push comes back: all w^2 > 0, so it is no ridge of the energy."""
    system = find(scene).system(settings)
    rest = equilibrium(system)
    check_balanced(system, rest)
    assert squared_frequencies(system, rest, lowest=4).min() > 0


@pytest.mark.parametrize("light", [1e-2, 1e-4, 1e-6])
def test_a_light_mass_beside_a_heavy_one_does_not_stay_above_its_anchor(light: float) -> None:
    """It starts right above it, where forces balance, and comes to hang at -(L0 + m g/k): beside 100 kg, too.

    What drives it down is a part of its own weight, a millionth of the whole and less.
    """
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.0, -1.0], [0.0, 0.3]]),
        springs=np.array([[0, 1], [0, 2]]),
        masses=np.array([1.0, 100.0, light]),
        rest_lengths=np.array([1.0, 0.3]),
        stiffness=np.array([2000.0, 10.0]),
        fixed=np.array([True, False, False]),
    )
    rest = equilibrium(system)
    hung = -np.array([1.0 + 100 * 9.81 / 2000, 0.3 + light * 9.81 / 10])
    assert rest.positions[1:, 1] == pytest.approx(hung, rel=1e-9)
    assert rest.positions[1:, 0] == pytest.approx([0.0, 0.0], abs=1e-6)


@pytest.mark.parametrize("law", [wrong.gravity_turned, wrong.one_sided], ids=lambda law: law.__name__)
def test_balance_fails_on_wrong_forces(law: wrong.Law) -> None:
    """Under other forces it would rest elsewhere."""
    system = find("cloth").system({})
    with pytest.raises(AssertionError):
        check_balanced(system, equilibrium(system), law)


def test_balance_fails_at_the_start_and_next_to_the_end() -> None:
    """Neither the flat cloth nor one a micrometre off is in balance."""
    system = find("cloth").system({})
    rest = equilibrium(system)
    beside = replace(rest, positions=rest.positions + 1e-6 * np.eye(len(rest.positions), 3, -5))
    for state in (system.start, beside):
        with pytest.raises(AssertionError):
            check_balanced(system, state)


@pytest.mark.parametrize("seed", range(4))
def test_small_meshes_rest_where_the_dense_way_finds_them(seed: int) -> None:
    """Two ways downhill, L-BFGS with dense Newton and sparse steps, to 1e-11 of the size.

    Springs here start far from rest, and a mesh may have several minima: only where the two agree on the energy, as
    most do, must they agree on the place; each is in balance in any case.
    """
    system = random_mesh(seed, 8, 2 + seed % 2, anchors=2)
    check_balanced(system, least_energy(system))


def test_a_long_string_hangs_straight() -> None:
    """From a slant, 400 masses: the closed form to 1e-11 of the size; Newton's matrix has a condition of 1e6."""
    system = find("string").system({"masses": 400, "angle": 60.0})
    straight = hanging_string(system)
    assert np.abs(least_energy(system).positions - straight.positions).max() < 1e-11 * system.size


@pytest.mark.parametrize("times", [1e-12, 1e-6, 1.0, 1e6, 1e12])
def test_what_stands_on_its_head_falls_however_soft_or_stiff(times: float) -> None:
    """Masses and stiffness times as large are the same motion: off the ridge, and down to where the string hangs.

    To 1e-11 of the size, as above. On the ridge forces balance as well: that is not where it may stay.
    """
    hanging = find("string").system({"masses": 4, "angle": 0.0})
    hanging = replace(hanging, masses=times * hanging.masses, stiffness=times * hanging.stiffness)
    straight = hanging_string(hanging)
    over = replace(hanging_string(replace(hanging, gravity=-hanging.gravity)), velocities=np.zeros((5, 2)))
    standing = replace(hanging, positions=over.positions)
    assert np.abs(least_energy(standing).positions - straight.positions).max() < 1e-11 * hanging.size


def test_what_is_torn_off_is_at_rest_as_it_falls() -> None:
    """The half that nothing holds falls flat, none of its springs stretched; the other hangs in balance."""
    cloth = find("cloth").system({"rows": 6, "columns": 20})
    rows_apart = [j for j, (a, b) in enumerate(cloth.springs.tolist()) if (a < 60) == (b < 60)]
    torn = replace(
        cloth,
        **{name: getattr(cloth, name)[rows_apart] for name in ("springs", "rest_lengths", "stiffness", "damping")},
    )
    rest = equilibrium(torn)
    parts = parts_of(torn)
    assert parts.held.tolist().count(False) == 1
    forces = SpringMotion(torn).acceleration(rest) - np.where(
        np.isin(np.arange(120), parts.loose)[:, None], torn.gravity, 0
    )
    assert np.abs(forces * torn.masses[:, None]).max() < 1e-9 * float(torn.masses.sum()) * 9.81


@pytest.mark.parametrize("scene", ["cloth", "jello", "soil"])
def test_the_lowest_frequencies_are_the_lowest_of_all(scene: str) -> None:
    """Sparse and dense eigenvalues agree to 1e-9, pairs that are equal by symmetry included.

    Lanczos with shift-invert converges to rounding of K^-1, eps cond = 1e-16 * 1e4 at most.
    """
    system = find(scene).system({})
    rest = equilibrium(system)
    assert squared_frequencies(system, rest, lowest=6) == pytest.approx(squared_frequencies(system, rest)[:6], rel=1e-9)


def test_a_stiffness_that_cannot_be_inverted_is_no_equilibrium() -> None:
    """As of springs so soft, or so stiff, that floats hold nothing beside them."""
    with pytest.raises(SolverError, match="no equilibrium: the stiffness of the springs cannot be inverted"):
        _solve(csc_matrix((2, 2)), 0.0, np.ones(2))


def test_what_is_all_held_rests_where_it_is() -> None:
    """Until something is released nothing moves."""
    string = replace(find("string").system({"masses": 2}), fixed=np.array([True, True, True]))
    np.testing.assert_array_equal(least_energy(string).positions, string.positions)
    assert len(squared_frequencies(string, least_energy(string))) == 0
