"""Of which kind a change that only C needs is, on which line, and what it costs: by what was written and was meant."""

from __future__ import annotations

from contextlib import suppress
from functools import cache

import pytest

from experiments.exercises.c.edits import c_edits_of
from experiments.exercises.c.reading import read
from experiments.exercises.c.tree import UnreadableError
from experiments.exercises.c.written import NotInCError, text_of
from tests.experiments.exercises.c.test_edits import function

LOOP = "for (int i = 0; i < n; i++) {{ {} }}"

#: By the kind of the change, what was written and what was meant.
CHANGES: list[tuple[str, str, str]] = [
    ("whole", "*y = 1 / 2 * dt;", "*y = (double)1 / 2 * dt;"),
    ("whole", "dt = n / 2;", "dt = (double)n / 2;"),
    ("whole", "dt = abs(n);", "dt = fabs(n);"),
    ("whole", "n = (int)dt;", "n = dt;"),
    ("whole", "int a = dt * 2.0;\n*y = a;", "double a = dt * 2.0;\n*y = a;"),
    ("whole", "const long a = dt;\n*y = a;", "const double a = dt;\n*y = a;"),
    ("whole", "int a;\na = dt;\n*y = a;", "double a;\na = dt;\n*y = a;"),
    ("condition", "if (n = 0) *y = 1;", "if (n == 0) *y = 1;"),
    ("operator", "*y == dt;", "*y = dt;"),
    ("operator", "*y++;", "*y--;"),
    ("factor", "memcpy(x, v, sizeof(v));", "memcpy(x, v, sizeof(v) * (n));"),
    ("factor", "memcpy(x, v, sizeof(v));", "memcpy(x, v, sizeof(v[0]) * (2 * n));"),
    ("factor", "memcpy(x, v, sizeof(double));", "memcpy(x, v, sizeof(double) * (2));"),
    (
        "condition",
        LOOP.format("if (dt > 2.0) break; x[i][0] = 0;"),
        LOOP.format("if (dt > 2.0) continue; x[i][0] = 0;"),
    ),
    (
        "condition",
        LOOP.format("if (dt > 2.0) continue; x[i][0] = 0;"),
        LOOP.format("if (dt > 2.0) break; x[i][0] = 0;"),
    ),
    (
        "condition",
        LOOP.format("if (dt > 2.0) return; x[i][0] = 0;"),
        LOOP.format("if (dt > 2.0) continue; x[i][0] = 0;"),
    ),
    ("too much", "if (dt > 2.0) return;\n*y = 1;", "if (dt > 2.0) ;\n*y = 1;"),
    ("too much", "static double a = 0;\n*y = a;", "double a = 0;\n*y = a;"),
    ("left out", "double a;\na += dt;\n*y = a;", "double a = 0;\na += dt;\n*y = a;"),
    ("left out", "int a;\na += n;\n*y = a;", "int a = 0;\na += n;\n*y = a;"),
    (
        "left out",
        "double a[4];\na[0] += dt;\n*y = a[0];",
        "double a[4];\nmemset(a, 0, sizeof a);\na[0] += dt;\n*y = a[0];",
    ),
    ("left out", "x[0][0] += dt * v[0][0];", "x[0][0] += dt * v[0][0];\nx[0][1] += dt * v[0][1];"),
    ("left out", "x[0][1] += dt * v[0][1];", "x[0][0] += dt * v[0][0];\nx[0][1] += dt * v[0][1];"),
    (
        "left out",
        "double dx = 0, dy = 0;\ndx = x[0][0];\n*y = dx;",
        "double dx = 0, dy = 0;\ndx = x[0][0];\ndy = x[0][1];\n*y = dx;",
    ),
    ("order", "if (n > 0) *y = 1;\n*p = 2;\n*y = 3;", "if (n > 0) { *y = 1; *p = 2; }\n*y = 3;"),
    ("order", "if (n > 0) *y = 1;\n*p = 2;\n*y = 3;", "if (n > 0) { *y = 1; *p = 2; *y = 3; }"),
    ("order", "while (n > 0);\n*p = 2;\n*y = 3;", "while (n > 0) { *p = 2; }\n*y = 3;"),
    ("left out", "x[0][0] += dt;", "memset(x, 0, sizeof *x * (n));\nx[0][0] += dt;"),
    (
        "name",
        "double a = 0;\nif (n > 0) { double a = dt; }\n*y = a;",
        "double a = 0;\nif (n > 0) { a = dt; }\n*y = a;",
    ),
    ("name", "if (n > 0) { double dt = *p; }\n*y = dt;", "if (n > 0) { dt = *p; }\n*y = dt;"),
]


