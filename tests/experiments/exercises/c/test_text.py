"""What is read in a C program without running it, and which scheme infinite numbers are those of."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from experiments.exercises.c.text import lines_that_write, told_by_overflow, whole_divisions
from experiments.exercises.exercise import Mistake, Question, find

HEUN = find("2")
QUESTIONS = list(HEUN.aside_in_c())


def answers(parameters: Mapping[str, Any], change: Callable[[float], float] = float, part: int = 0) -> list[Any]:
    """What a program answers that steps in this way; a part of its last answer changed."""
    made = [[np.array(number) for number in HEUN.answer(question, parameters)[0]] for question in QUESTIONS]
    made[-1][part] = np.array(change(float(made[-1][part])))
    return [{"values": [parts]} for parts in made]


def test_another_scheme_is_told_by_what_is_infinite() -> None:
    """Midpoint and Ralston, each by its own name; nothing of the right one, of no answers, of one that is missing."""
    for other in HEUN.told_aside:
        told = told_by_overflow(HEUN, QUESTIONS, answers(other.parameters))
        assert told is not None
        assert told.name == other.name
    assert len(HEUN.told_aside) > 1
    assert told_by_overflow(HEUN, QUESTIONS, answers({})) is None
    assert told_by_overflow(HEUN, [], []) is None
    other = answers(HEUN.told_aside[0].parameters)
    assert told_by_overflow(HEUN, QUESTIONS, [*other[:-1], {"values": []}]) is None


@pytest.mark.parametrize("change", [lambda v: np.inf, lambda v: np.nan, lambda v: -v, lambda v: v * 1.001])
def test_one_number_that_is_another_is_not_the_other_schemes(change: Callable[[float], float]) -> None:
    """Midpoint's last position is finite: not where it is infinite, of the other sign, or a little off.

    Its velocities are infinite times a weight of 0: whatever a program has there is as good.
    """
    midpoint = next(other for other in HEUN.told_aside if other.name == "midpoint")
    assert told_by_overflow(HEUN, QUESTIONS, answers(midpoint.parameters, change)) != midpoint
    assert told_by_overflow(HEUN, QUESTIONS, answers(midpoint.parameters, lambda v: 3.0, 1)) == midpoint


STEP = """void step(double *y, double *v, double dt, const struct spring *s)
{
    double a = *y == 0 ? 1 : 2;
    *v += a * dt;
    if (*y >= 0) *y = *v;
    // *y = 0;
    s->y = 1;
}

void other(double x[][2], double dt)
{
    x[0][1] -= dt;
    *y = 2;
}
"""


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ([2.0, 3.0, np.inf], True),
        ([2.0, 3.0, 7.0], True),
        ([2.0, np.inf, np.inf], False),
        ([np.inf, 3.0, np.inf], False),
        ([2.0, 3.5, np.inf], False),
    ],
)
def test_every_number_that_the_other_scheme_has_counts(given: list[float], told: bool) -> None:
    """All that are finite there; where it has none, whatever there is. The right step is infinite."""
    other = Mistake("other", "", "", {"scheme": "other"})
    solved = {"other": [2.0, 3.0, np.nan], "right": [np.inf, 3.0, np.inf]}
    exercise: Any = SimpleNamespace(
        told_aside=[other],
        answer=lambda question, parameters: [[np.array(solved[parameters.get("scheme", "right")])], [np.zeros(3)]],
    )
    question = Question("step", (), ("x",), "")
    found = told_by_overflow(exercise, [question], [{"values": [[np.array(given)], [np.ones(3)]]}])
    assert found == (other if told else None)


@pytest.mark.parametrize(
    ("function", "place", "lines"),
    [("step", 0, [5]), ("step", 1, [4]), ("step", 2, []), ("other", 0, [12]), ("other", 1, []), ("none", 0, [])],
)
def test_where_a_function_writes_what_it_is_given(function: str, place: int, lines: list[int]) -> None:
    """No comparison, no comment, no field of that name, no other function, and not what it may not write into."""
    assert lines_that_write(STEP, function, place) == lines
    assert lines_that_write(f"\n{STEP}", function, place) == [line + 1 for line in lines]
    # whatever stands before it that is not written into
    before = "int n, const double *w, double dt, "
    assert lines_that_write(STEP.replace("(double", f"({before}double"), function, place) == lines


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("a = 6 / 3;", []),
        ("a = 7 / 3;", [(1, "7 / 3")]),
        ("a = 3 / 6;", [(1, "3 / 6")]),
        ("a = 3 / 0;", [(1, "3 / 0")]),
        ("/* 1 / 2\n1 / 2 */ a = 1/4; b = 3 / 4;", [(2, "1 / 4"), (2, "3 / 4")]),
        ('s = "1 / 2";', []),
        ("a = x1 / 2 + 1 / 2.0;", []),
    ],
)
def test_whole_divisions_are_those_that_leave_something(text: str, told: list[tuple[int, str]]) -> None:
    """On their lines, also behind a comment of several; nothing in comments or in quotes."""
    assert whole_divisions(text) == told
