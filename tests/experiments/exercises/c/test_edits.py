"""Which changes of a C program are tried: what beginners do wrong is one change away from what they meant."""

from __future__ import annotations

from contextlib import suppress

import pytest

from experiments.exercises.c.edits import c_edits_of
from experiments.exercises.c.reading import read
from experiments.exercises.c.tree import UnreadableError
from experiments.exercises.c.written import NotInCError, text_of
from experiments.exercises.repair.source_edits import edits_of

#: By what was done wrong: the statements of a function, and the same as they were meant.
SLIPS = {
    "whole numbers divided": ("*y += 1 / 2 * dt;", "*y += (double)1 / 2 * dt;"),
    "the whole part": ("dt = abs(n) * dt;", "dt = abs(n) / dt;"),
    "fabs for abs": ("dt = abs(n);", "dt = fabs(n);"),
    "kept in an int": ("int a = dt * 2.0;\n*y = a;", "double a = dt * 2.0;\n*y = a;"),
    "break for continue": (
        "for (int i = 0; i < n; i++) { if (dt > 2.0) break; x[i][0] = 0; }",
        "for (int i = 0; i < n; i++) { if (dt > 2.0) continue; x[i][0] = 0; }",
    ),
    "return for continue": (
        "for (int i = 0; i < n; i++) { if (dt > 2.0) return; x[i][0] = 0; }",
        "for (int i = 0; i < n; i++) { if (dt > 2.0) continue; x[i][0] = 0; }",
    ),
    "one too few": ("for (int i = 0; i < n - 1; i++) x[i][0] = 0;", "for (int i = 0; i < n; i++) x[i][0] = 0;"),
    "one too many": ("for (int i = 0; i <= n; i++) x[i][0] = 0;", "for (int i = 0; i <= n - 1; i++) x[i][0] = 0;"),
    "assigned for compared": ("if (n = 0) *y = 1;", "if (n == 0) *y = 1;"),
    "compared for assigned": ("*y == dt;", "*y = dt;"),
    "no braces": ("if (n > 0) *y = 1;\n*p = 2;", "if (n > 0) { *y = 1; *p = 2; }"),
    "a semicolon too much": ("if (n > 0);\n*p = 2;", "if (n > 0) { *p = 2; }"),
    "declared again": (
        "double a = 0;\nif (n > 0) { double a = dt; }\n*y = a;",
        "double a = 0;\nif (n > 0) { a = dt; }\n*y = a;",
    ),
    "no value yet": ("double a;\na += dt;\n*y = a;", "double a = 0;\na += dt;\n*y = a;"),
    "not cleared": ("x[0][0] += dt;", "memset(x, 0, sizeof *x * (n));\nx[0][0] += dt;"),
    "kept between calls": ("static double a = 0;\n*y = a;", "double a = 0;\n*y = a;"),
    "the other component": (
        "x[0][0] += dt * v[0][0];",
        "x[0][0] += dt * v[0][0];\nx[0][1] += dt * v[0][1];",
    ),
    "the component": ("x[0][1] = v[0][0];", "x[0][1] = v[0][1];"),
    "the size of a pointer": ("memcpy(x, v, sizeof(v));", "memcpy(x, v, sizeof(v[0]) * (n));"),
    "two lines the wrong way": ("*y += dt * *p;\n*p += dt * *y;", "*p += dt * *y;\n*y += dt * *p;"),
    "both components": (
        "x[0][0] = dt * v[0][0];\nx[0][1] = dt * v[0][1];",
        "x[0][0] = -(dt * v[0][0]);\nx[0][1] = -(dt * v[0][1]);",
    ),
    "all on the anchor": (
        "for (int i = 0; i < n; i++) x[i][0] = s->anchor[0];",
        "for (int i = 0; i < n; i++) x[i][0] = (i > 0 ? x[i - 1] : s->anchor)[0];",
    ),
}


def function(body: str) -> str:
    """A function with these statements, in the form in which trees are written."""
    given = "double *y, double *p, double x[][2], double v[][2], int n, double dt, struct string *s"
    return text_of(read(f"void own({given})\n{{\n{body}\n}}\n"))


def variants(text: str) -> set[str]:
    """The text with each change that is C."""
    program, found = read(text), set()
    for edit in [*edits_of(program.tree), *c_edits_of(program)]:
        with edit.applied(), suppress(NotInCError, UnreadableError):  # what is for Python only, and copies
            found.add(text_of(read(text_of(program))))
    assert text_of(program) == text
    return found


@pytest.mark.rotating(7)
@pytest.mark.parametrize("slip", SLIPS)
def test_what_was_meant_is_one_change_away(slip: str) -> None:
    """And what was not meant is not; afterwards the program is what it was."""
    wrong, meant = SLIPS[slip]
    found = variants(function(wrong))
    assert function(meant) in found
    assert function("*y = never;") not in found
