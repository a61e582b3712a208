"""Permutations: whose order is predicted to show and whose does, by how much, and what a round leaves in Pymunk."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments.numbering import DAMPINGS, ROUNDS, ROUNDS_DAMPINGS, result_of
from tests.experiments.canned import numbering
from tests.experiments.canned.numbering import LEFT, START
from tests.experiments.canned.reading import finding, in_order, numbers, records

DAMPED = f"numbering_damping_{DAMPINGS[0]:g}"


def test_the_table_has_predicted_and_measured_in_their_columns() -> None:
    """And the difference that each permutation makes in its own."""
    table = {row["stepper"]: row for row in records(numbering.usual(), DAMPED)}
    orders = {name: (row["predicted: order shows of"], row["measured: order shows of"]) for name, row in table.items()}
    assert orders == {
        "kick_drift": ("none", "none"),
        "euler_in_place": ("masses", "masses"),
        "pymunk_springs": ("springs", "springs"),
        "stranger": (None, "ends"),
        "mujoco_cable": ("none", None),
    }
    assert table["euler_in_place"]["masses renumbered [m]"] == 2e-3
    assert table["pymunk_springs"]["springs reversed [m]"] == 5e-6
    assert table["stranger"]["ends swapped [m]"] == 7e-7
    assert table["mujoco_cable"]["springs reversed [m]"] is None


def test_without_damping_pymunk_sees_nothing() -> None:
    """In its own table."""
    table = {row["stepper"]: row for row in records(numbering.usual(), f"numbering_damping_{DAMPINGS[1]:g}")}
    assert table["pymunk_springs"]["measured: order shows of"] == "none"


def test_the_table_of_rounds_has_each_difference_at_its_round() -> None:
    """With what is predicted to be left, and what is."""
    for damping, (predicted, left) in zip(ROUNDS_DAMPINGS, LEFT, strict=True):
        rows = [row for row in records(numbering.usual(), "numbering_rounds") if row["damping [N s/m]"] == damping]
        assert [row["rounds"] for row in rows] == list(ROUNDS)
        assert [row["springs reversed [m]"] for row in rows] == pytest.approx([START * left**n for n in ROUNDS])
        assert {(row["predicted: a round leaves [1]"], row["fitted [1]"]) for row in rows} == {(predicted, left)}


def test_sentences_count_who_sees_nothing_and_have_the_range_of_who_does() -> None:
    """Of eight runs that could be done in full three see nothing; one of masses' order in both."""
    result = numbering.usual()
    assert numbers(finding(result, "does not matter")) == pytest.approx([3, 8, 3e-16])
    masses = finding(result, "With masses renumbered")
    assert (numbers(masses), "euler_in_place" in masses) == (pytest.approx([2e-3, 2e-3]), True)
    assert numbers(finding(result, "With springs reversed")) == pytest.approx([5e-6, 5e-6])
    assert numbers(finding(result, "With ends swapped")) == pytest.approx([7e-7, 7e-7])
    assert numbers(finding(result, "predicted from the scheme")) == [6, 6]
    partly = finding(result, "in its own order only")
    assert (numbers(partly), "mujoco_cable" in partly) == (pytest.approx([4e-16]), True)


def test_sentences_of_rounds_have_the_measured_factor_then_the_predicted() -> None:
    """With one round and with the default of ten."""
    for damping, (predicted, left) in zip(ROUNDS_DAMPINGS, LEFT, strict=True):
        said = finding(numbering.usual(), f"Damped with {damping:g} N s/m")
        expected = [damping, START * left, 1, START * left**10, 10, left, predicted]
        assert numbers(said) == pytest.approx(expected, rel=0.05)
        assert in_order(said, f"{left:.2f} of that", "predicted")


def test_what_could_not_be_fitted_has_no_sentence() -> None:
    """Pymunk, where it is not installed."""
    nothing = [replace(c, distances=[np.nan] * len(ROUNDS), measured=None) for c in numbering.convergences()]
    result = result_of(numbering.rows(), nothing)
    assert not [said for said in result.findings if "Pymunk" in said]
    assert {row["springs reversed [m]"] for row in records(result, "numbering_rounds")} == {None}


def test_failures_have_their_reasons_once() -> None:
    """The same with both dampings."""
    assert [failure.partition(": ")[0] for failure in numbering.usual().failures] == [
        "mujoco_cable, masses renumbered",
        "mujoco_cable, springs reversed",
    ]


def test_who_is_not_as_predicted_is_named() -> None:
    """One that should see nothing, and sees springs."""
    wrong = numbering.row("heun", numbering.NONE, 0.0, 3e-4, DAMPINGS[0], 0.0)
    said = finding(result_of([*numbering.rows(), wrong], numbering.convergences()), "predicted from the scheme")
    assert numbers(said) == [6, 7]
    assert said.endswith("not for heun.")
