"""A C program that has been compiled with all its small changes (`variants`), each of which can be switched on.

Used in the process of a submission, which finds NumPy and nothing else of the project.
"""

from __future__ import annotations

import _ctypes
import ctypes
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from experiments.exercises.c.calls import functions_of
from experiments.exercises.process.returned import parts_of
from experiments.exercises.repair.source_search import Question, search_groups


@dataclass(frozen=True)
class Switched:
    """A change: what it costs, and the places and numbers of what is switched on."""

    cost: float
    switches: Sequence[tuple[int, int]]


class SwitchedProgram:
    """A library in which changes are switched on."""

    def __init__(self, path: str, exercise: int, places: int) -> None:
        self._path, self._exercise, self._places = path, exercise, places
        self._on: dict[int, int] = {}
        self._load()

    def _load(self) -> None:
        library = ctypes.CDLL(self._path)
        self._library = library
        self._at = (ctypes.c_int * self._places).in_dll(library, "springlab_at")
        self._reached = (ctypes.c_char * self._places).in_dll(library, "springlab_reached")
        self._rounds = ctypes.c_int.in_dll(library, "springlab_rounds")
        self._taken = ctypes.c_size_t.in_dll(library, "springlab_taken")
        self._names = functions_of(library, self._exercise, [])

    def anew(self) -> Mapping[str, Any]:
        """Loaded anew, so that it remembers nothing, with the changes that are switched on."""
        _ctypes.dlclose(self._library._handle)
        self._load()
        self._switch()
        return self._names

    def _switch(self) -> None:
        """These changes and no others, whatever a program that ran wild has written there."""
        ctypes.memset(self._at, 0, ctypes.sizeof(self._at))
        for place, number in self._on.items():
            self._at[place] = number

    def begin_call(self) -> None:
        """Rounds of loops are counted from 0, and memory is given back."""
        self._rounds.value = self._taken.value = 0

    @contextmanager
    def reached(self) -> Iterator[Collection[int]]:
        """The places that are come to meanwhile."""
        found: set[int] = set()
        ctypes.memset(self._reached, 0, self._places)
        yield found
        found.update(place for place, was in enumerate(self._reached.raw) if was)

    def can_matter(self, edit: Switched, reached: Collection[int]) -> bool:
        """Whether one of its places is come to."""
        return any(place in reached for place, _ in edit.switches)

    @contextmanager
    def changed(self, edits: Sequence[Switched]) -> Iterator[Mapping[str, Any] | None]:
        """The functions with these changes, for a while; None where two are at one place."""
        on = [switch for edit in edits for switch in edit.switches]
        self._on = dict(on)
        self._switch()
        try:
            yield self._names if len(self._on) == len(on) else None
        finally:
            self._on = {}
            self._switch()

    @contextmanager
    def changed_anew(self, edits: Sequence[Switched]) -> Iterator[Mapping[str, Any] | None]:
        """The same, of the library loaded anew."""
        with self.changed(edits) as names:
            yield self.anew() if names is not None else None


def search(task: Mapping[str, Any], fresh: Callable[[Any], Any], changed: Callable[..., bool]) -> list[dict[str, Any]]:
    """What is found for each group of questions; nothing where the program with its changes is not the program.

    Args:
        task: library, variants and exercise; changes, each a cost and its switches; places; seconds, pair_seconds and
            groups; see `source_search.search_groups`.
    """
    edits = [Switched(cost, [(place, number) for place, number in on]) for cost, on in task["changes"]]
    program = SwitchedProgram(task["variants"], task["exercise"], task["places"])
    plain = functions_of(ctypes.CDLL(task["library"]), task["exercise"], [])
    questions = [question for group in task["groups"] for question in group]
    if not all(_same(plain, program, question, fresh) for question in questions):
        return []
    return search_groups(task, lambda _: (edits, program), fresh, changed)


def _same(plain: Mapping[str, Any], program: SwitchedProgram, question: Question, fresh: Callable[[Any], Any]) -> bool:
    """Whether a question is answered as by the program itself: to rounding, or by an error."""
    answers: list[list[Any] | None] = []
    for names in (plain, program.anew()):
        program.begin_call()
        try:
            returned = names[question["function"]](*map(fresh, question["arguments"]))
            answers.append(parts_of(returned, question["parts"]))
        except Exception:
            answers.append(None)
    one, other = answers
    if one is None or other is None:
        return one is other
    return all(np.allclose(a, b, rtol=1e-9, atol=0.0, equal_nan=True) for a, b in zip(one, other, strict=True))
