"""The search for the smallest changes of a submission's own text that make it right, in the submission's process.

Every change of `source_edits` is tried by itself, then pairs: of those that come nearest, each with all others. What it
takes is processor time, of which there is a limit; a program that loops for ever is stopped by counting. Imports
NumPy and what stands beside it.
"""

from __future__ import annotations

import ast
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from typing import Any

import numpy as np

from experiments.exercises.process.returned import parts_of
from experiments.exercises.repair.source_edits import Edit, edits_of, without_main

#: A question, with its right answer; see `Search`.
Question = Mapping[str, Any]

#: How near a program comes: questions that it answers rightly, and the share of right numbers.
Nearness = tuple[int, float]

#: How often loops may go round in one call, all together.
MOST_ROUNDS = 20_000

#: How many single changes are gone on from in pairs; how many repairs are enough; how much dearer than the cheapest
#: repair a change may be that is still tried.
STEMS, ENOUGH, DEARER = 12, 12, 0.5


class TooLongError(BaseException):
    """A loop goes round too often."""


class _Counter(ast.NodeTransformer):
    """Counts the rounds of loops that may not end."""

    def visit_While(self, node: ast.While) -> ast.While:
        self.generic_visit(node)
        tick = ast.Expr(ast.Call(ast.Name("__tick__", ast.Load()), [], []))
        node.body = [ast.fix_missing_locations(ast.copy_location(tick, node)), *node.body]
        return node


class Search:
    """One submission, and the questions with their right answers."""

    def __init__(
        self,
        source: str,
        questions: Sequence[Question],
        fresh: Callable[[Any], Any],
        changed: Callable[..., bool],
    ) -> None:
        """Questions have function, arguments, parts, steps; of the right answer right, scales, tolerance, pairs."""
        self.tree = _Counter().visit(without_main(ast.parse(source)))
        self.edits = edits_of(self.tree, fields_given(questions))
        self._questions = list(questions)
        self._fresh, self._changed = fresh, changed
        self._rounds = 0
        self.tried = 0

    def _tick(self) -> None:
        self._rounds += 1
        if self._rounds > MOST_ROUNDS:
            raise TooLongError

    def _module(self) -> dict[str, Any] | None:
        """The program as its tree is now; None where it cannot be read."""
        names: dict[str, Any] = {"__name__": "submission", "__tick__": self._tick, "__file__": "submission.py"}
        self._rounds = 0
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                code = compile(self.tree, "<submission>", "exec")
            exec(code, names)
        except (Exception, TooLongError, SystemExit):
            return None
        return names

    def nearness(self, names: Mapping[str, Any], questions: Sequence[Question], steps: int) -> tuple[int, float]:
        """How many questions are answered rightly, and the share of right numbers in the others."""
        right, share = 0, 0.0
        for question in questions:
            part = self._share(names, question, steps)
            right += part >= 1.0
            share += part
        return right, share

    def _share(self, names: Mapping[str, Any], question: Mapping[str, Any], steps: int) -> float:
        """The share of right numbers in an answer; 1 where all are, and nothing was changed beside."""
        self._rounds = 0
        arguments = first = question["arguments"]
        found: list[float] = []
        try:
            function = names[question["function"]]
            for _ in range(max(1, min(steps, question["steps"]))):
                given = [self._fresh(a) for a in arguments]
                values = parts_of(function(*given), question["parts"])
                if any(self._changed(g, a) for g, a in zip(given, arguments, strict=True)):
                    return 0.5 * _right_share(values, question, 0)
                found.append(_right_share(values, question, len(found)))
                if found[-1] < 1.0:
                    break
                if question["steps"]:
                    fed = [v if np.ndim(a) else v.item() for v, a in zip(values, arguments, strict=False)]
                    arguments = [*fed, *first[len(fed) :]]
        except (Exception, TooLongError, SystemExit):
            return 0.0
        return min(found)

    def _is_right(self) -> bool:
        """Whether all questions are answered rightly, all steps, twice over in a fresh module."""
        names = self._module()
        if names is None:
            return False
        return all(self._share(names, q, 10**6) >= 1.0 for q in self._questions) and all(
            self._share(names, q, 1) >= 1.0 for q in self._questions[:2]
        )

    def run(self, seconds: float, pair_seconds: float) -> dict[str, Any]:
        """Search until the time is used up; what was found, by numbers of edits, and whether all was tried."""
        names = self._module()
        begin = time.process_time()
        wrong = [q for q in self._questions if names is None or self._share(names, q, 10**6) < 1.0]
        if not wrong:
            return {"repairs": [], "tried": 0, "singles_done": True, "pairs_done": True}
        asked = wrong[:3]
        base = self.nearness(names, asked, 1) if names is not None else (0, 0.0)
        singles: list[list[int]] = []
        stems: list[tuple[Nearness, int]] = []
        done = True
        for i, edit in enumerate(self.edits):
            if len(singles) >= ENOUGH or (singles and edit.cost > self.edits[singles[0][0]].cost + DEARER):
                break
            if time.process_time() - begin > seconds:
                done = False
                break
            near = self._try([edit], asked)
            if near is not None and near[0] == len(asked) and self._holds([edit]):
                singles.append([i])
            elif near is not None and near > base:
                stems.append((near, i))
        if singles or pair_seconds <= 0:
            return {"repairs": singles, "tried": self.tried, "singles_done": done, "pairs_done": False}
        pairs, all_tried = self._pairs(stems, asked, pair_seconds)
        return {"repairs": pairs, "tried": self.tried, "singles_done": done, "pairs_done": all_tried}

    def _pairs(
        self, stems: list[tuple[Nearness, int]], asked: Sequence[Question], seconds: float
    ) -> tuple[list[list[int]], bool]:
        """Of the single changes that come nearest, each with all others."""
        begin = time.process_time()
        found: list[list[int]] = []
        for _, i in sorted(stems, key=lambda stem: (-stem[0][0], -stem[0][1], stem[1]))[:STEMS]:
            for j, other in enumerate(self.edits):
                if time.process_time() - begin > seconds:
                    return found, False
                near = self._try([self.edits[i], other], asked) if i != j else None
                if near is not None and near[0] == len(asked) and self._holds([self.edits[i], other]):
                    found.append([i, j])
                    if len(found) >= 3:
                        return found, False
        return found, True

    def _try(self, edits: Sequence[Edit], asked: Sequence[Question]) -> Nearness | None:
        """How near the program comes with these changes, by first steps; None where it cannot be read."""
        self.tried += 1
        with _all_applied(edits):
            names = self._module()
            return None if names is None else self.nearness(names, asked, 1)

    def _holds(self, edits: Sequence[Edit]) -> bool:
        with _all_applied(edits):
            return self._is_right()


def fields_given(questions: Sequence[Question]) -> dict[str, list[str]]:
    """Of each function the fields of its last argument."""
    return {
        question["function"]: list(question["arguments"][-1])
        for question in questions
        if question["arguments"] and isinstance(question["arguments"][-1], Mapping)
    }


def _all_applied(edits: Sequence[Edit]) -> ExitStack:
    stack = ExitStack()
    for edit in edits:
        stack.enter_context(edit.applied())
    return stack


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
    """What `Search.run` finds for each group of questions; nothing where the text cannot be read or is too deep.

    Args:
        task: source; seconds and pair_seconds, for all groups together; groups, each a list of questions.
    """
    share = max(1, len(task["groups"]))
    try:
        return [
            Search(task["source"], group, fresh, changed).run(task["seconds"] / share, task["pair_seconds"] / share)
            for group in task["groups"]
        ]
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
