"""What an exercise is: its texts, its questions, and one small function that solves it, rightly or with a mistake.

The keyword parameters of a solution have defaults that make it right. A mistake is a change of some of them, and two
mistakes that change different parameters can be made at once. So one function gives the right answer and all the wrong
ones that the checker knows by name: if the solution is `step(y, v, dt, spring, clock="dt", gravity=1.0)`, then half a
step is `{"clock": "half"}`, a weight that points upwards `{"gravity": -1.0}`, and both at once are both changes.
"""

from __future__ import annotations

import importlib.util
import inspect
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from experiments.exercises.process import child
from reference.errors import InputError, unknown_name
from reference.state import Array

#: Where exercises stand: in each of these folders, one folder each.
FOLDERS = [Path(__file__).parent]

#: How such a folder is called: its number and its name.
FOLDER_NAME = re.compile(r"e(\d\d)_([a-z_]+)")

#: Numbers are the same up to this part of the largest of their kind, unless an exercise says otherwise.
TOLERANCE = 1e-9

#: What students read below every text.
RULES = """
## What your file may use

NumPy, and Python's own modules for computing, nothing else: no files are written, no
programs started, nothing is read from the keyboard. It is checked by itself: of other
files it finds those that you were given.
"""

#: What they read in its place where they write C.
RULES_IN_C = """
## In C

Your file is a C file; `exercise.h` beside it says what your function is given. A dot in a name above is an arrow there
(`a.b` is `a->b`), and what is to be returned you write into what you are given, as `exercise.h` says of your function:
in C this stands in place of what the text says of new arrays and of leaving others as they are. It is compiled by the
system's compiler as C11 (`cc -Wall`), and what that warns of is worth reading. Your function may use C's own library
for computing, nothing else: no files are written, no programs started, nothing is read from the keyboard.
"""

#: What a question's answer is: for every step, every part of what was returned.
Answer = list[list[Array]]


@dataclass(frozen=True, eq=False)
class Question:
    """A call of a student's function, or many in a row.

    Attributes:
        function: its name.
        arguments: arrays, numbers, and dicts of them, which become namespaces.
        parts: what it returns, by name.
        about: what is asked about, in words.
        steps: 0 for one call; else how many calls, each with what the last returned in place of its first arguments.
        own: what the solution is told beside that, and the student's function is not.
        item: what the first axis of an answer counts.
        units: of the parts.
    """

    function: str
    arguments: tuple[Any, ...]
    parts: tuple[str, ...]
    about: str
    steps: int = 0
    own: Mapping[str, Any] = field(default_factory=dict)
    item: str = "mass"
    units: tuple[str, ...] = ()

    def asked(self) -> dict[str, Any]:
        """What the submission's process is told."""
        asked = {name: getattr(self, name) for name in ("function", "arguments", "parts", "steps")}
        return {**asked, "arguments": list(self.arguments), "parts": list(self.parts)}


@dataclass(frozen=True)
class Mistake:
    """A mistake that students make, or another choice than the one that was asked for.

    Attributes:
        name: how it is called in tables.
        words: what is wrong, to the student, in a sentence.
        hint: what to look at, without the answer.
        parameters: those of the solution that it changes, with their values.
        another: whether it is right in itself, and only not what was asked for.
    """

    name: str
    words: str
    hint: str
    parameters: Mapping[str, Any]
    another: bool = False


def mistake(name: str, words: str, hint: str, **parameters: object) -> Mistake:
    """A mistake, with the parameters that it changes."""
    return Mistake(name, words, hint, parameters)


def mistakes(name: str, words: str, hint: str, *ways: Mapping[str, object]) -> tuple[Mistake, ...]:
    """One mistake that is made in several ways, each with the parameters that it changes."""
    return tuple(Mistake(name, words, hint, parameters) for parameters in ways)


