"""The first number of an answer that is not the right one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import takewhile
from typing import Any

import numpy as np

from experiments.exercises.exercise import Answer, Question
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue
from experiments.exercises.verdict.answer_distance import part_distance
from reference.state import Array


@dataclass(frozen=True)
class FirstDifference:
    """One number beside the right one.

    Attributes:
        about: the question, in words.
        step: from 1 on, or 0 where the question has no steps.
        part: which of the things returned. item: what its first axis counts. index: where in it.
        right, given: the two numbers, or words.
        told: whether the right one may be told.
    """

    about: str
    step: int
    part: str
    item: str
    index: tuple[int, ...]
    right: Any
    given: Any
    told: bool = True

    def __str__(self) -> str:
        if self.item == "between mass":
            place = f"between mass {self.index[0]} and mass {self.index[1]}"
            return f"{self.about}, {place}: {self.given} spring{'s'[: self.given != 1]}, expected {self.right}"
        place = f"{self.item} {self.index[0]}" if self.index else ""
        at = f"[{', '.join(map(str, self.index))}]" if self.index else ""
        where = ", ".join(filter(None, [self.about, f"step {self.step}" if self.step else "", place]))
        expected = f"expected {_plain(self.right)}" if self.told else "which is not right"
        return f"{where}: {self.part}{at} is {_plain(self.given)}, {expected}"


@dataclass(frozen=True, eq=False)
class Lines:
    """The right and the given numbers, over steps or masses, for a plot of where they differ.

    Attributes:
        over: what is counted, from left to right.
        what: the numbers, with their unit.
        right, given: the numbers, each (n,).
    """

    over: str
    what: str
    right: Array
    given: Array


def first_difference(
    catalogue: AnswerCatalogue, given: Sequence[Answer], tolerance: float
) -> tuple[FirstDifference | None, Lines | None]:
    """Where the answers first differ from the right ones, and both over what is counted there.

    Args:
        tolerance: the largest difference that counts as none, as a fraction of the largest number.
    """
    told = not catalogue.exercise.seeded
    rows = zip(catalogue.questions, given, catalogue.right, catalogue.scales, strict=True)
    for question, answer, right, scales in rows:
        place = _first_place(answer, right, scales, tolerance)
        if place is not None:
            s, p, index = place
            step = s + 1 if question.steps else 0
            numbers = (right[s][p][index].item(), answer[s][p][index].item())
            found = FirstDifference(question.about, step, question.parts[p], question.item, index, *numbers, told)
            return found, _lines(question, answer, right, p, index) if told else None
    return None, None


def _first_place(
    answer: Answer, right: Answer, scales: Sequence[float], tolerance: float
) -> tuple[int, int, tuple[int, ...]] | None:
    """Step, part and index of the first difference; parts of another shape have none."""
    for s, (step, expected) in enumerate(zip(answer, right, strict=False)):
        for p, (part, want, scale) in enumerate(zip(step, expected, scales, strict=True)):
            if part.shape == want.shape and part_distance(part, want, scale) > tolerance:
                return s, p, _first_index(part, want, scale * tolerance)
    return None


def _first_index(part: Array, want: Array, tolerance: float) -> tuple[int, ...]:
    if part.dtype.kind == "U" or want.dtype.kind == "U":
        differ = np.asarray(part != want)
    else:
        differ = ~(np.abs(part.astype(float) - want.astype(float)) <= tolerance)
    return tuple(int(i) for i in np.argwhere(differ)[0])


def _lines(question: Question, answer: Answer, right: Answer, p: int, index: tuple[int, ...]) -> Lines | None:
    want = right[0][p]
    if want.dtype.kind == "U" or (not question.steps and want.ndim == 0) or question.item == "between mass":
        return None
    name, axis = question.parts[p], index[1:]
    unit = f" [{question.units[p]}]" if question.units else ""
    if question.steps:
        place = f"[{', '.join(map(str, index))}]" if index else ""
        alike = list(takewhile(lambda step: step[p].shape == want.shape, answer))  # what has another shape has no place
        both = [[float(step[p][index]) for step in steps] for steps in (right, alike)]
        return Lines("step", name + place + unit, np.array(both[0]), np.array(both[1]))
    rows = [np.array([row[axis] for row in step[p]], dtype=float) for (step,) in (right, answer)]
    return Lines(question.item, name + (f"[:, {axis[0]}]" if axis else "") + unit, *rows)


def _plain(value: Any) -> str:
    return f"{value:.9g}" if isinstance(value, float) else repr(value)
