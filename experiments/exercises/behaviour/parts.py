"""Which of the things that a wrong program returns are right, and on which lines the others get their values.

Only first answers are compared: what is asked next is made of what was answered. The lines are read in the text: they
are where a value comes from, not what is wrong there.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from experiments.exercises.behaviour.special_cases import Parts
from experiments.exercises.c.text import lines_that_write
from experiments.exercises.handed_in.parsing import parsed
from experiments.exercises.handed_in.submission import Language
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue
from experiments.exercises.verdict.findings import Finding, listed

#: Numbers are the same up to this part of the largest, or to the exercise's own tolerance.
SAME = 1e-9

#: Of more lines than these none is told.
MOST_LINES = 3


def seen(
    catalogue: AnswerCatalogue, answers: Sequence[Mapping[str, Any]], source: str, language: Language = "python"
) -> list[Finding]:
    """What the answers to the catalogue's questions show.

    Args:
        source: the program's text.
    """
    right = _right_parts(catalogue, answers)
    good = [key for key, ok in right.items() if ok]
    bad = [key for key, ok in right.items() if not ok]
    if not good or not bad:
        return []
    parts = {question.function: question.parts for question in catalogue.questions}
    lines = _lines(source, bad, parts) if language == "python" else _lines_in_c(source, bad, parts)
    words = f"Right in your first answers {_is(good)} {_named(good, parts)}; {_named(bad, parts)} {_is(bad)} not"
    place = f", and {'get their values' if len(bad) > 1 else 'gets its value'} in {_at(lines)}" if lines else ""
    return [Finding("right_and_wrong_parts", f"{words}{place}.", "How is that computed?", lines=tuple(lines))]


def of_an_error(source: str, line: int | None) -> list[Finding]:
    """Where the names on a line that raised an error get their values: the mistake may be there."""
    try:
        tree = parsed(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    lines = sorted(set(lines_behind(tree, line))) if line else []
    if not lines or len(lines) > MOST_LINES + 1:
        return []
    words = f"What stands on line {line} gets its values in {_at(lines)}."
    return [Finding("values_of_that_line", words, "Print what these names hold, and their shapes.", lines=tuple(lines))]


def lines_behind(tree: ast.Module, line: int) -> Iterator[int]:
    r"""The lines before a line of a function on which the names that it reads are assigned.

    >>> list(lines_behind(ast.parse("def f(a):\n    b = 2 * a\n    return b[0]"), 3))
    [2]
    """
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef) and function.lineno < line <= (function.end_lineno or 0):
            at = [n for n in ast.walk(function) if isinstance(n, ast.expr) and n.lineno <= line <= (n.end_lineno or 0)]
            names = {n.id: n for n in at if isinstance(n, ast.Name)}
            yield from (found for n in names.values() for found in _sources(function, n) if found < line)


def _right_parts(catalogue: AnswerCatalogue, answers: Sequence[Mapping[str, Any]]) -> dict[tuple[str, str], bool]:
    """By function and part, whether it is right in the first step of every question."""
    right: dict[tuple[str, str], bool] = {}
    tolerance = max(SAME, catalogue.exercise.tolerance)
    for question, answer, expected in zip(catalogue.questions, answers, catalogue.right, strict=False):
        values: Parts = next(iter(answer["values"]), [])
        readable = len(values) == len(question.parts) and all(v.dtype.kind in "iufb" for v in values)
        given = next(iter(catalogue.exercise.comparable(question, [list(values)])), None) if readable else None
        for p, name in enumerate(question.parts):
            same = given is not None and _same(given[p], expected[0][p], tolerance)
            right[question.function, name] = right.get((question.function, name), True) and same
    return right


def _same(given: Any, want: Any, tolerance: float) -> bool:
    if given.size != want.size or want.dtype.kind == "U":
        return False
    numbers, others = given.astype(float).ravel(), want.astype(float).ravel()
    with np.errstate(all="ignore"):
        return bool((np.abs(numbers - others) <= tolerance * np.abs(others).max(initial=0.0)).all())


def _lines_in_c(source: str, bad: Sequence[tuple[str, str]], parts: Mapping[str, Sequence[str]]) -> list[int]:
    """Where what is wrong is written, if these are few lines."""
    found = {line for f, part in bad for line in lines_that_write(source, f, list(parts[f]).index(part))}
    return sorted(found) if len(found) <= MOST_LINES else []


def _lines(source: str, bad: Sequence[tuple[str, str]], parts: Mapping[str, Sequence[str]]) -> list[int]:
    """Where what is wrong gets its values, if these are few lines."""
    try:
        tree = parsed(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    found: set[int] = set()
    for function, part in bad:
        found |= set(lines_of_part(tree, function, list(parts[function]).index(part), len(parts[function])))
    return sorted(found) if len(found) <= MOST_LINES else []


def lines_of_part(tree: ast.Module, function: str, place: int, count: int) -> Iterator[int]:
    r"""The lines on which what a function returns at a place gets its value.

    >>> text = "def step(y, v, dt):\n    new = v + dt\n    return y, new"
    >>> list(lines_of_part(ast.parse(text), "step", 1, 2))
    [2]
    """
    own = next((n for n in tree.body if isinstance(n, ast.FunctionDef) and n.name == function), None)
    yield from _lines_of_part(tree, own, place, count, [])


def _lines_of_part(
    tree: ast.Module, own: ast.FunctionDef | None, place: int, count: int, seen: Sequence[ast.FunctionDef]
) -> Iterator[int]:
    """The same; where what another function returns is returned, those of that one."""
    for node in ast.walk(own) if own else ():
        if isinstance(node, ast.Return) and node.value is not None:
            value = node.value
            called = _function_called(tree, value)
            if called is not None and called not in seen:
                yield from _lines_of_part(tree, called, place, count, [*seen, called])
                continue
            if isinstance(value, ast.Tuple | ast.List) and len(value.elts) == count:
                value = value.elts[place]
            elif count > 1:
                continue
            assigned = list(_sources(own, value)) if isinstance(value, ast.Name) else []
            yield from assigned or [value.lineno]


def _function_called(tree: ast.Module, value: ast.expr) -> ast.FunctionDef | None:
    """The program's own function or method that a value is the result of, if there is one of that name."""
    called = value.func if isinstance(value, ast.Call) else None
    name = called.attr if isinstance(called, ast.Attribute) else called.id if isinstance(called, ast.Name) else None
    found = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef) and node.name == name]
    match found:
        case [only]:
            return only
    return None


