"""An exercise's answer catalogue: its questions, and what the solution answers to them, rightly and with each mistake.

No answer is written down anywhere: the solution computes it when it is first asked for, with the parameters of the
mistake, and the catalogue keeps it for the submissions that follow.

>>> from experiments.exercises.exercise import find
>>> catalogue = catalogue_of(find("euler"), seed="", key=None)
>>> [(question.function, question.parts, question.steps) for question in catalogue.questions[:1]]
[('step', ('y', 'v'), 20)]
>>> half_a_step = catalogue.answers({"clock": "half"})
>>> catalogue.distance(half_a_step, catalogue.right) > 0.1
True
>>> catalogue.distance(catalogue.right, catalogue.right)
0.0
"""

from __future__ import annotations

import hashlib
from collections.abc import Container, Iterator, Mapping, Sequence
from functools import cached_property, lru_cache
from itertools import combinations
from typing import Any

import numpy as np

from experiments.exercises.exercise import TOLERANCE, Answer, Exercise, Mistake, Question
from experiments.exercises.verdict.answer_distance import answer_distance, scales_of

#: How often questions are drawn, at most, until every two mistakes give different answers.
DRAWS = 50

#: Answers that are farther apart than this are different.
DIFFERENT = 1e-4


class AnswerCatalogue:
    """Questions of an exercise, and the solution's answers to them, with any of its parameters changed."""

    def __init__(self, exercise: Exercise, questions: Sequence[Question]) -> None:
        self.exercise = exercise
        self.questions = list(questions)
        self._computed: dict[tuple[Any, ...], Answer] = {}

    @cached_property
    def aside(self) -> AnswerCatalogue:
        """The questions from which only follows that a submission is one of the exercise's `told_aside`."""
        made = self.exercise.aside(np.random.default_rng(0)) if self.exercise.aside else ()
        return AnswerCatalogue(self.exercise, made)

    def without(self, functions: Container[str]) -> AnswerCatalogue:
        """The questions that are not about these functions."""
        return AnswerCatalogue(self.exercise, [q for q in self.questions if q.function not in functions])

    @property
    def right(self) -> list[Answer]:
        """The right answers, one for each question."""
        return self.answers({})

    def answers(self, parameters: Mapping[str, Any]) -> list[Answer]:
        """The answers of the solution with these parameters changed, one for each question."""
        return [self._answer(i, parameters, None) for i in range(len(self.questions))]

    def _answer(self, i: int, parameters: Mapping[str, Any], steps: int | None) -> Answer:
        """The answer to question i; to its first steps only, if a number is given."""
        key = (i, steps, *sorted(parameters.items()))
        if key not in self._computed:
            self._computed[key] = self.exercise.answer(self.questions[i], parameters, steps)
        return self._computed[key]

    @cached_property
    def scales(self) -> list[list[float]]:
        """For each question, the largest right number of each part."""
        return [scales_of(answer) for answer in self.right]

    def distances(self, given: Sequence[Answer], expected: Sequence[Answer]) -> list[float]:
        """For each question, how far two answers to it are apart."""
        return list(self._distances(given, expected))

    def _distances(self, given: Sequence[Answer], expected: Sequence[Answer]) -> Iterator[float]:
        """One after the other, for who need not know all."""
        for i, (one, other) in enumerate(zip(given, expected, strict=True)):
            yield answer_distance(one, other, self._sizes(i, other))

    def _sizes(self, i: int, expected: Answer) -> list[float]:
        """What differences count as fractions of: the right answer's scales, but where numbers are typed in their own.

        Beside a large right number all that is much too small would be as near to it as its tolerance.
        """
        if self.exercise.tolerance <= TOLERANCE:
            return self.scales[i]
        largest = [max(float(np.abs(step[p]).max(initial=0.0)) for step in expected) for p in range(len(expected[0]))]
        return [own or TOLERANCE * scale for own, scale in zip(largest, self.scales[i], strict=True)]

    def distance(self, given: Sequence[Answer], expected: Sequence[Answer]) -> float:
        """The largest of these distances."""
        return max(self._distances(given, expected), default=0.0)

    def differ(self, given: Sequence[Answer], expected: Sequence[Answer], by: float) -> bool:
        """Whether one of these distances is more than that; mostly the first question says so."""
        return any(distance > by for distance in self._distances(given, expected))

    def begins_with(self, given: Sequence[Answer], parameters: Mapping[str, Any], tolerance: float) -> bool:
        """Whether the first step of every answer is the solution's; mostly the first question says that it is not."""
        firsts = ((i, a[:1], self._answer(i, parameters, 1)) for i, a in enumerate(given))
        return all(answer_distance(a, first, self._sizes(i, first)) <= tolerance for i, a, first in firsts)

    @cached_property
    def pairs(self) -> list[tuple[Mistake, Mistake]]:
        """Every two mistakes that can be made at once, as they change different parameters."""
        mistakes = self.exercise.mistakes
        return [(a, b) for a, b in combinations(mistakes, 2) if not set(a.parameters) & set(b.parameters)]

    @cached_property
    def by_function(self) -> Mapping[str, AnswerCatalogue]:
        """A catalogue for each function that students write, of the questions about it."""
        names = dict.fromkeys(question.function for question in self.questions)
        return {
            name: AnswerCatalogue(self.exercise, [q for q in self.questions if q.function == name]) for name in names
        }

    def all_differ(self) -> bool:
        """Whether no mistake gives the answers of another one, or the right ones."""
        answers = [("", self.right), *((m.name, self.answers(m.parameters)) for m in self.exercise.mistakes)]
        return all(a == b or self.differ(x, y, DIFFERENT) for (a, x), (b, y) in combinations(answers, 2))


def catalogue_of(exercise: Exercise, seed: str, key: str | None) -> AnswerCatalogue:
    """The catalogue of a check; made once for all submissions that are asked the same.

    Args:
        seed: the student's; it matters in an exercise where everybody has numbers of their own.
        key: the teacher's, for the hidden check; None for the public one.
    """
    return _catalogue(exercise, seed if exercise.seeded else "", key)


@lru_cache(maxsize=64)
def _catalogue(exercise: Exercise, seed: str, key: str | None) -> AnswerCatalogue:
    """Questions are drawn anew while two mistakes give the same answers: a longest member may also be the stiffest.

    That does not happen where there are steps; and what a student was handed out cannot be drawn anew.
    """
    for draw in range(DRAWS):
        questions = draw_questions(exercise, seed, key, draw)
        catalogue = AnswerCatalogue(exercise, questions)
        if exercise.seeded or any(question.steps for question in questions) or catalogue.all_differ():
            break
    return catalogue


def draw_questions(exercise: Exercise, seed: str, key: str | None, draw: int) -> Sequence[Question]:
    """The questions that follow from seed, key and the number of the draw, and from nothing else."""
    words = f"{exercise.name}\0{seed}\0{key or ''}\0{draw}"
    random = np.random.default_rng(list(hashlib.sha256(words.encode()).digest()))
    return exercise.questions(random, key is not None, seed)
