"""Masses that collide: against the law of impact, momentum, energy, and a slinky whose coils close."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from reference.collisions.impacts import collide
from reference.collisions.round_masses import TREE_FROM, Collisions
from reference.compiled.kernels import advance
from reference.conserved import energy, momentum
from reference.errors import InputError, SolverError, Unsupported
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.state import Array
from reference.stepper import stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.exact import exact
from tests.reference.systems import seeds


def two(restitution: float = 0.0, **fields: Any) -> MassSpringSystem:
    """Two of 1 and 3 kg, 1 m apart, radii 0.1 and 0.2 m, that meet head on at 2 and 1 m/s; no springs, no gravity."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0]]),
        springs=np.zeros((0, 2), dtype=int),
        masses=np.array([1.0, 3.0]),
        rest_lengths=np.zeros(0),
        stiffness=np.zeros(0),
        gravity=np.zeros(2),
        velocities=np.array([[2.0, 0.0], [-1.0, 0.0]]),
        collisions=Collisions(np.array([0.1, 0.2]), restitution),
    )
    return replace(system, **fields)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_two_that_meet_part_by_the_law_of_impact(restitution: float) -> None:
    """v1' = (m1 v1 + m2 v2 - m2 e (v1 - v2)) / (m1 + m2), at the step in which they came to touch, 0.7 m / 3 m/s."""
    run = simulate(two(restitution), find("kick_drift"), 1e-3, 0.5)
    common, apart = (2.0 - 3.0) / 4, 3.0 * restitution
    assert run.velocities[-1, :, 0] == pytest.approx([common - 0.75 * apart, common + 0.25 * apart], abs=1e-14)
    met = int(np.argmax(run.velocities[:, 0, 0] != 2.0))
    assert met == int(np.ceil(0.7 / 3.0 / 1e-3))
    gap = run.positions[:, 1, 0] - run.positions[:, 0, 0]
    assert gap[met] == pytest.approx(0.3, abs=1e-14)
    assert (gap >= 0.3 - 1e-14).all()
    centre = run.positions[..., 0] @ [0.25, 0.75]
    assert centre == pytest.approx(0.75 + common * run.times, abs=1e-13)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_two_in_one_place_part_along_the_last_axis(dimension: int) -> None:
    """By the law of impact: with 1 and 3 kg, u1 = 2 and u2 = -1 m/s, e = 1/2 the speeds are -1.375 and 0.125 m/s.

    v1 = u1 - (1 + e) m2 (u1 - u2)/(m1 + m2); other axes keep theirs, and the lighter one moves three times as far.
    """
    x, v = np.zeros((2, dimension)), np.full((2, dimension), 7.0)
    v[:, -1] = [2.0, -1.0]
    found_x, found_v = collide(Collisions(np.array([0.1, 0.3]), 0.5), np.array([1.0, 1 / 3]), x, v)
    assert found_v[:, -1] == pytest.approx([-1.375, 0.125], rel=1e-14)
    assert found_x[:, -1] == pytest.approx([-0.3, 0.1], rel=1e-14)
    assert (found_v[:, :-1] == 7.0).all()
    assert not found_x[:, :-1].any()


def test_a_fixed_mass_stays_and_throws_back_whoever_meets_it() -> None:
    """As if it were without end in mass."""
    system = two(1.0, fixed=np.array([False, True]), velocities=np.array([[2.0, 0.0], [0.0, 0.0]]))
    run = simulate(system, find("kick_drift"), 1e-3, 0.5)
    assert run.velocities[-1].tolist() == [[-2.0, 0.0], [0.0, 0.0]]
    assert (run.positions[:, 1] == [1.0, 0.0]).all()


def gas(seed: int, count: int, restitution: float) -> MassSpringSystem:
    """Round masses thrown about in space, from a lattice."""
    rng = np.random.default_rng(seed)
    side = int(np.ceil(count ** (1 / 3)))
    places = np.stack(np.unravel_index(np.arange(count), (side, side, side)), axis=1).astype(float)
    return MassSpringSystem(
        positions=places,
        springs=np.zeros((0, 2), dtype=int),
        masses=rng.uniform(1, 3, count),
        rest_lengths=np.zeros(0),
        stiffness=np.zeros(0),
        gravity=np.zeros(3),
        velocities=rng.normal(size=(count, 3)),
        collisions=Collisions(rng.uniform(0.1, 0.45, count), restitution),
    )


