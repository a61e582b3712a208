"""The search for the smallest changes of a submission's own text that make it right, in the submission's process.

Every change of `source_edits` is tried by itself, then pairs: of those that come nearest, each with all others. What it
takes is processor time, of which there is a limit; a program that loops for ever is stopped by counting. The search
is one for both languages: programs in Python are changed as trees (`program`), those in C have been compiled with all
their changes, which are switched on (`c.switched`). Imports NumPy and what stands beside it.
"""

from __future__ import annotations

import ast
import time
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import AbstractContextManager
from typing import Any, NamedTuple, Protocol

import numpy as np

from experiments.exercises.process.returned import parts_of
from experiments.exercises.repair.program import FAILS, Program
from experiments.exercises.repair.source_edits import edits_of, without_main

#: A question, with its right answer; see `Search`.
Question = Mapping[str, Any]


class Nearness(NamedTuple):
    """How near a program comes: questions that it answers rightly, and the shares of right numbers of all."""

    right: int
    share: float


#: How many single changes are gone on from in pairs; how many repairs are enough; how much dearer than the cheapest
#: repair a change may be that is still tried.
STEMS, ENOUGH, DEARER = 12, 12, 0.3


class Change(Protocol):
    """One change of a text."""

    @property
    def cost(self) -> float:
        """How far from the text it is."""


class Changeable(Protocol):
    """A program that can be run with any of its changes."""

    def anew(self) -> Mapping[str, Any] | None:
        """The names of a module of its own; None where it cannot be read."""

    def begin_call(self) -> None:
        """A function is about to be called."""

    def reached(self) -> AbstractContextManager[Collection[int]]:
        """What of it is run meanwhile."""

    def can_matter(self, edit: Any, reached: Collection[int]) -> bool:
        """Whether a change can make a difference where this is what is run."""

    def changed(self, edits: Sequence[Any]) -> AbstractContextManager[Mapping[str, Any] | None]:
        """The names of the module with these changes, for a while; None where it cannot be read."""

    def changed_anew(self, edits: Sequence[Any]) -> AbstractContextManager[Mapping[str, Any] | None]:
        """The same of a module of its own."""


class Search:
    """One submission, and the questions with their right answers."""

    def __init__(
        self,
        edits: Sequence[Change],
        program: Changeable,
        questions: Sequence[Question],
        fresh: Callable[[Any], Any],
        changed: Callable[..., bool],
    ) -> None:
        """Questions have function, arguments, parts, steps; of the right answer right, scales, tolerance, pairs."""
        self.edits = edits
        self._program = program
        self._questions = list(questions)
        self._fresh, self._changed = fresh, changed
        self.tried = 0
        self._least = 0.0
        self._mattering: list[int] = []

    def _share(self, names: Mapping[str, Any], question: Question, whole: bool = False) -> float:
        """The share of right numbers in an answer; 1 where all are, and nothing was changed beside.

        Args:
            whole: whether all steps are asked for; else the first.
        """
        self._program.begin_call()
        arguments = first = question["arguments"]
        try:
            function = names[question["function"]]
            for step in range(question["steps"] or 1 if whole else 1):
                given = [self._fresh(a) for a in arguments]
                values = parts_of(function(*given), question["parts"])
                share = _right_share(values, question, step)
                if share < 1.0:
                    return share
                if any(self._changed(g, a) for g, a in zip(given, arguments, strict=True)):
                    return 0.5
                if question["steps"]:
                    fed = [v if np.ndim(a) else v.item() for v, a in zip(values, arguments, strict=False)]
                    arguments = [*fed, *first[len(fed) :]]
        except FAILS:
            return 0.0
        return 1.0

    def nearness(self, names: Mapping[str, Any], asked: Sequence[Question], least: float = 0.0) -> Nearness | None:
        """How near first steps are; None if the first answer is farther off than that of the text as it is."""
        shares: list[float] = []
        for question in asked:
            share = self._share(names, question)
            if not shares and share < least:
                return None
            shares.append(share)
        return Nearness(sum(share >= 1.0 for share in shares), sum(shares))

    def _is_right(self, names: Mapping[str, Any] | None) -> bool:
        """Whether all questions are answered rightly, all steps, twice over in a fresh module."""
        if names is None:
            return False
        asked = [(question, True) for question in self._questions]
        again = [(question, False) for question in self._questions[:2]]
        return all(self._share(names, question, whole) >= 1.0 for question, whole in [*asked, *again])

    def run(self, seconds: float, pair_seconds: float) -> dict[str, Any]:
        """Search until the time is used up; what was found, by numbers of edits, and whether all was tried."""
        names = self._program.anew()
        begin = time.process_time()
        with self._program.reached() as reached:
            wrong = [q for q in self._questions if names is None or self._share(names, q, True) < 1.0]
        if not wrong:
            return {"repairs": [], "tried": 0, "singles_done": True, "pairs_done": True}
        asked = _few_of(wrong)
        base = self.nearness(names, asked) if names is not None else None
        self._least = self._share(names, asked[0]) - 1e-12 if names is not None else 0.0
        self._mattering = [i for i, e in enumerate(self.edits) if names is None or self._program.can_matter(e, reached)]
        singles: list[int] = []
        stems: list[tuple[Nearness, int]] = []
        done = True
        for i in self._mattering:
            edit = self.edits[i]
            if len(singles) >= ENOUGH or (singles and edit.cost > self.edits[singles[0]].cost + DEARER):
                break
            if time.process_time() - begin > seconds:
                done = False
                break
            near = self._try([edit], asked)
            if near is not None and near.right == len(asked) and self._holds([edit]):
                singles.append(i)
            elif near is not None and (base is None or near > base):
                stems.append((near, i))
        if singles or pair_seconds <= 0:
            return {"repairs": [[i] for i in singles], "tried": self.tried, "singles_done": done, "pairs_done": False}
        pairs, all_tried = self._pairs(stems, asked, pair_seconds)
        return {"repairs": pairs, "tried": self.tried, "singles_done": done, "pairs_done": all_tried}

    def _pairs(
        self, stems: list[tuple[Nearness, int]], asked: Sequence[Question], seconds: float
    ) -> tuple[list[list[int]], bool]:
        """Of the single changes that come nearest, each with all others."""
        begin = time.process_time()
        found: list[list[int]] = []
        for _, i in sorted(stems, key=lambda stem: (-stem[0].right, -stem[0].share, stem[1]))[:STEMS]:
            for j in self._mattering:
                if time.process_time() - begin > seconds:
                    return found, False
                both = [self.edits[i], self.edits[j]]
                near = self._try(both, asked) if i != j else None
                if near is not None and near.right == len(asked) and self._holds(both):
                    found.append([i, j])
                    if len(found) >= 3:
                        return found, False
        return found, True

    def _try(self, edits: Sequence[Change], asked: Sequence[Question]) -> Nearness | None:
        """How near the program comes with these changes, by first steps; None where it cannot be read."""
        self.tried += 1
        with self._program.changed(edits) as names:
            return None if names is None else self.nearness(names, asked, self._least)

    def _holds(self, edits: Sequence[Change]) -> bool:
        with self._program.changed_anew(edits) as names:
            return self._is_right(names)


