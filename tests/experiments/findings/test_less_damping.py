"""Less damping: decay times predicted and measured, what is left of the energy, and what the drag has taken."""

from __future__ import annotations

import math

import pytest

from experiments.less_damping import DRAGS, DURATION
from tests.experiments.canned import less_damping
from tests.experiments.canned.less_damping import MASS, SLOWER, START
from tests.experiments.canned.reading import finding, numbers, records


def left(drag: float) -> float:
    """The part of the energy that is left: exp(-t / (1.25 m/Cd))."""
    return math.exp(-DURATION * drag / MASS / SLOWER)


def test_the_table_has_each_number_in_its_column() -> None:
    """Predicted m/Cd, measured a quarter more; taken is a hundredth less than what is missing."""
    for row, drag in zip(records(less_damping.usual()), DRAGS, strict=True):
        assert row["drag [N s/m]"] == drag
        assert row["decay time, predicted for small swings [s]"] == pytest.approx(MASS / drag)
        assert row["measured [s]"] == pytest.approx(SLOWER * MASS / drag)
        assert row["energy at the start [J]"] == START
        assert row[f"after {DURATION:g} s [J]"] == pytest.approx(START * left(drag))
        assert row["taken by the drag [J]"] == pytest.approx(START * (1 - left(drag) - 0.01))
        assert row["left"] == pytest.approx(left(drag))


def test_each_sentence_has_what_is_left_and_the_times_measured_then_predicted() -> None:
    """In percent and seconds."""
    for drag in DRAGS:
        said = numbers(finding(less_damping.usual(), f"With a drag of {drag:g} N s/m"))
        times = [1, math.e, SLOWER * MASS / drag, MASS / drag]
        expected = [drag, 100 * left(drag), DURATION, times[0], times[2], times[3]]
        assert [n for n in said if n != math.e] == pytest.approx(expected, rel=0.05)


def test_the_last_sentence_has_the_largest_differences() -> None:
    """A quarter in the times, a hundredth in the balance."""
    assert numbers(finding(less_damping.usual(), "differ by")) == pytest.approx([25, 0.01])
