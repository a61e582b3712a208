"""What is read in a C submission without running it, and the schemes that are told apart by overflow."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from experiments.exercises.exercise import TOLERANCE, Exercise, Mistake, Question

#: Comments, also one that nobody has closed, and what stands in quotes: nothing that is done.
SILENT = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'", re.DOTALL)


def unwritten_in_c(source: str, functions: Iterable[str]) -> list[str]:
    """Of these functions, those that have nothing between their braces.

    >>> unwritten_in_c("void step(double *y, double dt) { /* here */ }", ["step"])
    ['step']
    >>> unwritten_in_c("void step(double *y, double dt) { *y += dt; }", ["step"])
    []
    """
    text = SILENT.sub(" ", source)
    return [name for name in dict.fromkeys(functions) if re.search(rf"\b{name}\s*\([^(){{;]*\)\s*{{\s*;?\s*}}", text)]


def without_comments(source: str) -> str:
    """The text without its comments, line by line; what stands in quotes stays."""
    return SILENT.sub(lambda found: re.sub(r"[^\n]+", " ", found[0]) if found[0].startswith("/") else found[0], source)


def includes_the_exercise(source: str) -> bool:
    r"""Whether the file that says what the function is given is included, or its structures are written out.

    >>> includes_the_exercise('#include "exercise.h"'), includes_the_exercise('// #include "exercise.h"')
    (True, False)
    """
    text = without_comments(source)
    return bool(re.search(r"#\s*include\s*[\"<][^\">\n]*exercise\.h|\bstruct\s+(spring|string|circle)\s*{", text))


def whole_divisions(source: str) -> list[tuple[int, str]]:
    r"""Lines on which one whole number is divided by another, and something is left.

    >>> whole_divisions("a = 1.0 / 2;\nb = dt * (1 / 2);")
    [(2, '1 / 2')]
    """
    text = SILENT.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), source)
    found = re.finditer(r"(?<![\w.])(\d+)\s*/\s*(\d+)(?![\w.])", text)
    divided = [(m, int(m[1]), int(m[2])) for m in found]
    return [(text.count("\n", 0, m.start()) + 1, f"{a} / {b}") for m, a, b in divided if b == 0 or a % b]


def lines_that_write(source: str, function: str, place: int) -> list[int]:
    r"""The lines on which a function writes into an array that it is given, or where a pointer leads.

    Args:
        place: which one, of those that it may write into.

    >>> lines_that_write("void step(double *y, double *v)\n{\n    *y += *v;\n    *v = 0;\n}", "step", 1)
    [4]
    """
    text = SILENT.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), source)
    begin = re.search(rf"\b{function}\s*\(([^){{;]*)\)\s*{{", text)
    given = [p for p in begin[1].split(",") if re.search(r"[*\[]", p) and "const" not in p] if begin else []
    if begin is None or place >= len(given):
        return []
    name = re.findall(r"\w+(?=\s*(?:\[[^]]*\]\s*)*$)", given[place].strip())
    end = re.compile(r"^}", re.MULTILINE).search(text, begin.end())
    written = rf"(?<![\w.>])(?:\*\s*)?{name[-1] if name else '-'}\s*(?:\[[^]]*\]\s*)*[-+*/]?=(?!=)"
    found = re.finditer(written, text[: end.start() if end else len(text)])
    return sorted({text.count("\n", 0, m.start()) + 1 for m in found if m.start() > begin.end()})


def told_by_overflow(
    exercise: Exercise, questions: Sequence[Question], answers: Sequence[Mapping[str, Any]]
) -> Mistake | None:
    """The other scheme whose numbers these are, finite and infinite ones alike, where the right one's are not."""
    for other in exercise.told_aside:
        same = [_same(exercise, q, a, other.parameters) for q, a in zip(questions, answers, strict=False)]
        right = [_same(exercise, q, a, {}) for q, a in zip(questions, answers, strict=False)]
        if same and all(same) and not all(right):
            return other
    return None


def _same(exercise: Exercise, question: Question, answer: Mapping[str, Any], parameters: Mapping[str, Any]) -> bool:
    """Whether numbers are those of the solution with these parameters: all that is infinite is the same.

    Where the solution has NaN it has multiplied something infinite by a weight of 0, and nothing follows.
    """
    if not answer["values"]:
        return False
    given, expected = (
        np.array(parts, float).ravel() for parts in (answer["values"][0], exercise.answer(question, parameters)[0])
    )
    known, finite = ~np.isnan(expected), np.isfinite(expected)
    return bool(
        (np.isfinite(given) == finite)[known].all()
        and np.allclose(given[finite], expected[finite], rtol=TOLERANCE, atol=0.0)
    )
