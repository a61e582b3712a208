"""Butcher tableaux read off schemes, and the conditions on them."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from reference.derivation.implicit import ONE_STAGE, _groups, implicit_tableau
from reference.derivation.of_schemes import tableau_of_scheme, updates_of_scheme
from reference.derivation.order_conditions import gamma, order_of, size, trees
from reference.derivation.updates import in_words
from reference.schemes.catalogue import Scheme, find, schemes
from tests import wrong
from tests.reference.systems import label

HALF = Fraction(1, 2)

#: a and b of textbooks, as text.
TEXTBOOK = {
    "euler": ([["0"]], ["1"]),
    "heun": ([["0", "0"], ["1", "0"]], ["1/2", "1/2"]),
    "rk4": (
        [["0", "0", "0", "0"], ["1/2", "0", "0", "0"], ["0", "1/2", "0", "0"], ["0", "0", "1", "0"]],
        ["1/6", "1/3", "1/3", "1/6"],
    ),
    "backward_euler": ([["1"]], ["1"]),
    "implicit_midpoint": ([["1/2"]], ["1"]),
}


@pytest.mark.parametrize("name", TEXTBOOK)
def test_tableaux_are_the_textbooks(name: str) -> None:
    """To the fraction; of implicit schemes from the points their solver ends at."""
    tableau = tableau_of_scheme(find(name)) or implicit_tableau(find(name))
    assert tableau is not None
    assert (tableau.text()["a"], tableau.text()["b"]) == TEXTBOOK[name]
    assert tableau.times_at_odds == ()


@pytest.mark.parametrize("scheme", schemes().values(), ids=label)
def test_the_conditions_give_the_order_that_the_catalogue_has(scheme: Scheme) -> None:
    """Where a scheme has a tableau at all; no experiment is needed."""
    tableau = tableau_of_scheme(scheme) or implicit_tableau(scheme)
    if tableau is not None:
        assert tableau.order == scheme.order
        assert tableau.explicit is not scheme.implicit


@pytest.mark.parametrize("scheme", [wrong.heun_without_half, wrong.heun_of_the_wrong_pair, wrong.rk4_equally_weighted])
def test_a_wrong_one_is_of_lower_order(scheme: Scheme) -> None:
    """And the condition that fails is told."""
    tableau = tableau_of_scheme(scheme)
    assert tableau is not None
    assert tableau.order < scheme.order
    assert str(tableau.order + 1) in tableau.fails


def test_there_are_as_many_trees_as_there_are() -> None:
    """Rooted trees of 1 to 7 nodes: 1, 1, 2, 4, 9, 20, 48 (Cayley). Their densities divide into the factorials' sum."""
    assert [len(trees(n)) for n in range(1, 8)] == [1, 1, 2, 4, 9, 20, 48]
    assert all(size(tree) == n for n in range(1, 8) for tree in trees(n))
    assert [max(map(gamma, trees(n))) for n in range(1, 5)] == [1, 2, 6, 24]


def test_the_condition_that_fails_is_told_in_numbers() -> None:
    """A midpoint rule whose slope is taken a third on."""
    order, fails = order_of([[0, 0], [Fraction(1, 3), 0]], [0, 1])
    assert order == 1
    assert fails == "of order 2, sum b_i c_i is 1/3, not 1/2"
    assert order_of([[0, 0], [HALF, 0]], [0, 1])[0] == 2


def test_a_condition_that_is_missed_by_little_is_told_by_how_much() -> None:
    """Euler's weight off by 1e-9, which seven figures do not show; and where numbers are known to 1e-7 it is 1."""
    assert order_of([[0]], [1 - 1e-9]) == (0, "of order 1, sum b_i is 1 - 1e-09, not 1")
    assert order_of([[0]], [1 - 1e-9], 1e-7)[0] == 1


def test_partitioned_schemes_are_told_as_formulas() -> None:
    """Kick-drift moves with the new velocity: h^2 a."""
    assert in_words(updates_of_scheme(find("kick_drift"))) == [
        "a1 = acceleration(x, v)",
        "x' = x + h v + h^2 a1",
        "v' = v + h a1",
    ]


def test_points_are_one_stage_where_they_are_near_beside_the_largest() -> None:
    """Iterates of a solver: near is ONE_STAGE of the largest number there is, also where a point is zero."""
    here, there = np.zeros(2), np.array([1.0, 2.0])
    assert _groups([here, there, there + ONE_STAGE, there + 5 * ONE_STAGE]) == [[0], [1, 2], [3]]
    assert _groups([]) == []
