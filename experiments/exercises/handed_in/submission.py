"""A student's file: its text, and which exercise it says it is of. It is read, never imported."""

from __future__ import annotations

import ast
import codecs
import hashlib
import re
import tokenize
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Literal

from experiments.exercises.exercise import Exercise, find
from experiments.exercises.handed_in.notebook import program_in
from experiments.exercises.handed_in.parsing import parsed
from reference.errors import InputError

#: A file larger than this is not a submission [bytes].
LARGEST = 2**20

#: Encodings that begin with a byte order mark, longest mark first.
MARKS = {codecs.BOM_UTF8: "utf-8-sig", codecs.BOM_UTF16_LE: "utf-16", codecs.BOM_UTF16_BE: "utf-16"}

#: A line of Python, one of the first two, that says in which encoding the file is (PEP 263).
SAYS_ITS_ENCODING = re.compile(rb"^[ \t\f]*#.*?coding[:=]")

#: What programs and notebooks are called.
NOTEBOOK, IN_C = ".ipynb", (".c", ".cpp", ".cc", ".cxx")
SUFFIXES = (".py", NOTEBOOK, *IN_C)

#: What else may hold a program, where a file is named by itself.
PLAIN = ("", ".txt")

#: What they are written in.
Language = Literal["python", "c"]

#: The names that say whose a file is.
HEADER = ("EXERCISE", "SEED", "KEYED")

#: A seed is no longer than that.
LONGEST_SEED = 100


@dataclass(frozen=True, eq=False)
class Submission:
    """One file.

    Attributes:
        name: how it is called in tables.
        seed: the student's, "" where the exercise has none.
        says_keyed: whether it says that it was started with a key: a reminder to students, who cannot check it then.
        keyed: whether its answers depend on the teacher's key: that is for the teacher to say.
        language: what it is written in.
    """

    name: str
    source: str
    exercise: Exercise
    seed: str = ""
    says_keyed: bool = False
    keyed: bool = True
    language: Language = "python"

    def seed_with(self, key: str | None) -> str:
        """The seed that its questions are made from."""
        return f"{self.seed}\0{(key or '') if self.keyed else ''}" if self.exercise.keyed else self.seed

    def digest(self, key: str | None) -> str:
        """Of all that its grade depends on, but for springlab itself."""
        return hashlib.sha256(
            f"{self.exercise.name}\0{key}\0{self.keyed}\0{self.language}\0{self.source}".encode()
        ).hexdigest()[:16]


def read(path: Path, name: str, exercise: Exercise | None = None, keyed: bool = True) -> Submission:
    """The submission in a file.

    Args:
        keyed: whether it was handed out with the teacher's key.
        exercise: which it is of; left out, the one its line EXERCISE says.

    Raises:
        InputError: for a file that is not a submission, by name.
    """
    source = source_of(path, name)
    in_c = path.suffix.lower() in IN_C
    says = header_in_c(source) if in_c else header(source)
    if exercise is None and says.get("EXERCISE") is None:
        line = "#define EXERCISE 4" if in_c else "EXERCISE = 4"
        raise InputError(f"{name} does not say of which exercise it is: expected a line such as {line}")
    exercise = exercise or find(str(says["EXERCISE"]))
    if in_c and exercise.starter_in_c is None:
        raise InputError(f"{name}: exercise {exercise.number} cannot be done in C: expected {exercise.name}.py")
    seed = str(says.get("SEED") or "").strip()
    if exercise.seeded and not (seed.isprintable() and 0 < len(seed) <= LONGEST_SEED):
        raise InputError(f'{name} has no seed: expected the starter\'s line, such as SEED = "example"')
    seed = seed if exercise.seeded else ""
    language: Language = "c" if in_c else "python"
    return Submission(name, source, exercise, seed, says.get("KEYED") is True, keyed, language)


