"""Less damping: decay times predicted and measured, what is left of the energy, and what the drag has taken."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from experiments.less_damping import DRAGS, DURATION, result_of
from tests.experiments.canned import less_damping
from tests.experiments.canned.less_damping import FITTED, MASS, SLOWER, START
from tests.experiments.canned.reading import finding, numbers, records


def left(drag: float) -> float:
    """The part of the energy that is left: exp(-t / (1.25 m/Cd))."""
    return math.exp(-DURATION * drag / MASS / SLOWER)


def test_the_table_has_each_number_in_its_column() -> None:
    """Predicted m/Cd, fitted a tenth more, measured a quarter more, within the run; taken a hundredth less."""
    for row, drag in zip(records(less_damping.usual()), DRAGS, strict=True):
        assert row["drag [N s/m]"] == drag
        assert row["decay time, predicted for small swings [s]"] == pytest.approx(MASS / drag)
        assert row["decay time, fitted to the whole run [s]"] == pytest.approx(FITTED * MASS / drag)
        measured = SLOWER * MASS / drag
        assert row["falls to 1/e at, measured [s]"] == (pytest.approx(measured) if measured < DURATION else None)
        assert row["energy at the start [J]"] == START
        assert row[f"after {DURATION:g} s [J]"] == pytest.approx(START * left(drag))
        assert row["taken by the drag [J]"] == pytest.approx(START * (1 - left(drag) - 0.01))
        assert row["left [1]"] == pytest.approx(left(drag))


def test_each_sentence_has_what_is_left_and_its_times() -> None:
    """In percent and seconds: measured, where the run is long enough, then predicted and fitted."""
    for drag in DRAGS:
        said = numbers(finding(less_damping.usual(), f"With a drag of {drag:g} N s/m"))
        time = SLOWER * MASS / drag
        measured = [time] if time < DURATION else []
        expected = [drag, 100 * left(drag), DURATION, 1, *measured, MASS / drag, FITTED * MASS / drag]
        assert said == pytest.approx(expected, rel=0.05)


def test_where_the_run_is_too_short_that_is_said() -> None:
    """5 s of predicted decay do not fit into 3 s: no time to 1/e is named as measured."""
    said = finding(less_damping.usual(), "With a drag of 0.004 N s/m")
    assert "too short" in said
    assert "measured" not in said


def test_the_last_sentences_have_the_largest_differences() -> None:
    """A tenth in the decay times, a hundredth in the balance."""
    assert numbers(finding(less_damping.usual(), "differs from it by"))[0] == pytest.approx(10)
    assert numbers(finding(less_damping.usual(), "What is missing")) == pytest.approx([0.01])


def test_the_largest_difference_is_told_whichever_swing_it_is_of() -> None:
    """Fitted times differ by 10, 30 and 20 %, balances by 1, 2 and 5 %."""
    swings = [
        replace(swing, fitted=off * swing.predicted, taken=swing.energies[0] * (1 - missing) - swing.energies[-1])
        for swing, off, missing in zip(
            map(less_damping.swing, DRAGS), (1.1, 0.7, 1.2), (0.01, 0.02, 0.05), strict=False
        )
    ]
    result = result_of(swings)
    assert numbers(finding(result, "differs from it by"))[0] == pytest.approx(30)
    assert numbers(finding(result, "What is missing")) == pytest.approx([0.05])
