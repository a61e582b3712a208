"""The mistakes that explain answers: the simplest ones with which the solution gives the same numbers to rounding.

The first of these that fits is taken:

1. no mistake at all, or one, to the tolerance of the exercise;
2. no mistake, or one, to single precision, where every other is much farther away;
3. two mistakes at once, in different parameters of the solution;
4. where students write several functions, the same for each function by itself.

>>> from experiments.exercises.verdict.answer_catalogue import catalogue_of
>>> from experiments.exercises.exercise import find
>>> catalogue = catalogue_of(find("euler"), seed="", key=None)
>>> given = catalogue.answers({"clock": "half", "gravity": -1.0})
>>> [mistake.name for mistake in identify(catalogue, given).mistakes]
['gravity_sign', 'half_a_step']
>>> identify(catalogue, catalogue.right)
Explanation(mistakes=(), distance=0.0)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from experiments.exercises.exercise import Answer, Mistake
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue

#: Numbers that were computed in single precision are this close to the double ones, as a fraction of the largest.
SINGLE = 2e-5

#: They count as the same if every other explanation is at least this many times as far away.
APART = 30.0


@dataclass(frozen=True)
class Explanation:
    """Mistakes, none where the answers are right, and how far the answers are from those that they give."""

    mistakes: tuple[Mistake, ...]
    distance: float


def identify(catalogue: AnswerCatalogue, given: Sequence[Answer]) -> Explanation | None:
    """The simplest explanation of the answers; None where there is none in the catalogue."""
    return _of_all(catalogue, given) or _of_each_function(catalogue, given)


def _of_all(catalogue: AnswerCatalogue, given: Sequence[Answer]) -> Explanation | None:
    """An explanation by at most two mistakes."""
    tolerance = catalogue.exercise.tolerance
    right = Explanation((), catalogue.distance(given, catalogue.right))
    if right.distance <= tolerance:
        return right
    ranking = sorted([right, *_single_mistakes(catalogue, given)], key=lambda e: e.distance)
    if ranking[0].distance <= tolerance or _in_single_precision(ranking, tolerance):
        return ranking[0]
    return _two_mistakes(catalogue, given)


def _single_mistakes(catalogue: AnswerCatalogue, given: Sequence[Answer]) -> list[Explanation]:
    """How far the answers are from those of each mistake that comes near with the first steps; most are ruled out.

    Near is as far as single precision has to be beside the others: no answer that is farther can matter.
    """
    near = max(APART * SINGLE, catalogue.exercise.tolerance)
    return [
        Explanation((mistake,), catalogue.distance(given, catalogue.answers(mistake.parameters)))
        for mistake in catalogue.exercise.mistakes
        if catalogue.begins_with(given, mistake.parameters, near)
    ]


def _in_single_precision(ranking: Sequence[Explanation], tolerance: float) -> bool:
    """Whether the nearest explanation fits to single precision, and no other comes near."""
    nearest, *others = (explanation.distance for explanation in ranking)
    return nearest <= max(SINGLE, tolerance) and min(others, default=np.inf) > APART * nearest


def _two_mistakes(catalogue: AnswerCatalogue, given: Sequence[Answer]) -> Explanation | None:
    """The first pair of mistakes that fits; most pairs are ruled out by a first step."""
    tolerance = catalogue.exercise.tolerance
    for pair in catalogue.pairs:
        parameters = {**pair[0].parameters, **pair[1].parameters}
        if catalogue.begins_with(given, parameters, tolerance):
            distance = catalogue.distance(given, catalogue.answers(parameters))
            if distance <= tolerance:
                return Explanation(pair, distance)
    return None


def _of_each_function(catalogue: AnswerCatalogue, given: Sequence[Answer]) -> Explanation | None:
    """The explanations of several functions together; None where one of them has none."""
    if len(catalogue.by_function) < 2:
        return None
    found = []
    for name, part in catalogue.by_function.items():
        answers = [answer for q, answer in zip(catalogue.questions, given, strict=True) if q.function == name]
        explanation = _of_all(part, answers)
        if explanation is None:
            return None
        found.append(explanation)
    mistakes = {mistake.name: mistake for explanation in found for mistake in explanation.mistakes}
    return Explanation(tuple(mistakes.values()), max(explanation.distance for explanation in found))