@dataclass(frozen=True, eq=False)
class Exercise:
    """One exercise. Its texts stand beside it: text.md, starter.py, and starter.c where it can be done in C.

    Attributes:
        title: a few words.
        minutes: how long students take.
        goals: what they learn.
        solutions: the functions that students write, solved, by name; mistakes change their keyword parameters.
        questions: makes the questions: from random numbers, for the hidden check or not, for a student's seed.
        mistakes: what the checker knows by name.
        seeded: whether every student has numbers of their own. keyed: whether these depend on the teacher's key too.
        files: makes more files for the student to work on, by name, from the student's seed and the teacher's key.
        tolerance: up to which part of the largest number an answer is right, where students type it in.
        canonical: makes answers that mean the same the same, before they are compared.
        aside: makes questions by which other schemes are told that answer all others rightly. From them nothing else
            follows: a right program may answer them in several ways.
        told_aside: those schemes.
        aside_in_c: the same for programs in C, to which no number can be given that grows.
        searched: whether small changes of a wrong program are looked for that make it right.
        diagnose: what is wrong with an answer by itself, as the name, words and hint of a finding; None where it may
            be right.
    """

    title: str
    minutes: int
    goals: str
    solutions: Mapping[str, Callable[..., Any]]
    questions: Callable[[np.random.Generator, bool, str], Sequence[Question]]
    mistakes: Sequence[Mistake]
    seeded: bool = False
    keyed: bool = False
    files: Callable[[str], Mapping[str, str]] | None = None
    tolerance: float = TOLERANCE
    canonical: Callable[[Question, Any], Any] | None = None
    diagnose: Callable[[Question, Any], tuple[str, str, str] | None] | None = None
    aside: Callable[[np.random.Generator], Sequence[Question]] | None = None
    told_aside: Sequence[Mistake] = ()
    aside_in_c: Callable[[], Sequence[Question]] = tuple
    searched: bool = True
    folder: Path = Path()

    @property
    def number(self) -> int:
        """From its folder's name."""
        return int(self.folder.name[1:3])

    @property
    def name(self) -> str:
        """From its folder's name."""
        return self.folder.name[4:]

    @property
    def text(self) -> str:
        """What students read, in Markdown."""
        return (self.folder / "text.md").read_text(encoding="utf-8") + RULES

    @property
    def text_in_c(self) -> str:
        """The same, for students who write C."""
        return (self.folder / "text.md").read_text(encoding="utf-8") + RULES_IN_C

    @property
    def starter(self) -> str:
        """What students begin with."""
        return (self.folder / "starter.py").read_text(encoding="utf-8")

    @property
    def starter_in_c(self) -> str | None:
        """The same in C; None where there is none."""
        file = self.folder / "starter.c"
        return file.read_text(encoding="utf-8") if file.exists() else None

    def answer(self, question: Question, parameters: Mapping[str, Any], steps: int | None = None) -> Answer:
        """What the solution answers, in the form in which answers are compared.

        Args:
            parameters: those that are changed; a solution takes those that it has.
            steps: how many steps at most; left out, all that are asked for.
        """
        solution = self.solutions[question.function]
        taken = {name: value for name, value in parameters.items() if _takes(solution, name)}
        arguments = list(question.arguments)
        answer: Answer = []
        with np.errstate(all="ignore"):
            for _ in range(max(1, question.steps if steps is None else min(steps, question.steps))):
                returned = solution(*map(child.fresh, arguments), **question.own, **taken)
                parts = [np.asarray(part) for part in (returned if len(question.parts) > 1 else [returned])]
                answer.append(parts)
                arguments = [*parts, *question.arguments[len(parts) :]] if question.steps else arguments
        return self.comparable(question, answer)

    def right_at_first(self, question: Question) -> list[Array]:
        """The parts of the right answer; where there are many steps, of the first."""
        (parts,) = self.answer(question, {}, 1)
        return parts

    def comparable(self, question: Question, answer: Answer) -> Answer:
        """An answer in the form in which answers are compared."""
        if self.canonical is None:
            return answer
        return [[self.canonical(question, part) for part in step] for step in answer]


@cache
def _takes(solution: Callable[..., Any], name: str) -> bool:
    accepted = inspect.signature(solution).parameters
    return name in accepted or any(p.kind is p.VAR_KEYWORD for p in accepted.values())


@cache
def _load(folder: Path) -> Exercise:
    spec = importlib.util.spec_from_file_location(f"springlab_exercise_{folder.name}", folder / "exercise.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    exercise: Exercise = module.EXERCISE
    object.__setattr__(exercise, "folder", folder)
    return exercise


def exercises() -> Mapping[int, Exercise]:
    """All exercises by number. Raises InputError where two folders have the same number or name."""
    found = [p for where in FOLDERS for p in sorted(where.iterdir()) if FOLDER_NAME.fullmatch(p.name) and p.is_dir()]
    _refuse_duplicates(found)
    return MappingProxyType({e.number: e for e in sorted(map(_load, found), key=lambda e: e.number)})


def _refuse_duplicates(folders: Iterable[Path]) -> None:
    """Nothing is overwritten in silence, as in `reference.registry`."""
    owners: dict[tuple[str, str], Path] = {}
    for folder in folders:
        for what, value in (("number", folder.name[1:3]), ("name", folder.name[4:])):
            owner = owners.setdefault((what, value), folder)
            if owner != folder:
                raise InputError(f"{folder}: exercise {what} {value} is taken by {owner}: expected another {what}")


def find(word: str) -> Exercise:
    """An exercise by its number or name. Raises InputError, with a suggestion, where there is none."""
    for exercise in exercises().values():
        if word in (str(exercise.number), exercise.name):
            return exercise
    if word.isdigit():
        raise InputError(f"exercise {word}: expected a number from 1 to {max(exercises())}")
    raise unknown_name("exercise", word, [e.name for e in exercises().values()])
