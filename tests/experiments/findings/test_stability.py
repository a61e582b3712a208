"""Stability: predicted limits in the column of what is predicted, and the widest difference in the sentence."""

from __future__ import annotations

import pytest

from experiments.stability import result_of
from tests.experiments.canned import stability
from tests.experiments.canned.reading import finding, numbers, records
from tests.experiments.canned.stability import rows


def test_the_table_has_predicted_and_measured_in_their_columns() -> None:
    """Seconds; the difference is of the predicted one, with its sign."""
    kick_drift, pymunk, euler, *_ = records(stability.usual())
    assert (kick_drift["predicted dt [s]"], kick_drift["measured dt [s]"]) == (0.010, 0.0101)
    assert kick_drift["relative difference"] == pytest.approx(0.01)
    assert pymunk["relative difference"] == pytest.approx(-0.001)
    assert (euler["predicted dt [s]"], euler["measured dt [s]"], euler["relative difference"]) == (None, None, None)
    assert euler["reason"].startswith("predicted: unstable at any dt: grows by 0.001")


def test_rows_are_of_their_case() -> None:
    """Damping and drag are not each other's."""
    table = records(stability.full())
    cases = {(row["damping [N s/m]"], row["drag [N s/m]"]) for row in table}
    assert cases == {(0.0, 0.0), (0.1, 0.0), (0.5, 0.0), (0.0, 0.1)}


def test_the_sentence_has_the_widest_difference_and_whose_it_is() -> None:
    """A hundredth, of four; with the engine's turned to a tenth, that."""
    assert numbers(finding(stability.usual(), "predicted and measured"))[:2] == pytest.approx([4, 1])
    assert "kick_drift" in finding(stability.usual(), "predicted and measured")
    made = rows()
    made[1] = type(made[1])(**{**vars(made[1]), "measured": type(made[1].measured)(0.018)})
    widest = finding(result_of(made), "predicted and measured")
    assert numbers(widest)[:2] == pytest.approx([4, 10])
    assert "pymunk_springs" in widest


def test_who_is_unstable_at_any_dt_is_named_once() -> None:
    """And who is stable at any is not."""
    assert finding(stability.usual(), "Unstable at any dt").endswith(": euler.")


def test_a_failure_is_told_once_for_all_cases() -> None:
    """With its reason."""
    (failure,) = stability.usual().failures
    assert failure.startswith("mujoco_rope: unsupported, ")
    assert "no_such_engine is not installed" in failure
