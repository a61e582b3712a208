"""Right programs in C with one thing changed: whether each that is wrong is named, or led to the line that was changed.

python -m tests.experiments.exercises.c.mutants [EVERY]: every so manieth of them, the 8th unless said otherwise

The changes are of the text's tokens and lines, and know nothing of what the search tries.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from experiments.exercises.exercise import find
from experiments.exercises.grading import grade
from experiments.exercises.handed_in.submission import Submission

HERE = Path(__file__).parent

#: What is written in place of an operator, a number or a name.
OTHERS = {
    "+": "-",
    "-": "+",
    "*": "/",
    "/": "*",
    "+=": "-=",
    "-=": "+=",
    "<": ">",
    ">": "<",
    "<=": "<",
    ">=": ">",
    "==": "!=",
    "&&": "||",
    "0": "1",
    "1": "0",
    "2": "3",
    "0.5": "1.0",
    "x": "v",
    "v": "x",
    "dx": "dy",
    "dy": "dx",
    "nx": "ny",
    "masses": "stiffness",
    "fmin": "fmax",
    "sqrt": "fabs",
    "continue": "break",
}
TOKEN = re.compile(r"[A-Za-z_]\w*|\d+\.\d*|\d+|->|[-+*/<>=!&|]=|&&|\|\||\+\+|--|[-+*/<>]")


def mutants(text: str) -> Iterator[tuple[int, str]]:
    """Each with one change: the line that was changed, and the text."""
    lines = text.split("\n")
    end = next((i for i, line in enumerate(lines) if line.startswith("int main")), len(lines))
    start = next(i for i, line in enumerate(lines) if line.startswith("{"))
    for i in range(start, end):
        line = lines[i]
        if line.startswith(("#", "static", "void", "double")) or "/*" in line:
            continue
        for found in TOKEN.finditer(line):
            other = OTHERS.get(found[0])
            if other is not None:
                yield (
                    i + 1,
                    "\n".join([*lines[:i], line[: found.start()] + other + line[found.end() :], *lines[i + 1 :]]),
                )
        if re.fullmatch(r"\s+[^;{}]*[^;{}=]=[^;{}=][^;{}]*;", line) and "double" not in line:
            yield i + 1, "\n".join([*lines[:i], *lines[i + 1 :]])
            if i + 1 < end and lines[i + 1].rstrip().endswith(";"):
                yield i + 1, "\n".join([*lines[:i], lines[i + 1], line, *lines[i + 2 :]])


def sources() -> Iterator[tuple[int, Path]]:
    """Right programs, with the number of their exercise."""
    for folder in (HERE, HERE.parent / "blind4"):
        for file in sorted(folder.glob("e0[1-7]/r*.c")):
            yield int(file.parent.name[1:]), file


def main(every: int) -> None:
    """Print what was said of each that is wrong, and how many were led to their line."""
    counts: Counter[str] = Counter()
    chosen = [(n, file, m) for n, file in sources() for m in mutants(file.read_text(encoding="utf-8"))][::every]
    for number, file, (line, text) in chosen:
        given = grade(Submission(file.name, text, find(str(number)), "ada", keyed=False, language="c"), "sesame")
        if given.verdict.right:
            continue
        near = {line - 1, line, line + 1}
        named = given.verdict.outcome in ("mistake", "mistakes", "another scheme")
        told = {at for repair in given.closer.told for at, _ in repair.places}
        errors = {f.line for f in given.verdict.findings} & near
        how = (
            "line by a change"
            if told & near
            else "named"
            if named
            else "line by an error"
            if errors
            else "another line"
            if told
            else "line by behaviour"
            if set(given.closer.lines) & near
            else "not led"
        )
        counts[how] += 1
        if how in ("another line", "not led"):
            print(
                f"{file.parent.name}/{file.name} line {line}: {text.splitlines()[line - 1].strip()}: {how}", flush=True
            )
            print(f"    {given.verdict.name}, {given.closer.lines}, tried {given.closer.tried}", flush=True)
    print(f"{sum(counts.values())} of {len(chosen)} are wrong: {dict(counts.most_common())}")


if __name__ == "__main__":
    main(*([int(word) for word in sys.argv[1:]] or [8]))
