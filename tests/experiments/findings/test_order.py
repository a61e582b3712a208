"""Orders: by theory and measured, who is off and by how much, and how near engines are to their schemes."""

from __future__ import annotations

from dataclasses import replace

import pytest

from experiments.order import DTS, NEAR, STRAIGHT, result_of, straight
from tests.experiments.canned import order
from tests.experiments.canned.order import OFF
from tests.experiments.canned.reading import finding, in_order, numbers, records


def test_the_table_has_theory_and_measurement_in_their_columns() -> None:
    """With every other error, by its dt."""
    table = {row["stepper"]: row for row in records(order.usual())}
    name, theory, measured = OFF
    assert (table[name]["predicted"], table[name]["measured"]) == (theory, pytest.approx(measured))
    assert (table["stranger"]["predicted"], table["stranger"]["measured"]) == (None, None)
    assert [table["heun"][f"{dt} [m]"] for dt in ("4 ms", "1 ms", "1/4 ms", "1/16 ms")] == pytest.approx(
        [1e-5, 1e-5 / 4**2, 1e-5 / 16**2, 1e-5 / 64**2]
    )
    assert table["Segfaults"]["outcome"] == "crashed"


def test_the_table_of_errors_says_which_are_fitted() -> None:
    """Each at its dt."""
    rows = [row for row in records(order.usual(), "order_errors") if row["stepper"] == "rk4"]
    assert [row["dt [s]"] for row in rows] == DTS.tolist()
    assert [row["error [m]"] for row in rows] == pytest.approx([1e-7 / 2 ** (4 * i) for i in range(len(DTS))])
    assert {row["in the fit"] for row in rows} == {"yes"}
    strangers = [row for row in records(order.usual(), "order_errors") if row["stepper"] == "stranger"]
    assert {row["in the fit"] for row in strangers} == {"no"}
    fitted = replace(order.row("rk4"), fitted=slice(2, 5))
    assert [row["in the fit"] for row in records(result_of([fitted]), "order_errors")].count("yes") == 3


def test_the_first_sentence_counts_who_is_near_and_names_who_is_farthest_off() -> None:
    """Seven of eight; the one with a slope of 1.5 where 2 is predicted."""
    first = finding(order.usual(), "that theory gives them")
    assert numbers(first) == pytest.approx([7, 8, NEAR, OFF[2], OFF[1]])
    assert in_order(first, "furthest off is ", OFF[0], "1.500", "2 is")
    odd = finding(order.usual(), "Not as predicted")
    assert (odd.count(OFF[0]), numbers(odd)) == (1, pytest.approx([OFF[2], OFF[1]]))


def test_engines_are_listed_by_their_order_with_their_distance_from_their_schemes() -> None:
    """The largest of all."""
    assert finding(order.usual(), "Engines of order 1").endswith(": pymunk_springs.")
    assert finding(order.usual(), "Engines of order 4").endswith(": mujoco_cable_rk4.")
    near = replace(order.row("heun", engine="a"), errors=order.row("heun").errors + 3e-13)
    far = replace(order.row("rk4", engine="b"), errors=order.row("rk4").errors + 5e-13)
    said = finding(result_of([order.row("heun"), order.row("rk4"), near, far]), "On the same string")
    assert numbers(said) == pytest.approx([5e-13])


def test_in_place_slopes_are_those_that_were_measured() -> None:
    """Whatever they were meant to have."""
    assert "euler_in_place 1.00" in finding(order.usual(), "Written in place")


def test_of_straight_stretches_as_long_the_one_with_the_smallest_dt_is_taken() -> None:
    """Slopes 1, 1, 3, 2, 2 (each within STRAIGHT of the next in its half): both halves have three errors.

    The error of a power law is that of its first term alone only once dt is small.
    """
    slopes = [1.0, 1.0, 3.0, 2.0, 2.0, 4.0]
    errors = [1.0]
    for slope in slopes:
        errors.append(errors[-1] / 2**slope)
    assert STRAIGHT < 1
    found = straight(DTS * 0 + errors, 0.0)
    assert found == slice(3, 6)


def test_failures_are_who_did_not_come_to_an_end() -> None:
    """Not who could not be identified."""
    assert order.usual().failures == ["Segfaults: crashed, SIGSEGV"]


def test_without_a_stepper_there_is_a_sentence() -> None:
    """And no row."""
    assert len(order.nobody().findings) == 1
    assert records(order.nobody()) == []
