"""The orders that solvers go through springs in: on a string, worked out by hand; on any mesh, each spring once."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.constraint_solvers.spring_order import ORDERS, in_order
from reference.scenes import find as find_scene
from reference.system import MassSpringSystem

#: Of a string of five springs: the anchor's is number 0.
BY_HAND = {
    "made": [0, 1, 2, 3, 4],
    "reversed": [4, 3, 2, 1, 0],
    "colours": [0, 2, 4, 1, 3],
    "apart": [0, 2, 4, 1, 3],
    "fixed_last": [1, 3, 2, 4, 0],
    "newest_first": [4, 2, 3, 1, 0],
    "from_fixed": [0, 1, 2, 3, 4],
    "island": [4, 3, 2, 1, 0],
}


@pytest.mark.parametrize("order", ORDERS)
def test_a_string_by_hand(order: str) -> None:
    """Springs of one colour share no moving mass."""
    assert in_order(find_scene("string").system({"masses": 5}), order).tolist() == BY_HAND[order]


def test_the_springs_nearest_to_a_fixed_mass_come_first_however_they_are_numbered() -> None:
    """Of a string that is also held at its end, numbered from its middle; of two as near the smaller mass's."""
    string = find_scene("string").system({"masses": 4})
    held = replace(string, springs=string.springs[[1, 2, 0, 3]], fixed=np.array([True, False, False, False, True]))
    assert in_order(held, "from_fixed").tolist() == [2, 3, 0, 1]


@pytest.mark.parametrize(
    ("order", "expected"),
    [
        ("colours", [*range(0, 60, 2), *range(1, 60, 2)]),
        ("fixed_last", [*range(1, 60, 2), *range(2, 60, 2), 0]),
        ("newest_first", [*range(59, 0, -2), *range(58, 0, -2), 0]),
    ],
)
def test_springs_of_one_colour_keep_their_order_on_a_long_string_too(order: str, expected: list[int]) -> None:
    """Sixty springs of two colours: as made, or the newest first."""
    assert in_order(find_scene("string").system({"masses": 60}), order).tolist() == expected


def test_a_walk_round_a_ring_by_hand() -> None:
    """From mass 4 by springs 1 and 0; on from 1, put aside last, to 0 and back to 2, which is put aside already.

    So from 0 it goes on to 3 before 2 has its turn.
    """
    ring = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [1.0, 1.0]]),
        springs=np.array([[4, 1], [4, 2], [2, 0], [2, 1], [1, 0], [0, 3]]),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
    )
    assert in_order(ring, "island").tolist() == [1, 0, 4, 3, 5, 2]
    held = replace(ring, fixed=np.arange(5) == 0)
    assert in_order(held, "island").tolist() == [1, 0, 4, 3, 2, 5]


def test_a_long_spring_from_a_fixed_mass_comes_before_short_ones_that_are_farther() -> None:
    """It is the nearer end that counts: 0 m of the springs of mass 0, and 1 m of the one between the others."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [10.0, 0.0], [0.0, 1.0], [0.0, 2.0]]),
        springs=np.array([[2, 3], [0, 1], [0, 2]]),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
        fixed=np.arange(4) == 0,
    )
    assert in_order(system, "from_fixed").tolist() == [1, 2, 0]


def branched() -> MassSpringSystem:
    """A fixed mass 0, masses 2, 1 and 3 at 1, 2 and 3 m from it along a line, 4 and 5 off to the side of 2."""
    return MassSpringSystem(
        positions=np.array([[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [3.0, 0.0], [1.0, 1.5], [1.0, 4.0]]),
        springs=np.array([[4, 5], [1, 3], [2, 1], [0, 2], [0, 1], [2, 4]]),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
        fixed=np.arange(6) == 0,
    )


#: Distances of the nearer ends: 2.5, 2, 1 (of mass 1 and 2), 0, 0 and 1 m (of 2 and 4). Walked from mass 5 on.
OF_BRANCHES = {
    "from_fixed": [3, 4, 2, 5, 1, 0],
    "colours": [0, 1, 3, 2, 4, 5],
    "apart": [0, 1, 3, 2, 4, 5],
    "island": [0, 5, 3, 2, 4, 1],
}


@pytest.mark.parametrize("order", OF_BRANCHES)
def test_branches_by_hand(order: str) -> None:
    """Where springs meet the newest is walked first, and the one that was put aside last."""
    assert in_order(branched(), order).tolist() == OF_BRANCHES[order]


def test_springs_of_one_fixed_mass_may_have_one_colour_if_it_is_not_apart() -> None:
    """Two springs from the fixed mass to two others, then one between these."""
    springs = np.array([[0, 1], [0, 2], [1, 2]])
    three = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
        springs=springs,
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
        fixed=np.arange(3) == 0,
    )
    reverse = replace(three, springs=springs[[0, 2, 1]])
    assert in_order(three, "colours").tolist() == [0, 1, 2]
    assert in_order(reverse, "colours").tolist() == [0, 2, 1]
    assert in_order(reverse, "apart").tolist() == [0, 1, 2]


def test_of_springs_between_a_mass_and_several_fixed_ones_the_first_is_the_very_last() -> None:
    """Of a string held at both ends, numbered from the one to the other, and at its middle."""
    string = find_scene("string").system({"masses": 4})
    held = replace(string, fixed=np.array([True, False, True, False, False]))
    assert in_order(held, "fixed_last").tolist() == [3, 1, 0, 2]


def test_the_newest_springs_begin_the_colours_and_those_to_fixed_masses_end_the_row() -> None:
    """Of a string held at both ends and in between: only spring 3 has two masses that move."""
    string = find_scene("string").system({"masses": 5})
    held = replace(string, fixed=np.array([True, False, True, False, False, True]))
    assert in_order(held, "newest_first").tolist() == [3, 4, 2, 1, 0]


@pytest.mark.parametrize("order", ORDERS)
def test_every_spring_that_moves_anything_is_there_once(order: str) -> None:
    """Of a cloth with an edge of fixed masses, whose springs move nothing."""
    cloth = find_scene("cloth").system({"rows": 4, "columns": 5, "pinned": "edge"})
    moves = ~cloth.fixed[cloth.springs].all(axis=1)
    assert sorted(in_order(cloth, order).tolist()) == np.flatnonzero(moves).tolist()


def test_springs_of_a_colour_share_no_moving_mass() -> None:
    """The first springs of a cloth's colours, up to the first that shares one, are many."""
    cloth = find_scene("cloth").system({"rows": 4, "columns": 5, "pinned": "edge"})
    seen: set[int] = set()
    count = 0
    for j in in_order(cloth, "colours").tolist():
        ends = {i for i in cloth.springs[j].tolist() if not cloth.fixed[i]}
        if ends & seen:
            break
        seen |= ends
        count += 1
    assert count >= 5