@cache
def changed(text: str) -> list[tuple[int, str, float, str]]:
    """Line, kind, cost and text of each change of a function that is C."""
    program, found = read(text), []
    for edit in c_edits_of(program):
        with edit.applied(), suppress(NotInCError, UnreadableError):
            found.append((edit.line, edit.family, edit.cost, text_of(read(text_of(program)))))
    assert text_of(program) == text
    return found


@pytest.mark.parametrize(("family", "wrong", "meant"), CHANGES, ids=lambda text: text.replace("\n", " "))
def test_a_change_is_of_its_kind(family: str, wrong: str, meant: str) -> None:
    """The cheapest that makes the one of the other; all cost between one and three."""
    text = function(meant)
    kinds = [(cost, kind) for _, kind, cost, made in changed(function(wrong)) if made == text]
    assert kinds
    assert family in [kind for cost, kind in kinds if cost == min(kinds)[0]]
    assert all(1.0 <= cost <= 3.0 for _, _, cost, _ in changed(function(wrong)))


@pytest.mark.parametrize(
    ("wrong", "never"),
    [
        ("*y = 1.0 / 2 * dt;", "*y = (double)1.0 / 2 * dt;"),
        ("*y = fabs(dt);", "*y = abs(dt);"),
        ("int a = n * 2;\n*y = a;", "double a = n * 2;\n*y = a;"),
        ("double a = 0;\n*y = a;", "double a = 0;\nmemset(a, 0, sizeof a);\n*y = a;"),
        (
            "double a = 0;\nif (n > 0) { double b = dt; *y = b; }\n*y = a;",
            "double a = 0;\nif (n > 0) { b = dt; *y = b; }\n*y = a;",
        ),
        ("x[0][2] = dt;", "x[0][2] = dt;\nx[0][-1] = dt;"),
        ("s->drag = dt;", "memset(s, 0, sizeof *s * (n));\ns->drag = dt;"),
        ("*p = dt;", "memset(x, 0, sizeof *x * (n));\n*p = dt;"),
        ("int *q;\n*y = 1;", "double *q;\n*y = 1;"),
        ("double *q;\n*y = 1;", "double *q;\nmemset(q, 0, sizeof q);\n*y = 1;"),
        ("double *q[3];\n*y = 1;", "double *q[3];\nmemset(q, 0, sizeof q);\n*y = 1;"),
        ("double q = x[0][0];\n*y = q;", "double q = x[0][0];\ndouble q = x[0][1];\n*y = q;"),
        ("hypot(x[0][0], 1);", "hypot(x[0][0], 1);\nhypot(x[0][1], 1);"),
        (
            "if (n > 0) *y = 1;\n*p = 2;\n*p = 3;\n*p = 4;\n*p = 5;",
            "if (n > 0) { *y = 1; *p = 2; *p = 3; *p = 4; *p = 5; }",
        ),
    ],
)
def test_what_is_right_in_c_is_not_tried(wrong: str, never: str) -> None:
    """No whole numbers, a value that is there, another name, no such component, nothing that is written into."""
    try:
        text = function(never)
    except UnreadableError:
        return
    assert text not in [made for *_, made in changed(function(wrong))]


