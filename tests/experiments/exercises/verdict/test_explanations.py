"""Explanations of answers, and distances between them, for an exercise of one line whose numbers are plain."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from experiments.exercises.exercise import Answer, Exercise, Mistake, Question, mistake
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue, catalogue_of, draw_questions
from experiments.exercises.verdict.answer_distance import LARGEST, answer_distance, scales_of
from experiments.exercises.verdict.naming import APART, SINGLE, identify

TOLERANCE = 1e-9


def step(x: float, added: float = 0.0, factor: float = 1.0, late: float = 0.0) -> float:
    """A step from x = 1: the right one stays there.

    Args:
        late: is added too, but not in the first step.
    """
    return factor * x + added + (late if x != 1.0 else 0.0)


def catalogue(*mistakes: Mistake, steps: int = 4) -> AnswerCatalogue:
    """Four steps from 1, and these mistakes."""
    exercise = Exercise("Standstill", 1, "", {"step": step}, lambda *_: [], mistakes, tolerance=TOLERANCE)
    return AnswerCatalogue(exercise, [Question("step", (1.0,), ("x",), "", steps)])


def answers(*numbers: float) -> list[Answer]:
    """What was answered, step by step."""
    return [[[np.array(number)] for number in numbers]]


def explained(known: AnswerCatalogue, given: Sequence[Answer]) -> list[str] | None:
    """The names of the mistakes."""
    explanation = identify(known, given)
    return None if explanation is None else [mistake.name for mistake in explanation.mistakes]


ADDS = mistake("adds", "", "", added=0.5)
LATE = mistake("late", "", "", late=0.25)
EXPLODES = mistake("explodes", "", "", factor=20.0)


def test_the_right_answer_is_explained_by_no_mistake_and_each_mistake_by_itself() -> None:
    """And what none of them gives by nothing."""
    known = catalogue(ADDS, EXPLODES)
    assert explained(known, answers(1, 1, 1, 1)) == []
    assert explained(known, answers(1.5, 2, 2.5, 3)) == ["adds"]
    assert explained(known, answers(1.5, 2, 2.5, 3.1)) is None


def test_two_mistakes_explain_all_steps_or_none() -> None:
    """The first step of both is that of `adds` alone: from the second on each step adds 0.5 and 0.25."""
    known = catalogue(ADDS, LATE)
    assert explained(known, answers(1.5, 2.25, 3, 3.75)) == ["adds", "late"]
    assert explained(known, answers(1.5, 2.25, 3, 3.7)) is None


@pytest.mark.parametrize(("share", "name"), [(0.9, []), (1.1, None)])
def test_rounded_answers_are_the_nearest_if_nothing_else_is_near(share: float, name: list[str] | None) -> None:
    """An error of SINGLE is explained while the next explanation is APART times as far away, not nearer."""
    error = SINGLE / 2
    other = mistake("other", "", "", added=error * (1 + APART / share))
    given = answers(1 + error)
    assert explained(catalogue(other, steps=0), given) == name


def test_an_error_beyond_single_precision_is_no_rounding() -> None:
    """However far everything else is."""
    known = catalogue(EXPLODES, steps=0)
    assert explained(known, answers(1 + 0.9 * SINGLE)) == []
    assert explained(known, answers(1 + 1.1 * SINGLE)) is None


def test_mistakes_that_change_the_same_parameter_are_not_made_at_once() -> None:
    """Not even where they change others as well."""
    one, other = mistake("one", "", "", added=1.0, late=1.0), mistake("other", "", "", added=2.0)
    assert catalogue(one, other, EXPLODES).pairs == [(one, EXPLODES), (other, EXPLODES)]


def test_a_motion_that_blows_up_is_compared_by_its_own_size_and_not_beyond() -> None:
    """The scale is 1. 20 is compared with 20, by whose rounding it is 1e-8 off; 400 is beyond LARGEST: not compared."""
    known = catalogue(EXPLODES)
    assert LARGEST == 100.0
    explanation = identify(known, answers(20 * (1 + 0.5 * TOLERANCE), 401, -7, np.inf))
    assert explanation is not None
    assert explanation.mistakes == (EXPLODES,)
    assert explanation.distance == pytest.approx(0.5 * TOLERANCE, rel=1e-5)
    assert explained(known, answers(20 * (1 + 2 * SINGLE), 400, 8000, 160000)) is None


def test_functions_are_explained_one_by_one_and_each_mistake_once() -> None:
    """Three functions, of which two have the same mistake; the distance is the largest. None where one has no name."""
    solutions = dict.fromkeys(("a", "b", "c"), step)
    exercise = Exercise("Standstill", 1, "", solutions, lambda *_: [], (ADDS, EXPLODES), tolerance=TOLERANCE)
    known = AnswerCatalogue(exercise, [Question(name, (1.0,), ("x",), "") for name in solutions])
    explanation = identify(known, [*answers(1.5 + 0.5 * TOLERANCE), *answers(20.0), *answers(1.5)])
    assert explanation is not None
    assert explanation.mistakes == (ADDS, EXPLODES)
    assert explanation.distance == pytest.approx(0.5 * TOLERANCE / 1.5, rel=1e-5)
    assert identify(known, [*answers(1.5), *answers(20.0), *answers(7.0)]) is None


def test_questions_are_drawn_anew_until_mistakes_can_be_told_apart() -> None:
    """From 0 every factor leads to 0, from 1 they differ: whatever the key, the question is about 1."""

    def questions(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
        return [Question("step", (float(random.integers(2)),), ("x",), "")]

    exercise = Exercise("Drawn", 1, "", {"step": step}, questions, (EXPLODES,), folder=Path("e99_drawn"))
    first = {draw_questions(exercise, "", key, 0)[0].arguments for key in "abcdefgh"}
    assert first == {(0.0,), (1.0,)}
    assert {catalogue_of(exercise, "", key).questions[0].arguments for key in "abcdefgh"} == {(1.0,)}


@pytest.mark.parametrize(
    ("given", "expected", "distance"),
    [
        ([1.0, 2.0], [1.0, 4.0], 0.5),
        ([np.nan, 4.0], [1.0, 4.0], np.inf),
        ([np.nan, 4.0], [np.nan, 4.0], 0.0),
        ([1.0, 4.0, 4.0], [1.0, 4.0], np.inf),
        (["a", "b"], ["a", "b"], 0.0),
        (["a", "c"], ["a", "b"], np.inf),
        ([1.0, 2.0], ["1.0", "2.0"], np.inf),
    ],
)
def test_the_distance_of_two_arrays(given: list[Any], expected: list[Any], distance: float) -> None:
    """As a fraction of the largest; words are the same or not; two that are both not a number are the same."""
    scales = [4.0]
    assert answer_distance([[np.array(given)]], [[np.array(expected)]], scales) == distance


def test_scales_are_the_largest_right_numbers_and_never_zero() -> None:
    """Of each part, over all steps; 1 where nothing or no number is right, so that distances are finite."""
    steps = [
        [np.array([1.0, -3.0]), np.zeros(2), np.array(["a"])],
        [np.array([2.0, 2.0]), np.zeros(2), np.array(["b"])],
    ]
    assert scales_of(steps) == [3.0, 1.0, 1.0]
