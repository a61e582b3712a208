"""What is known of an exercise beforehand: its questions, the right answers, and those of every mistake."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from functools import cached_property, lru_cache
from itertools import combinations
from typing import Any

import numpy as np

from experiments.exercises.exercise import Answer, Exercise, Mistake
from reference.state import Array

#: A motion that blows up is compared while it is no larger than so many times the right one: beyond, rounding is too.
LARGEST = 100.0

#: So often random numbers are drawn, until no two mistakes give the same answers.
DRAWS = 50


class Catalogue:
    """The questions of an exercise, and what the solution and every known mistake answer to them."""

    def __init__(self, exercise: Exercise, seed: str, key: str | None, draw: int = 0) -> None:
        self.exercise = exercise
        words = f"{exercise.name}\0{seed}\0{key or ''}\0{draw}"
        random = np.random.default_rng(list(hashlib.sha256(words.encode()).digest()))
        self.questions = list(exercise.questions(random, key is not None, seed))
        self._answers: dict[tuple[tuple[str, Any], ...], list[Answer]] = {}
        self._beginnings: dict[tuple[tuple[str, Any], ...], list[Answer]] = {}

    @cached_property
    def right(self) -> list[Answer]:
        """The solution's answers."""
        return self.answers({})

    def answers(self, knobs: Mapping[str, Any]) -> list[Answer]:
        """The answers of a solution with its knobs turned."""
        name = tuple(sorted(knobs.items()))
        if name not in self._answers:
            plain, answer = self.exercise.plain, self.exercise.answer
            self._answers[name] = [plain(question, answer(question, knobs)) for question in self.questions]
        return self._answers[name]

    def beginnings(self, knobs: Mapping[str, Any]) -> list[Answer]:
        """The same, their first steps only."""
        name = tuple(sorted(knobs.items()))
        if name not in self._beginnings:
            self._beginnings[name] = [self.exercise.plain(q, self.exercise.answer(q, knobs, 1)) for q in self.questions]
        return self._beginnings[name]

    @cached_property
    def scales(self) -> list[list[float]]:
        """The largest right number of each part of each question; 1 where all are zero."""
        return [
            [
                float(_largest(_stacked([step[p] for step in answer])).max(initial=0.0)) or 1.0
                for p in range(len(question.parts))
            ]
            for question, answer in zip(self.questions, self.right, strict=True)
        ]

    @cached_property
    def functions(self) -> Mapping[str, Catalogue]:
        """The same of each function by itself."""
        return {name: self._of(name) for name in dict.fromkeys(question.function for question in self.questions)}

    def _of(self, function: str) -> Catalogue:
        part = Catalogue.__new__(Catalogue)
        part.exercise, part._answers, part._beginnings = self.exercise, {}, {}
        part.questions = [question for question in self.questions if question.function == function]
        return part

    @property
    def apart(self) -> bool:
        """Whether no mistake gives the answers of another, or the right ones."""
        answers = [("", self.right), *((m.name, self.answers(m.knobs)) for m in self.exercise.mistakes)]
        return all(a == b or self.distance(x, y) > 1e-4 for (a, x), (b, y) in combinations(answers, 2))

    @cached_property
    def pairs(self) -> list[tuple[Mistake, Mistake]]:
        """Every two mistakes that can be made at once."""
        return [(a, b) for a, b in combinations(self.exercise.mistakes, 2) if not set(a.knobs) & set(b.knobs)]

    def distance(self, given: Sequence[Answer], known: Sequence[Answer], first_steps: bool = False) -> float:
        """The largest difference, as a part of the scale; infinite where shapes or numbers are missing."""
        far = 0.0
        for answer, other, scales in zip(given, known, self.scales, strict=True):
            far = max(far, answer_distance(answer[:1] if first_steps else answer, other, scales))
            if far == np.inf:
                break
        return far


@lru_cache(maxsize=64)
def catalogue(exercise: Exercise, seed: str, key: str | None) -> Catalogue:
    """The catalogue of an exercise; made once for all submissions that are asked the same.

    By chance two mistakes may be one, when the longest member of a bridge is also the stiffest: numbers are drawn anew.
    """
    for draw in range(DRAWS):
        known = Catalogue(exercise, seed if exercise.seeded else "", key, draw)
        if exercise.seeded or any(question.steps for question in known.questions) or known.apart:
            break
    return known


def answer_distance(answer: Answer, known: Answer, scales: Sequence[float]) -> float:
    """Of the answers to one question."""
    if len(answer) != len(known):
        return np.inf
    theirs = [_stacked(steps) for steps in zip(*known, strict=True)]
    # a motion that has blown up is compared no further
    beyond = [_largest(part) > LARGEST * scale for part, scale in zip(theirs, scales, strict=True)]
    blown = np.flatnonzero(np.any(beyond, axis=0)[1:])
    end = int(blown[0]) + 1 if len(blown) else len(known)
    far = 0.0
    for p, (part, scale) in enumerate(zip(theirs, scales, strict=True)):
        mine = [step[p] for step in answer[:end]]
        if any(one.shape != part.shape[1:] for one in mine):
            return np.inf
        far = max(far, _distance(_stacked(mine), part[:end], scale))
    return far


def part_distance(part: Array, right: Array, scale: float) -> float:
    """The largest difference of two arrays, as a part of the scale; infinite where shapes or kinds differ."""
    if part.shape != right.shape:
        return np.inf
    return _distance(part[None], right[None], scale)


def _stacked(steps: Sequence[Array]) -> Array:
    return np.array(steps)


def _distance(parts: Array, right: Array, scale: float) -> float:
    """The same of many steps, their first axis."""
    if (parts.dtype.kind == "U") != (right.dtype.kind == "U"):
        return np.inf
    if parts.dtype.kind == "U":
        return 0.0 if bool((parts == right).all()) else np.inf
    one, other = (array.reshape(len(array), -1).astype(float) for array in (parts, right))
    with np.errstate(all="ignore"):
        gap = np.where(np.isfinite(one) | np.isfinite(other), np.abs(one - other), 0.0).max(axis=1, initial=0.0)
    # what is larger than the scale is compared with itself
    largest = float((gap / np.maximum(scale, np.minimum(_largest(right), LARGEST * scale))).max(initial=0.0))
    return largest if np.isfinite(largest) else np.inf


def _largest(steps: Array) -> Array:
    """The largest number of each step; infinite where one is none."""
    if steps.dtype.kind == "U":
        return np.zeros(len(steps))
    size = np.abs(steps.reshape(len(steps), -1).astype(float)).max(axis=1, initial=0.0)
    return np.where(np.isfinite(size), size, np.inf)