@settings(deadline=None, max_examples=10)
@given(seed=seeds)
def test_momentum_is_kept_and_energy_where_it_is_elastic(seed: int) -> None:
    """To rounding, whoever meets whom; what is not elastic only loses."""
    for restitution in (1.0, 0.3):
        system = gas(seed, 20, restitution)
        run = simulate(system, find("kick_drift"), 0.02, 0.5)
        end = run.states()[-1]
        assert momentum(system, end) == pytest.approx(momentum(system, system.start), abs=1e-12)
        kept = energy(system, end) / energy(system, system.start)
        assert kept == pytest.approx(1.0, abs=1e-12) if restitution == 1.0 else kept < 1.0 + 1e-12


def test_a_law_that_pushes_one_of_the_two_only_would_be_seen() -> None:
    """Shown to fail: momentum is then another."""

    def half(x: Array, v: Array) -> Array:
        system = two(1.0)
        changed = collide(system.collisions, 1 / system.masses, x, v)[1]  # type: ignore[arg-type]
        return np.stack([v[0], changed[1]])

    x, v = np.array([[0.0, 0.0], [0.25, 0.0]]), two().velocities
    system = two(1.0)
    assert system.collisions is not None
    right = collide(system.collisions, 1 / system.masses, x, v)[1]
    assert system.masses @ right == pytest.approx(system.masses @ v)
    assert system.masses @ half(x, v) != pytest.approx(system.masses @ v)


def test_a_tree_finds_the_pairs_that_all_pairs_have() -> None:
    """In their order, of more masses than are looked at one by one."""
    rng = np.random.default_rng(0)
    x = rng.uniform(0, 6, (TREE_FROM + 50, 3))
    found = Collisions(rng.uniform(0, 0.3, len(x)))
    radii = found.radii[:, None] + found.radii
    near = np.linalg.norm(x[:, None] - x, axis=2) < radii
    assert found.pairs(x).tolist() == np.argwhere(np.triu(near, 1)).tolist()
    assert len(found.pairs(x)) > 20


@pytest.mark.parametrize("count", [3, TREE_FROM + 1])
def test_where_a_run_has_blown_up_nobody_meets_anybody(count: int) -> None:
    """As soon as one place is no number; of masses of which all neighbours meet before."""
    x = np.arange(float(count))[:, None] * [0.5, 0.0]
    round_ones = Collisions(np.full(count, 0.3))
    assert len(round_ones.pairs(x)) == count - 1
    x[0, 1] = np.nan
    assert round_ones.pairs(x).shape == (0, 2)


def test_the_coils_of_a_slinky_close_and_its_lower_end_waits() -> None:
    """Let go, all of it falls with g: its closed upper part meets the lower end when the centre has come down to it.

    sqrt(2 h / g), h how far the centre is from where it is when all is closed; for many masses sqrt(M / 3 K) (Calkin,
    Am. J. Phys. 61 (1993)). Until then the lower end moves by less than a hundredth of the whole. Without collisions a
    wave tells it, after sqrt(M / K) = 0.316 s: within 5 % of 20 masses' dispersion.
    """
    string = find_scene("slinky").system({"masses": 20, "radii": 1.2e-3})
    free = find_scene("slinky").system({"masses": 20})
    closed, through = (simulate(s, find("kick_drift"), 5e-4, t) for s, t in ((string, 0.22), (free, 0.36)))
    low, length = string.positions[-1, 0], -string.positions[-1, 0]
    height = string.positions[:, 0].mean() - low - 19 * 1.2e-3
    meets = np.sqrt(2 * height / 9.81)
    assert meets == pytest.approx(np.sqrt(1 / 30), rel=0.1)
    fell = [np.argmax(run.positions[:, -1, 0] < low - 0.01 * length) * 5e-4 for run in (closed, through)]
    assert fell[0] == pytest.approx(meets, abs=0.01)
    stay = np.argmax(through.positions[:, -1, 0] < low - 0.05 * length) * 5e-4
    assert stay == pytest.approx(np.sqrt(1 / 10), rel=0.05)
    gaps = -np.diff(closed.positions[:, :, 0], axis=1)
    assert gaps.min() > 0  # nobody has passed another
    centre = closed.positions[:, :, 0].mean(axis=1)
    assert centre == pytest.approx(centre[0] - 9.81 / 2 * closed.times * (closed.times + 5e-4), abs=1e-9)


