"""Rates on programs of somebody who had only texts and starters (`blind`): passed, refused, and led by which way.

python -m tests.experiments.exercises.confusion --blind
"""

from __future__ import annotations

import os
import tomllib
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from experiments.exercises.exercise import find
from experiments.exercises.grading import EFFORT, Grade, grade
from experiments.exercises.submission import Submission

BLIND = Path(__file__).parent / "blind"


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


def rates() -> dict[str, Counter[str]]:
    """Of right and of wrong programs, how many were told by each way; and each that is not as it should be."""
    expected = tomllib.loads((BLIND / "expected.toml").read_text(encoding="utf-8"))
    names = [(kind, name) for kind, entries in expected.items() for name in entries]

    def one(name: str) -> Grade:
        exercise = find(str(int(name[1:3])))
        text = (BLIND / name).read_text(encoding="utf-8")
        return grade(Submission(name, text, exercise, "example", keyed=False), "sesame", None, EFFORT)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        graded = list(pool.map(one, [name for _, name in names]))
    found: dict[str, Counter[str]] = {"right": Counter(), "wrong": Counter()}
    for (kind, name), given in zip(names, graded, strict=True):
        found[kind][way(given)] += 1
        found[kind]["with a line or a name"] += bool(given.closer.told or given.verdict.findings)
        print(f"{name:36} {way(given):24} {given.verdict.name[:40]:40} lines {given.closer.lines}")
    return found


def main() -> None:
    """Print each program, and the rates."""
    for kind, counts in rates().items():
        print(f"{kind}: {', '.join(f'{words} {many}' for words, many in counts.most_common())}")