def source_of(path: Path, name: str) -> str:
    """The text of a program, or that of a notebook's code cells. Raises InputError where there is none."""
    if path.suffix.lower() == ".zip":
        raise InputError(f"{name}: expected a Python or C file or a notebook, or a zip of such that can be read")
    if path.suffix.lower() not in (*SUFFIXES, *PLAIN):
        raise InputError(f"{name} is no program: expected a Python or C file, or a notebook")
    if path.is_symlink() or not path.is_file():
        raise InputError(f"{name}: expected a file")
    if path.stat().st_size > LARGEST:
        raise InputError(f"{name} has {path.stat().st_size} bytes: expected at most {LARGEST}")
    text = decoded(path.read_bytes(), name)
    if path.suffix.lower() != NOTEBOOK:
        return text
    try:
        return program_in(text)
    except ValueError as error:
        raise InputError(f"{name}: expected a notebook: {error}") from None


def decoded(data: bytes, name: str) -> str:
    """A file's text, its lines ended by newlines: in UTF-8, in UTF-16 with its mark, or as its first lines say.

    What is none of these and says nothing is taken for Latin-1: what it can mistake stands in comments and in words.

    Raises:
        InputError: where it is not text, or not in the encoding that it says.
    """
    marked = next((encoding for mark, encoding in MARKS.items() if data.startswith(mark)), None)
    try:
        source = data.decode(marked or tokenize.detect_encoding(BytesIO(data).readline)[0])
    except (UnicodeDecodeError, SyntaxError, LookupError):
        if marked or any(map(SAYS_ITS_ENCODING.match, data.splitlines()[:2])):
            raise InputError(f"{name}: expected text in UTF-8: save it anew, with that encoding") from None
        if any(letter < 32 and letter not in b"\t\n\v\f\r\x1a" for letter in data):
            raise InputError(f"{name}: expected text, it has control characters") from None
        source = data.decode("latin-1")
    if "\0" in source:
        raise InputError(f"{name}: expected text, it has a zero byte")
    return source.replace("\r\n", "\n").replace("\r", "\n")


def header(source: str) -> dict[str, object]:
    r"""What the lines EXERCISE, SEED and KEYED of a file say, whatever stands around them; the last of each counts.

    Where Python cannot read the file, each line is read by itself.

    >>> header('import os; EXERCISE: int = 4  # the whole state')
    {'EXERCISE': 4}
    >>> header('def step(:\nSEED = "ada"')
    {'SEED': 'ada'}
    """
    try:
        trees = [parsed(source)]
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        trees = list(_lines_by_themselves(source))
    found: dict[str, object] = {}
    for statement in (statement for tree in trees for statement in tree.body):
        targets = statement.targets if isinstance(statement, ast.Assign) else [getattr(statement, "target", None)]
        value = getattr(statement, "value", None)
        for target in targets:
            if isinstance(target, ast.Name) and target.id in HEADER and isinstance(value, ast.Constant):
                found[target.id] = value.value
    return found


def header_in_c(source: str) -> dict[str, object]:
    """What the line EXERCISE of a C file says; the last one counts.

    >>> header_in_c("#define EXERCISE 4  // the whole state")
    {'EXERCISE': 4}
    """
    found = re.findall(r"^[ \t]*#[ \t]*define[ \t]+EXERCISE[ \t]+\(?(\d+)", source, re.MULTILINE)
    return {"EXERCISE": int(found[-1])} if found else {}


def _lines_by_themselves(source: str) -> Iterator[ast.Module]:
    for line in source.splitlines():
        if line.startswith(HEADER):
            with suppress(SyntaxError, ValueError, RecursionError, MemoryError):
                yield parsed(line)


def files_of(paths: Sequence[Path]) -> list[tuple[Path, str]]:
    """The programs and notebooks that are meant, each with its name: files themselves, and all in folders and below.

    Raises:
        InputError: for a path where nothing is, or a folder with no such file.
    """
    found: list[tuple[Path, str]] = []
    for path in paths:
        if path.is_dir():
            inside = sorted(
                p
                for p in path.rglob("*")
                if p.suffix.lower() in SUFFIXES and not any(q.startswith(".") for q in p.relative_to(path).parts)
            )
            if not inside:
                raise InputError(f"{path}: expected Python or C files, or notebooks, in it")
            found += [(p, str(p.relative_to(path))) for p in inside]
        elif path.exists():
            found.append((path, path.name))
        else:
            raise InputError(f"{path}: expected a file or a folder")
    return found
