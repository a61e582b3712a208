"""What is known of the names of a C program that was read: kinds, fields, the order in which they are given."""

from __future__ import annotations

import pytest

from experiments.exercises.c.kinds import Kind
from experiments.exercises.c.reading import read
from experiments.exercises.c.tree import UnreadableError, Verbatim, functions_in


def test_a_functions_names_come_in_its_order_and_structs_last() -> None:
    """The order is that of the text; in the tree the one that holds fields comes last. No names are none."""
    text = "int f(struct string *s, int n, double x[][2])\n{\n    return n;\n}\n"
    text += "void g(void)\n{\n    ;\n}\nint h(int)\n{\n    return 1;\n}\n"
    f, g, h = functions_in(read(text).tree)
    assert f.order == ["s", "n", "x"]  # type: ignore[attr-defined]
    assert [a.arg for a in f.args.args] == ["n", "x", "s"]
    assert (g.order, h.order) == ([], [])  # type: ignore[attr-defined]
    assert f.header == "int @(struct string *s, int n, double x[][2])"  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("declared", "kind"),
    [
        ("double a = 1;", Kind("number", 0)),
        ("const float *a = 0;", Kind("number", 1)),
        ("unsigned long a = 1;", Kind("whole", 0)),
        ("size_t a = 1;", Kind("whole", 0)),
        ("double a[3][2];", Kind("number", 2)),
        ("struct spring a;", Kind("struct spring", 0)),
        ("struct spring *a = s;", Kind("struct spring", 1)),
        ("row a;", Kind("number", 1)),
        ("row *a;", Kind("number", 2)),
        ("void *a = s;", Kind("void", 1)),
        ("double a = 1; { int a = 2; }", Kind("", -1)),
        ("double a = 1; { double a = 2; }", Kind("number", 0)),
        ("for (int a = 0; a < 3; a++) ;", Kind("whole", 0)),
    ],
)
def test_the_kind_of_a_declared_name(declared: str, kind: Kind) -> None:
    """By its type, also one that has a name of its own; of two kinds it is not known."""
    program = read(f"typedef double row[2];\nvoid f(struct spring *s)\n{{\n    {declared}\n}}\n")
    assert program.kinds["f"]["a"] == kind


@pytest.mark.parametrize(
    ("declared", "free"),
    [
        ("double a = 1;", "double springlab_value"),
        ("const double a = 1;", "double springlab_value"),
        ("const double *a = p;", "const double *springlab_value"),
        ("double *const a = p;", "double *springlab_value"),
        ("const double (*a)[2] = p;", "const double (*springlab_value)[2]"),
    ],
)
def test_a_name_that_can_be_written_into_is_declared_as_the_given_one(declared: str, free: str) -> None:
    """What a pointer leads to stays what it is."""
    (own,) = functions_in(read(f"void f(void *p)\n{{\n    {declared}\n}}\n").tree)
    assert own.body[0].free == free  # type: ignore[attr-defined]
    assert own.body[0].declared.replace("* const", "*const") == declared.partition(" =")[0]  # type: ignore[attr-defined]


def test_fields_of_structs_and_what_stands_outside() -> None:
    """Those of the exercise and those of the text; names outside are known in what follows, functions as such."""
    text = (
        "struct own { struct { int inner; } ; double outer, *many; };\nstatic double rate = 2;\n"
        "double half(double a)\n{\n    return a / 2;\n}\nvoid f(struct own *o)\n{\n    o->outer = half(rate);\n}\n"
        "int main(void)\n{\n    return 0;\n}\n"
    )
    program = read(text)
    fields = program.kinds[""]
    assert fields["struct spring.mass"] == fields["struct own.outer"] == Kind("number", 0)
    assert fields["struct string.masses"] == fields["struct own.many"] == Kind("number", 1)
    assert fields["struct string.count"] == Kind("whole", 0)
    assert program.kinds["f"]["rate"] == Kind("number", 0)
    assert program.kinds["f"]["half"] == Kind("function", 0)
    assert "f" not in program.kinds["half"]
    assert [function.name for function in functions_in(program.tree)] == ["half", "f"]
    beside = [node for node in program.tree.body if isinstance(node, Verbatim)]
    assert [node.names for node in beside][-1] == ["rate"]


@pytest.mark.parametrize(
    ("loop", "counts"),
    [
        ("for (int i = 0; i < 3; i++) ;", True),
        ("for (int i = 2; i <= n; ++i) ;", True),
        ("for (int i = 0; i < 3; i += 1) ;", True),
        ("for (int i = 0; i < 3; i += 2) ;", False),
        ("for (int i = 3; i > 0; i--) ;", False),
        ("for (int i = 0; i != 3; i++) ;", False),
        ("for (int i = 0; 3 > i; i++) ;", False),
        ("for (int i = 0; i < 3; n++) ;", False),
        ("for (int i = 0; n < 3; i++) ;", False),
        ("for (int i = 0; i < 3; n += 1) ;", False),
        ("for (;;) break;", False),
    ],
)
def test_loops_that_count_up_are_over_a_range(loop: str, counts: bool) -> None:
    """By ones, to an end that the same name is compared with."""
    (function,) = functions_in(read(f"void f(int n)\n{{\n    {loop}\n}}\n").tree)
    assert function.body[0].iter.func.id == ("range" if counts else "for")  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    "begin", ["n += 1", "x[0] = 1", "int i = 0, j = 1", "int i", "int i, j = 1", "n++", "n = 1, m = 2"]
)
def test_loops_that_begin_in_another_way_are_not_read(begin: str) -> None:
    """Nothing is taken for what it is not: one name begins with a value, or none does."""
    with pytest.raises(UnreadableError):
        read(f"void f(int n, int m, int *x)\n{{\n    for ({begin}; n < 3; n++) ;\n}}\n")


def test_what_stands_in_quotes_is_no_comment() -> None:
    """And a quote in a comment begins nothing."""
    body = """    f("a // b"); // "no
    f('/'); /* it's
    */ f("/* c */");
    f(\"'\");
"""
    (own,) = functions_in(read(f"void own(int n)\n{{\n{body}}}\n").tree)
    assert [one.value.args[0].text for one in own.body] == ['"a // b"', "'/'", '"/* c */"', '"\'"']  # type: ignore[attr-defined]
    assert [one.lineno for one in own.body] == [3, 4, 5, 6]


def test_directives_stand_aside_and_lines_stay_where_they_are() -> None:
    """Also those that go on in the next line; comments are no lines less."""
    text = '#define A \\\n    1\n/* one\n   two */ #include "b.h"\nint f(int a)\n{\n    // no\n    return a;\n}\n'
    program = read(text.replace(' #include "b.h"', ""))
    assert program.directives == ["#define A \\\n    1"]
    (function,) = functions_in(program.tree)
    assert (function.lineno, function.body[0].lineno) == (5, 8)
