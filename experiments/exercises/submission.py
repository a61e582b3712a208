"""A student's file: its text, and which exercise it says it is of. It is read, never imported."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from experiments.exercises.exercise import Exercise, find
from reference.errors import InputError

#: A file larger than this is not a submission [bytes].
LARGEST = 2**20

#: The lines of a starter that say whose it is.
EXERCISE = re.compile(r"^EXERCISE *= *(\d+) *$", re.MULTILINE)
SEED = re.compile(r"^SEED *= *[\"']([^\"'\\\n]{1,100})[\"'] *$", re.MULTILINE)
KEYED = re.compile(r"^KEYED *= *True *$", re.MULTILINE)


@dataclass(frozen=True, eq=False)
class Submission:
    """One file.

    Attributes:
        name: how it is called in tables.
        seed: the student's, "" where the exercise has none.
        says_keyed: whether it says that it was started with a key: a reminder to students, who cannot check it then.
        keyed: whether its answers depend on the teacher's key: that is for the teacher to say.
    """

    name: str
    source: str
    exercise: Exercise
    seed: str = ""
    says_keyed: bool = False
    keyed: bool = True

    def seed_with(self, key: str | None) -> str:
        """The seed that its questions are made from."""
        return f"{self.seed}\0{(key or '') if self.keyed else ''}" if self.exercise.keyed else self.seed

    def digest(self, key: str | None) -> str:
        """Of all that its grade depends on, but for springlab itself."""
        return hashlib.sha256(f"{self.exercise.name}\0{key}\0{self.keyed}\0{self.source}".encode()).hexdigest()[:16]


def read(path: Path, name: str, exercise: Exercise | None = None, keyed: bool = True) -> Submission:
    """The submission in a file.

    Args:
        keyed: whether it was handed out with the teacher's key.
        exercise: which it is of; left out, the one its line EXERCISE says.

    Raises:
        InputError: for a file that is not a submission, by name.
    """
    if path.is_symlink() or not path.is_file():
        raise InputError(f"{name}: expected a file")
    if path.stat().st_size > LARGEST:
        raise InputError(f"{name} has {path.stat().st_size} bytes: expected at most {LARGEST}")
    try:
        source = path.read_bytes().decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError:
        raise InputError(f"{name}: expected text in UTF-8") from None
    if "\0" in source:
        raise InputError(f"{name}: expected text, it has a zero byte")
    says = EXERCISE.search(source)
    if exercise is None and says is None:
        raise InputError(f"{name} does not say of which exercise it is: expected a line such as EXERCISE = 4")
    exercise = exercise or find(says[1] if says else "")
    seed = SEED.search(source)
    if exercise.seeded and seed is None:
        raise InputError(f'{name} has no seed: expected the starter\'s line, such as SEED = "example"')
    return Submission(
        name, source, exercise, seed[1] if exercise.seeded and seed else "", bool(KEYED.search(source)), keyed
    )


def files_of(paths: Sequence[Path]) -> list[tuple[Path, str]]:
    """The Python files that are meant, each with its name: files themselves, and all in folders and below.

    Raises:
        InputError: for a path where nothing is, or a folder with no such file.
    """
    found: list[tuple[Path, str]] = []
    for path in paths:
        if path.is_dir():
            inside = sorted(
                p for p in path.rglob("*.[pP][yY]") if not any(q.startswith(".") for q in p.relative_to(path).parts)
            )
            if not inside:
                raise InputError(f"{path}: expected Python files in it")
            found += [(p, str(p.relative_to(path))) for p in inside]
        elif path.exists():
            found.append((path, path.name))
        else:
            raise InputError(f"{path}: expected a file or a folder")
    return found
