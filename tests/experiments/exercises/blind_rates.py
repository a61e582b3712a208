"""Rates on programs of people who had only texts and starters: passed, refused, and led by which way.

Five samples, kept apart: `blind`, which the checker has been mended by since; `blind2`, written after that by somebody
who had seen some of the first one's list; `blind3`, `blind4` and `blind5`, by three who had seen texts and starters
only. Some of the last two are in C.

python -m tests.experiments.exercises.confusion --blind
"""

from __future__ import annotations

import os
import tomllib
from collections import Counter
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from experiments.exercises.exercise import find
from experiments.exercises.grading import EFFORT, Grade, grade
from experiments.exercises.handed_in.submission import Language, Submission

HERE = Path(__file__).parent


@dataclass(frozen=True)
class Program:
    """One program of a sample.

    Attributes:
        words: what it is, by who wrote it.
        lines: of its mistake, where who wrote it has said which.
        seed: of the numbers that it was written for.
    """

    file: Path
    name: str
    right: bool
    words: str
    lines: tuple[int, ...] = ()
    seed: str = "example"

    @property
    def language(self) -> Language:
        """By its ending."""
        return "c" if self.file.suffix == ".c" else "python"

    @property
    def text(self) -> str:
        """As it was handed in."""
        return self.file.read_text(encoding="utf-8")


def _samples() -> Mapping[str, list[Program]]:
    first = tomllib.loads((HERE / "blind" / "expected.toml").read_text(encoding="utf-8"))
    return {
        "blind": [
            Program(HERE / "blind" / name, name, kind == "right", words)
            for kind, entries in first.items()
            for name, words in entries.items()
        ],
        "blind2": _with_lines(HERE / "blind2"),
        "blind3": _with_lines(HERE / "blind3"),
        "blind4": _with_lines(HERE / "blind4", "ada"),
        "blind5": _with_lines(HERE / "blind5"),
    }


def _with_lines(folder: Path, seed: str = "example") -> list[Program]:
    entries = tomllib.loads((folder / "expected.toml").read_text(encoding="utf-8"))
    return [
        Program(
            folder / name, name, entry["kind"] == "right", entry.get("words", ""), tuple(entry.get("lines", ())), seed
        )
        for name, entry in entries.items()
    ]


#: The programs of each sample.
SAMPLES = _samples()


def way(given: Grade) -> str:
    """By what a wrong program was told something: the first of these that says anything."""
    outcome, verdict = given.verdict.outcome, given.verdict
    if verdict.right:
        return "passed"
    if outcome in ("mistake", "mistakes", "another scheme"):
        return "named"
    if given.closer.told:
        return "line of its text"
    if outcome in ("error", "crashed", "timed out"):
        return "error with its line"
    return "behaviour" if given.closer.findings else "place of departure only"


def way_and_line(program: Program, given: Grade) -> str:
    """The same; where the line of the mistake is known, whether it is the one that is told."""
    found, led = way(given), set(program.lines) & set(given.closer.lines)
    if found == "behaviour" and led:
        return "line of its mistake by behaviour"
    if found != "line of its text" or not program.lines:
        return found
    return "line of its mistake" if led else "another line of its text"


def rates(sample: str) -> dict[str, Counter[str]]:
    """Of right and of wrong programs of a sample, how many were told by each way; each program is printed."""

    def one(program: Program) -> Grade:
        exercise = find(str(int(program.name[1:3])))
        handed_in = Submission(
            program.name, program.text, exercise, program.seed, keyed=False, language=program.language
        )
        return grade(handed_in, "sesame", None, EFFORT)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        graded = list(pool.map(one, SAMPLES[sample]))
    found: dict[str, Counter[str]] = {"right": Counter(), "wrong": Counter()}
    for program, given in zip(SAMPLES[sample], graded, strict=True):
        kind, how = "right" if program.right else "wrong", way_and_line(program, given)
        found[kind][how] += 1
        print(f"{program.name:36} {how:24} {given.verdict.name[:40]:40} lines {given.closer.lines}")
    return found


def main() -> None:
    """Print each program, and the rates of each sample."""
    told = {sample: rates(sample) for sample in SAMPLES}
    for sample, found in told.items():
        for kind, counts in found.items():
            print(f"{sample}, {kind}: {', '.join(f'{words} {many}' for words, many in counts.most_common())}")
