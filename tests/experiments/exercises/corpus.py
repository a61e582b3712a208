"""Programs as students write them, right and wrong: `students/`, where a mistake is a change of a program's text."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from experiments.exercises.exercise import find
from experiments.exercises.handed_in.submission import Submission

STUDENTS = Path(__file__).parent / "students"

#: Each mistake is made in each of these.
STYLES = ("loops", "arrays", "classes")

#: What right programs are called; and by their style, those that are right to fewer digits.
RIGHT, OTHERWISE = "right", {"single_precision": "fewer_digits"}


@dataclass(frozen=True)
class Program:
    """One program.

    Attributes:
        exercise: its number.
        style: that of the right program that it is, or that it was made of.
        name: what the checker is to call it.
        also: what is just as true in this style.
        words: the student's mistake, in the words of who wrote it.
    """

    exercise: int
    style: str
    name: str
    words: str
    text: str
    also: tuple[str, ...] = ()

    def is_called(self, name: str) -> bool:
        """Whether that name is true."""
        return name == self.name or name in self.also

    @property
    def submission(self) -> Submission:
        """As it is handed in."""
        exercise = find(str(self.exercise))
        return Submission(self.style, self.text, exercise, "example" if exercise.seeded else "", keyed=False)


@cache
def programs() -> tuple[Program, ...]:
    """All there are, those of one exercise together, those that are right first."""
    return tuple(program for folder in sorted(STUDENTS.glob("e[0-9][0-9]_*")) for program in _of_one(folder))


def _of_one(folder: Path) -> Iterator[Program]:
    number = int(folder.name[1:3])
    right = {file.stem: file.read_text(encoding="utf-8") for file in sorted(folder.glob("*.py"))}
    for style, text in right.items():
        yield Program(number, style, OTHERWISE.get(style, RIGHT), "", text)
    for mistake in tomllib.loads((folder / "mistakes.toml").read_text(encoding="utf-8"))["mistake"]:
        for style in STYLES:
            if style in mistake:
                also = tuple(mistake.get("also", {}).get(style, ()))
                text = _changed(right, style, mistake)
                yield Program(number, style, mistake["name"], mistake.get("is", ""), text, also)


def _changed(right: dict[str, str], style: str, mistake: dict[str, Any]) -> str:
    text = right[style]
    for old, new in mistake[style]:
        assert old in text, f"{style}, {mistake['name']}: {old!r} is not there"
        text = text.replace(old, new)
    return text


def solution(style: str, exercise: int = 4) -> str:
    """A right program."""
    return wrong(style, RIGHT, exercise)


def wrong(style: str, mistake: str, exercise: int = 4) -> str:
    """One with a mistake."""
    return next(p.text for p in programs() if (p.exercise, p.style, p.name) == (exercise, style, mistake))
