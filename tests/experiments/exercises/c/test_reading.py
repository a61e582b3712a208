"""C programs as trees of Python's kind, and written as C again."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from experiments.exercises.c.reading import read
from experiments.exercises.c.tree import UnreadableError, Word, functions_in
from experiments.exercises.c.written import text_of
from experiments.exercises.exercise import find
from experiments.exercises.verdict.judge import judge

PROGRAMS = Path(__file__).parent

#: In C, and as it is in the tree.
FORMS = {
    "x[i][0] = -v[i][1];": "x[i, 0] = -v[i, 1]",
    "*y += dt * *p;": "y.at += dt * p.at",
    "a = s->mass * fabs(dt) + s->gravity;": "a = s.mass * abs(dt) + s.gravity",
    "for (i = 1; i < n; i++) n = i;": "for i in range(1, n):\n    n = i",
    "for (int j = 0; j < n; ++j) n += 2;": "for j in range(n):\n    n += 2",
    "double l = hypot(dt, 2), m;": "l = hypot(dt, 2)",
    "if (n > 0 && !i) n++; else n--;": "if n > 0 and (not i):\n    n += 1\nelse:\n    n -= 1",
    "while (n) { n = i ? 1 : 2; }": "while n:\n    n = 1 if i else 2",
    "x[0][0] = x[1][1] = 0;": "x[0, 0] = x[1, 1] = 0",
    "z[n][1][2] = 0;": "z[n, 1, 2] = 0",
    "y[n] = p[0];": "y[n] = p[0]",
    "dt = abs(n) / lambda;": "dt = abs_c_(n) / lambda_c_",
}


def function(body: str) -> str:
    """A function with these statements."""
    return (
        f"void own(double *y, double *p, double x[][2], double v[][2], double dt, struct spring *s)\n{{\n{body}\n}}\n"
    )


@pytest.mark.parametrize("statement", FORMS)
def test_what_is_the_same_in_both_languages_is_the_same(statement: str) -> None:
    """The first statement of a function, in the tree."""
    (own,) = functions_in(read(function(f"int i, n; double a, lambda;\n{statement}")).tree)
    assert ast.unparse(own.body[4]) == FORMS[statement]
    assert own.body[4].lineno == 4


@pytest.mark.parametrize("file", sorted(PROGRAMS.glob("e0[1-7]/*.c")), ids=lambda f: f"{f.parent.name}/{f.stem}")
def test_what_is_written_is_what_was_read(file: Path) -> None:
    """Written and read again it is written in the same way; what C only has (sizes, casts, structs) is kept."""
    try:
        once = text_of(read(file.read_text(encoding="utf-8")))
    except UnreadableError:
        assert file.stem in ("semicolon_missing", "no_function")
        return
    assert text_of(read(once)) == once


@pytest.mark.rotating(4)
@pytest.mark.parametrize(
    "name", ["e01/right_struct_copy", "e02/right_helper", "e03/right_malloc", "e04/right_arrays", "e07/right_barrier"]
)
def test_a_right_program_is_right_as_it_is_written(name: str) -> None:
    """Nothing is lost on the way."""
    text = text_of(read((PROGRAMS / f"{name}.c").read_text(encoding="utf-8")))
    assert judge(find(str(int(name[1:3]))), text, language="c").right


def test_what_is_not_known_is_written_as_it_was() -> None:
    """Fields of a struct that is declared elsewhere; the size of a type is only copied, that of a value is read."""
    line = "q->r->s = q->r.s + sizeof(double) + sizeof(q);"
    text = f"void f(struct other *q)\n{{\n    {line}\n}}\n"
    assert text_of(read(text)) == text
    (own,) = functions_in(read(text).tree)
    assert [node.text for node in ast.walk(own) if isinstance(node, Word)] == ["sizeof(double)"]


@pytest.mark.parametrize(
    ("values", "is_list"),
    [("{dt, 2}", True), ("{{dt, 2}}", True), ("{dt, [1] = 2}", False), ("{[0] = dt, [1] = 2}", False)],
)
def test_a_list_is_one_where_no_value_says_its_place(values: str, is_list: bool) -> None:
    """Else it is only copied: its values cannot be taken for each other."""
    text = function(f"double q[2] = {values};")
    (own,) = functions_in(read(text).tree)
    (statement,) = own.body
    assert isinstance(statement, ast.Assign)
    assert isinstance(statement.value, ast.List) == is_list
    assert f"double q[2] = {values};" in text_of(read(text))


@pytest.mark.parametrize(
    "text", ["void step(", "#define IF if (\nvoid f(int a) { IF a) a = 1; }", "void f(void) { for (;;) {} }" * 2000]
)
def test_what_cannot_be_read_is_told(text: str) -> None:
    """No other error comes of it: not C, a macro for a piece of a statement, a text that is too long."""
    with pytest.raises(UnreadableError):
        read(text)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0", 0), ("12", 12), ("12u", 12), ("12UL", 12),
        ("1.5", 1.5), ("2.f", 2.0), ("1e-3L", 1e-3),
        ("012", None), ("0x1F", None), ("0x1p3", None), ("'a'", None), ("'1'", None),
    ],
)  # fmt: skip
def test_decimal_numbers_are_numbers(text: str, value: float | None) -> None:
    """With their endings; others, whose text has another value in Python, are only copied."""
    (own,) = functions_in(read(function(f"dt = {text};")).tree)
    (statement,) = own.body
    assert isinstance(statement, ast.Assign)
    found = statement.value
    assert text_of(read(function(f"dt = {text};"))).count(f"dt = {text};") == 1
    if value is None:
        assert not isinstance(found, ast.Constant)
    else:
        assert isinstance(found, ast.Constant)
        assert (found.value, type(found.value)) == (value, type(value))