def test_the_more_is_taken_in_the_more_it_costs() -> None:
    """Into a condition, from what follows it; a change costs about as much for each statement."""
    wrong = function("if (n > 0) *y = 1;\n*p = 2;\n*y = 3;\n*p = 4;")
    costs = [cost for line, family, cost, made in changed(wrong) if family == "order" and "*y = 1;\n    }" not in made]
    assert costs[:3] == sorted(set(costs[:3]))
    assert len(costs) >= 3


@pytest.mark.parametrize("line", ["static double a = 0;", "do { double a = 1; } while (n < 0);"])
def test_a_value_that_is_there_is_not_put_again(line: str) -> None:
    """Whatever the text is that is only copied."""
    program, texts = read(function(f"{line}\n*y = 1;")), []
    for edit in c_edits_of(program):
        with edit.applied(), suppress(NotInCError):
            texts.append(text_of(program))
    assert texts
    assert not any("= 0 = 0" in text or "1 = 0" in text or "memset(a" in text for text in texts)


def test_what_was_there_before_is_read_in_its_place() -> None:
    """After an array was written into: at each place of a line, and at all; not where it is written into."""
    program = read(function("*y = dt;\n*p = *y - 2 * *y;"))
    found = {}
    for edit in c_edits_of(program):
        with edit.applied():
            text = text_of(program, told=True)
        if "_given" in text:
            found[text.split("{\n")[1].split("\n}")[0].replace("    ", "").replace("\n", " ")] = edit.line, edit.family
    assert len(found) == 3
    once = [e for e in c_edits_of(read(function("*y = dt;\n*p = *y;"))) if e.cost == 2.0 and len(e.sites) == 2]
    assert len(once) == 1  # of a line that reads it at one place
    kept = "_y_given = a copy of y; *y = dt;"
    line = [i for i, text in enumerate(text_of(program).splitlines(), 1) if "2 *" in text]
    assert {text for text in found if "_y_given" in text} == {
        f"{kept} *p = *_y_given - 2 * *_y_given;",
        f"{kept} *p = *_y_given - 2 * *y;",
        f"{kept} *p = *y - 2 * *_y_given;",
    }
    assert set(found.values()) == {(*line, "order")}


@pytest.mark.parametrize(
    ("wrong", "meant", "line"),
    [
        ("*y = 1;\ndt = n / 2;", "*y = 1;\ndt = (double)n / 2;", 2),
        ("*p = 1;\nx[0][0] += dt;", "memset(x, 0, sizeof *x * (n));\n*p = 1;\nx[0][0] += dt;", 2),
        ("*p = 1;\nx[0][0] = dt;", "memset(x, 0, sizeof *x * (n));\n*p = 1;\nx[0][0] = dt;", 1),
        ("*y = 1;\nx[0][0] = v[0][0];", "*y = 1;\nx[0][0] = v[0][0];\nx[0][1] = v[0][1];", 2),
        (
            "*p = 1;\nx[0][0] += dt;\nx[0][1] += dt;",
            "memset(x, 0, sizeof *x * (n));\n*p = 1;\nx[0][0] += dt;\nx[0][1] += dt;",
            2,
        ),
        ("*p = 1;\nx[0][0] = v[0][0] = 0;", "memset(v, 0, sizeof *v * (n));\n*p = 1;\nx[0][0] = v[0][0] = 0;", 1),
        ("if (n > 0)\n*y = 1;\n*p = 2;\n*y = 3;", "if (n > 0) { *y = 1; *p = 2; *y = 3; }", 5),
        ("*y = 1;\nwhile (n > 0);\n*p = 2;", "*y = 1;\nwhile (n > 0) { *p = 2; }", 2),
    ],
)
def test_the_line_is_that_of_what_is_changed(wrong: str, meant: str, line: int) -> None:
    """Where something is first added to an array that was not cleared; else where it is first done."""
    text, wrong = function(meant), function(wrong)
    first = wrong.splitlines().index("{") + 1 if "{" in wrong.splitlines() else 1
    lines = {at - first for at, _, _, made in changed(wrong) if made == text}
    assert lines == {line}