def test_a_cloth_does_not_pass_through_itself() -> None:
    """A weak sheet whose halves are thrown together: with collisions its masses stay as far apart as they are wide.

    To a hundredth: what a pile leaves after all rounds. Shown to fail without.
    """
    cloth = find_scene("cloth").system({"rows": 6, "columns": 6, "stiffness": 2.0, "gravity": 0.0})
    x = cloth.positions
    spacing = float(np.linalg.norm(x[1] - x[0]))
    thrown = np.zeros_like(x)
    thrown[:, 0] = np.where(cloth.fixed, 0.0, -4.0 * (x[:, 0] - x[:, 0].mean()) / np.ptp(x[:, 0]))
    round_ones = replace(cloth, velocities=thrown, collisions=Collisions(np.array(0.45 * spacing)))
    nearest = []
    for system in (round_ones, replace(round_ones, collisions=None)):
        run = simulate(system, find("kick_drift"), 1e-3, 0.2)
        x = run.positions[::10]
        apart = np.linalg.norm(x[:, :, None] - x[:, None], axis=-1) + 9.0 * np.eye(len(cloth.masses))
        nearest.append(apart.min() / (0.9 * spacing))
    assert nearest[0] > 0.99
    assert nearest[1] < 0.9


def test_what_cannot_have_them_refuses() -> None:
    """Compiled loops, rods, the exact motion; theory where two would rest on one another."""
    string = find_scene("string").system({"radii": 0.03})
    with pytest.raises(Unsupported, match="collide"):
        advance(string, find("heun"), 1e-3, 1)
    with pytest.raises(SolverError, match="meets another"):
        exact(string, 1e-3, 1)
    for name in ("pendulum_heun", "rope_kick_drift"):
        assert stepper_named(name).run(string, 1e-3, 1).ending == "unsupported"
    assert np.allclose(spring_equilibrium(string).state.positions[:, 0], 0.0)
    standing = find_scene("oscillator").system({"radii": 0.06, "gravity": -20.0, "stiffness": 20.0})
    with pytest.raises(SolverError, match="masses 0 and 1"):
        spring_equilibrium(standing)


@pytest.mark.parametrize(
    ("given_", "said"),
    [
        ({"radii": -0.1}, "radii = -0.1: expected a number >= 0 [m]"),
        ({"radii": [0.1, 0.1, 0.1]}, "radii has shape (3,): expected (2,)"),
        ({"radii": 0.1, "restitution": 1.5}, "restitution = 1.5: expected a number from 0 to 1"),
        ({"radii": 0.6}, "radii: masses 0 and 1 start 1 m apart: expected 1.2 m or more"),
    ],
)
def test_a_wrong_number_is_named(given_: dict[str, Any], said: str) -> None:
    """With its field, value, and what was expected."""
    with pytest.raises(InputError) as refused:
        two(collisions=Collisions(np.array(given_["radii"]), given_.get("restitution", 0.0)))
    assert str(refused.value) == said


def test_the_first_two_that_start_in_one_another_are_named() -> None:
    """Of four in a row, 1 m apart, of which the second meets the third, and that the last."""
    row = np.arange(4.0)[:, None] * [1.0, 0.0]
    with pytest.raises(InputError, match=r"^radii: masses 1 and 2 start 1 m apart: expected 1.1 m or more$"):
        Collisions(np.array([0.2, 0.6, 0.5, 0.7])).checked(row)


def test_one_that_is_round_meets_nobody() -> None:
    """So nothing collides; and renumbered masses keep their radii."""
    for restitution in (0.0, 0.5):
        assert two(collisions=Collisions(np.array([0.1, 0.0]), restitution)).collisions is None
    with pytest.raises(InputError, match=r"^restitution = 0.5: expected radii above zero with it: nothing collides$"):
        two(collisions=Collisions(np.zeros(2), 0.5))
    turned = two().renumbered([1, 0]).collisions
    assert turned is not None
    assert turned.radii.tolist() == [0.2, 0.1]
    assert two(0.5).to_dict()["collisions"] == {"radii": [0.1, 0.2], "restitution": 0.5}