def fields_given(questions: Sequence[Question]) -> dict[str, list[str]]:
    """Of each function the fields of its last argument."""
    return {
        question["function"]: list(question["arguments"][-1])
        for question in questions
        if question["arguments"] and isinstance(question["arguments"][-1], Mapping)
    }


def _few_of(questions: Sequence[Question]) -> list[Question]:
    """The smallest, one of the middle and the largest: a change is tried on these first, the quickest before all."""
    in_order = sorted(questions, key=_size)
    return [in_order[i] for i in sorted({0, len(questions) // 2, len(questions) - 1})]


def _size(question: Question) -> int:
    """How many numbers a question has: of those with fewer an answer comes sooner."""
    fields = [v for a in question["arguments"] for v in (a.values() if isinstance(a, Mapping) else [a])]
    return int(sum(np.size(value) for value in fields))


def _right_share(values: Sequence[Any], question: Mapping[str, Any], step: int) -> float:
    """Of the numbers of one step, the share that is right; less than 1 unless all are."""
    right, total = 0.0, 0
    for value, want, scale in zip(values, question["right"][step], question["scales"], strict=True):
        if question["pairs"]:
            value, want = _sorted_pairs(value), _sorted_pairs(want)
        if want.shape == () and value.size == 1:
            value = value.reshape(())
        total += max(1, want.size)
        if value.shape != want.shape or value.dtype.kind == "U":
            continue
        error = np.abs(value.astype(float) - want.astype(float)) / scale
        near = error <= question["tolerance"]
        # one that is wrong counts for less, the more the farther away it is
        digits = np.clip(-np.log10(np.where(error > 0, error, 1e-300)), 0.0, 7.0)
        right += float(np.where(near, 1.0, digits / 8.0).sum()) + (want.size == 0)
    return 1.0 if right >= total else right / total


def _sorted_pairs(pairs: Any) -> Any:
    """Pairs whose order does not matter, in one order."""
    if pairs.ndim == 2 and pairs.shape[0] == 2 != pairs.shape[1]:
        pairs = pairs.T
    if pairs.size == 0 or pairs.ndim != 2 or pairs.shape[1] != 2:
        return np.zeros((0, 2)) if pairs.size == 0 else pairs
    ends = np.sort(pairs, axis=1)
    return ends[np.lexsort(ends.T)]


def search(task: Mapping[str, Any], fresh: Callable[[Any], Any], changed: Callable[..., bool]) -> list[dict[str, Any]]:
    """What `search_groups` finds; nothing where the text cannot be read or is too deep.

    Args:
        task: source; seconds, pair_seconds and groups.
    """

    def begun(group: Sequence[Question]) -> tuple[Sequence[Change], Changeable]:
        tree = without_main(ast.parse(task["source"]))
        return edits_of(tree, fields_given(group)), Program(tree)

    try:
        return search_groups(task, begun, fresh, changed)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []


def search_groups(
    task: Mapping[str, Any],
    begun: Callable[[Sequence[Question]], tuple[Sequence[Change], Changeable]],
    fresh: Callable[[Any], Any],
    changed: Callable[..., bool],
) -> list[dict[str, Any]]:
    """What `Search.run` finds for each group of questions.

    Args:
        task: seconds and pair_seconds, for all groups together; groups, each a list of questions.
        begun: makes the changes of a program, and the program, for a group.
    """
    share = max(1, len(task["groups"]))
    return [
        Search(*begun(group), group, fresh, changed).run(task["seconds"] / share, task["pair_seconds"] / share)
        for group in task["groups"]
    ]