def _sources(function: ast.FunctionDef | None, name: ast.Name) -> Iterator[int]:
    """Lines on which a name, or something in it, is assigned."""
    for node in ast.walk(function) if function else ():
        targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
        for target in targets:
            if isinstance(node, ast.Assign | ast.AugAssign | ast.AnnAssign) and name.id in _written(target):
                yield node.lineno


def _written(target: Any) -> set[str]:
    """Names that an assignment to a target changes."""
    if isinstance(target, ast.Tuple | ast.List):
        return set().union(*map(_written, target.elts))
    while isinstance(target, ast.Subscript | ast.Attribute | ast.Starred):
        target = target.value
    return {target.id} if isinstance(target, ast.Name) else set()


def _named(keys: Sequence[tuple[str, str]], parts: Mapping[str, Sequence[str]]) -> str:
    """What is meant: a part by its name, with its function where there are several; the function where it is all."""
    told = [p if len(parts) == 1 else f"{f}()" if len(parts[f]) == 1 else f"{p} of {f}()" for f, p in keys]
    return listed(told)


def _is(keys: Sequence[object]) -> str:
    return "is" if len(keys) == 1 else "are"


def _at(lines: Sequence[int]) -> str:
    return f"line{'s' if len(lines) > 1 else ''} {listed([str(line) for line in lines])}"
