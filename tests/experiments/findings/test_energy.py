"""Energies: what is predicted and what is measured of each, and who keeps which momentum."""

from __future__ import annotations

import pytest

from experiments.energy import EVERY, Row, result_of
from tests.experiments.canned import energy
from tests.experiments.canned.reading import finding, in_order, numbers, records


def test_the_table_has_predicted_and_measured_in_their_columns() -> None:
    """And the largest errors of energy, momentum and angular momentum, each in its own."""
    table = {row["stepper"]: row for row in records(energy.usual())}
    odd = table["pendulum_kick_drift"]
    assert (odd["predicted"], odd["measured"]) == ("bounded", "growing")
    assert (odd["momentum [1]"], odd["angular [1]"]) == (None, None)
    rk4 = table["rk4"]
    assert (rk4["largest energy error [1]"], rk4["momentum [1]"], rk4["angular [1]"]) == pytest.approx(
        (0.1, 2e-16, 5e-8)
    )
    assert table["euler"]["outcome"] == "diverged"
    assert table["Segfaults"]["largest energy error [1]"] is None


def test_the_table_over_time_has_the_errors() -> None:
    """Signed, one in EVERY."""
    rows = [row for row in records(energy.usual(), "energy_over_time") if row["stepper"] == "rk4"]
    assert [row["energy error [1]"] for row in rows] == pytest.approx(energy.errors("decaying")[::EVERY].tolist())
    assert [row["time [s]"] for row in rows] == energy.TIMES[::EVERY].tolist()


def test_the_first_sentence_counts_kinds_as_they_were_measured() -> None:
    """Two bounded, three growing, one decaying; as predicted five of six."""
    first = finding(energy.usual(), "as predicted in")
    assert numbers(first) == [20, 2, 3, 1, 5, 6]
    assert in_order(first, "bounded in 2", "growing in 3", "decaying in 1")


def test_who_is_not_as_predicted_is_named_with_both() -> None:
    """Predicted first."""
    odd = finding(energy.usual(), "Predicted ", "pendulum_kick_drift")
    assert odd.startswith("Predicted bounded, measured growing: pendulum_kick_drift.")


def test_momenta_are_counted_apart() -> None:
    """Of five, four keep momentum, to the largest of theirs, two angular momentum; the others' errors are theirs."""
    assert numbers(finding(energy.usual(), "keep a free string's momentum")) == pytest.approx([4, 5, 2e-16])
    assert numbers(finding(energy.usual(), "keep a free string's angular momentum")) == pytest.approx([2, 5, 2e-16])
    momentum, angular = (said for said in energy.usual().findings if said.startswith("The others are off"))
    assert (numbers(momentum), numbers(angular)) == (pytest.approx([3e-2]), pytest.approx([5e-8, 4e-2, 1e-1]))
    assert in_order(angular, "rk4 5", "heun_link_by_link 4", "euler 1")


def test_engines_are_listed_by_what_was_measured() -> None:
    """One."""
    assert finding(energy.usual(), "Of the engines") == "Of the engines, energy is bounded in pymunk_springs."


def test_failures_are_of_the_string_they_happened_on() -> None:
    """The free one is said to be it."""
    assert energy.usual().failures == [
        "euler: diverged, spring 1 is torn",
        "Segfaults: crashed, SIGSEGV",
        "pendulum_kick_drift on the free string: unsupported, pendulum_kick_drift does not fly",
        "Segfaults on the free string: crashed, SIGSEGV",
    ]


def test_without_a_stepper_there_is_a_sentence() -> None:
    """And no row."""
    assert len(energy.nobody().findings) == 1
    assert records(energy.nobody()) == []


def test_who_was_not_measured_is_not_counted() -> None:
    """Its energy was predicted, and it crashed."""
    lost = Row(**{**vars(energy.crashed()), "predicted": "growing"})
    first = finding(result_of([*energy.rows(), lost]), "as predicted in")
    assert numbers(first) == [20, 2, 3, 1, 5, 6]
