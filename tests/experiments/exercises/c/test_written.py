"""Trees written as C: with the brackets that are needed and no others, and nothing that C has not."""

from __future__ import annotations

import ast
from typing import Any

import pytest

from experiments.exercises.c.reading import read
from experiments.exercises.c.tree import functions_in
from experiments.exercises.c.written import NotInCError, Writer, header_of, text_of

GIVEN = "double *y, double *p, double x[][2], double v[][2], int n, double dt, double a, double b, struct string *s"


def function(body: str) -> str:
    """A function of these lines."""
    lines = "\n".join(f"    {line}" for line in body.splitlines())
    return f"void own({GIVEN})\n{{\n{lines}\n}}\n"


@pytest.mark.parametrize(
    "line",
    [
        "a = a - b - dt;",
        "a = a - (b - dt);",
        "a = a - b + dt;",
        "a = a - (b + dt);",
        "a = a / (b * dt);",
        "a = a / b * dt;",
        "a = (a + b) * dt;",
        "a = a * b + dt;",
        "n = n % 2 * 3;",
        "a = -a * b;",
        "a = -(a + b);",
        "a = -(-a);",
        "a = - +a;".replace("- +", "-+"),
        "n = !(n == 2);",
        "n = n < 2 == 1;",
        "n = n < (n == 2);",
        "n = n <= 2 != n >= 3;",
        "n = n > 1 && n < 3 || n == 7;",
        "n = n > 1 && (n < 3 || n == 7);",
        "n = (n > 1 || n < 3) && n == 7;",
        "n = !n && n;",
        "a = n ? a : b;",
        "a = n ? a : n ? b : dt;",
        "a = (n ? a : b) ? b : a;",
        "a = n > 1 || n < 0 ? a + 1 : b;",
        "a = (n ? a : b) + dt;",
        "a = b = dt;",
        "a = (b = dt) + 1;",
        "a = n ? b = dt : a;",
        "*y += dt * *p;",
        "*y -= a - b;",
        "a *= b + dt;",
        "a /= b / dt;",
        "n++;",
        "n--;",
        "n += 2;",
        "*y += 1;",
        "*y++;",
        "x[n][0] = v[n + 1][1];",
        "a = (*x)[0];",
        "a = *x[0];",
        "a = s->drag + (*s).drag;",
        "a = s->masses[n - 1] * (double)n;",
        "a = (double)n / 2;",
        "a = (double)(n / 2);",
        "a = fmax(a, fmin(b, 0)) + fabs(dt);",
        "a = pow(a, 2) + sqrt(b) + hypot(a, b);",
        "n = abs(n);",
        "a = 1e-3 + 1.50 + 2.f + 3u;",
        "a = 1e-3 - .5;",
        "n = (n & 3);",
        "n = (n << 2) + 1;",
        "a = sizeof(double) + sizeof(a);",
        "return;",
        ";",
        "double q = a + b;",
        "double q[2] = {a, b + 1};",
        "const double *q = n > 0 ? x[n - 1] : s->anchor;",
    ],
)
def test_brackets_are_where_they_are_needed(line: str) -> None:
    """Written as it was read: each of these has none too many and none too few."""
    text = function(line)
    assert text_of(read(text)) == text


@pytest.mark.parametrize(
    ("line", "written"),
    [
        ("a = (a - b) - dt;", "a = a - b - dt;"),
        ("a = ((a * b)) + (dt);", "a = a * b + dt;"),
        ("n = (n > 1 && n < 3) || (n == 7);", "n = n > 1 && n < 3 || n == 7;"),
        ("a = (-a) * b;", "a = -a * b;"),
        ("n = n + 1, a = b;", "n = n + 1;\na = b;"),
        ("a = (n++, b);", "a = (n++, b);"),
        ("(*y)++;", "*y += 1;"),
        ("a += 1.0;", "a++;"),
        ("a = n ? (a) : (n ? b : dt);", "a = n ? a : n ? b : dt;"),
        ("n = n & 3 << 2;", "n = (n & (3 << 2));"),
        ("while (n) n--;", "while (n)\n{\n    n--;\n}"),
        ("if (n) a = b; else { b = a; n++; }", "if (n)\n{\n    a = b;\n}\nelse\n{\n    b = a;\n    n++;\n}"),
        ("for (int i = 0; i < n; i++) a += i;", "for (int i = 0; i < n; i++)\n{\n    a += i;\n}"),
        ("for (int i = 1; i <= n - 1; ++i) ;", "for (int i = 1; i <= n - 1; i++)\n{\n    ;\n}"),
        ("for (n = 0; n < 3; n++) break;", "for (n = 0; n < 3; n++)\n{\n    break;\n}"),
        ("for (n = 9; n > 3; n--) continue;", "for (n = 9; n > 3; n--)\n{\n    continue;\n}"),
    ],
)
def test_others_are_left_out(line: str, written: str) -> None:
    """And braces are about every block."""
    assert text_of(read(function(line))) == function(written)


def writer(told: bool = False, given: str = GIVEN) -> Writer:
    """One that is in a function of these arguments."""
    program = read(f"struct string {{ int count; double *masses; }};\nvoid own({given})\n{{\n    ;\n}}\n")
    made = Writer(program, told)
    made.enter(functions_in(program.tree)[-1])
    return made


def expression(text: str) -> ast.expr:
    """A tree."""
    return ast.parse(text, mode="eval").body


def statement(text: str) -> Any:
    """A tree."""
    return ast.parse(text).body[0]


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("a ** 2", "a * a"),
        ("b / a ** 2", "b / (a * a)"),
        ("(a + b) ** 2", "pow(a + b, 2)"),
        ("a ** 3", "pow(a, 3)"),
        ("(a + b) ** 0.5", "sqrt(a + b)"),
        ("y.at ** 2", "*y * *y"),
        ("x[n, 0] ** 2", "x[n][0] * x[n][0]"),
        ("True", "1"),
        ("-1.5", "-1.5"),
        ("a - -1.5", "a - -1.5"),
        ("abs(a)", "fabs(a)"),
        ("min(a, b)", "fmin(a, b)"),
        ("max(a, b)", "fmax(a, b)"),
        ("s.masses[n]", "s->masses[n]"),
        ("s.at.masses", "(*s).masses"),
        ("[a, b]", "{a, b}"),
        ("not a", "!a"),
        ("a and b or dt", "a && b || dt"),
        ("(a or b) and dt", "(a || b) && dt"),
        ("_half(a)", "_half(a)"),
        ("unknown.masses", "unknown->masses"),  # what is given mostly is a pointer
    ],
)
def test_what_changes_bring_is_c(text: str, written: str) -> None:
    """Powers, and Python's names of functions."""
    assert writer().expression(expression(text)) == written


@pytest.mark.parametrize(
    "text",
    [
        "a @ b",
        "a // b",
        "a in b",
        "x.T",
        "x.copy()",
        "np.sqrt(a)",
        "sum(a, axis=1)",
        "hasattr(a, b)",
        "'text'",
        "None",
        "[a, b][0]",
        "x[1:]",
        "lambda: a",
        "(a, b)",
        "1e999",
    ],
)
def test_what_c_has_not_is_not_written(text: str) -> None:
    """It raises an error of its own."""
    with pytest.raises(NotInCError):
        writer().expression(expression(text))


@pytest.mark.parametrize(
    ("text", "plain", "told"),
    [
        ("a = b.copy()", "a = b;", "a = b;"),
        ("n = n.copy()", "n = n;", "n = n;"),
        ("x = v.copy()", "x = springlab_copied(v, sizeof *(v) * (n));", "x = a copy of v;"),
        ("_a_given = a.copy()", "const double _a_given = a;", "const double _a_given = a;"),
        ("_n_given = n.copy()", "const int _n_given = n;", "const int _n_given = n;"),
        (
            "_x_before = x.copy()",
            "__typeof__(&(x)[0]) _x_before = springlab_copied(x, sizeof *(x) * (n));",
            "_x_before = a copy of x;",
        ),
        (
            "_x_given = x.copy() if hasattr(x, 'copy') else x",
            "__typeof__(&(x)[0]) _x_given = springlab_copied(x, sizeof *(x) * (n));",
            "_x_given = a copy of x;",
        ),
        ("a = b = dt", "a = b = dt;", "a = b = dt;"),
        ("a += 1", "a++;", "a++;"),
        ("a -= 1", "a--;", "a--;"),
        ("a *= 1", "a *= 1;", "a *= 1;"),
        ("a += 1.5", "a += 1.5;", "a += 1.5;"),
        ("x[n, 0] += 1", "x[n][0] += 1;", "x[n][0] += 1;"),
        ("return a", "return a;", "return a;"),
        ("pass", ";", ";"),
    ],
)
def test_statements_and_copies(text: str, plain: str, told: str) -> None:
    """Of arrays as many as there are masses; in words where it is told to people."""
    assert writer().plain(statement(text)) == plain
    assert writer(told=True).plain(statement(text)) == told


@pytest.mark.parametrize(("value", "written"), [(3, "3u"), (5, "5"), (3.0, "3.0"), (True, "1"), (-3, "-3")])
def test_a_number_is_written_as_it_was_while_it_is_the_same(value: float, written: str) -> None:
    """Another value, or another type, has its own words."""
    number: Any = ast.Constant(value)
    number.as_written = (3, "3u")
    assert writer().expression(number) == written
    assert writer().expression(ast.Constant(value)) == written.replace("u", "")


@pytest.mark.parametrize(("name", "count"), [("++", 2), ("&", 2), ("-=", 3), ("(int)", 2), ("p++", 2)])
def test_an_operator_has_as_many_sides_as_in_c(name: str, count: int) -> None:
    """Two where something is written into one, else one."""
    call = ast.Call(ast.Name(name, ast.Load()), [ast.Name("n", ast.Load())] * count, [])
    with pytest.raises(NotInCError):
        writer().expression(call)


@pytest.mark.parametrize(
    "text",
    [
        "struct own\n{\n    int a;\n};\n",
        "int a;\n",
        "typedef double row[2];\n",
        "void own(int n)\n{\n    int a;\n    switch (n)\n    {\n      case 1:\n        n = 2;\n    }\n    n = 3;\n}\n",
        "void own(int n)\n{\n    do\n    {\n        n--;\n    }\n    while (n > 3);\n}\n",
        "void own(int n)\n{\n    struct own b;\n    goto end;\n    end:\n    n = 3;\n}\n",
    ],
)
def test_what_is_copied_ends_once(text: str) -> None:
    """A declaration by a semicolon, what has braces by them."""
    own = "struct own\n{\n    int a;\n};\n" if "struct own b" in text else ""
    written, wanted = (
        [line.strip() for line in one.splitlines() if line] for one in (text_of(read(own + text)), own + text)
    )
    assert [line for line in written if line] == wanted


def test_a_text_is_for_the_compiler_unless_it_is_said_to_be_told() -> None:
    """What copies an array is in words only for people."""
    program = read(function("x[0][0] = a;"))
    own = functions_in(program.tree)[-1]
    own.body = [statement("x = v.copy()"), *own.body]
    assert "x = springlab_copied(v, sizeof *(v) * (n));" in text_of(program)
    assert "x = a copy of v;" in text_of(program, told=True)
    plain = Writer(program)
    plain.enter(own)
    assert "    x = springlab_copied(v, sizeof *(v) * (n));" in plain.function(own)


@pytest.mark.parametrize("text", ["a, b = b, a", "s = q.copy()", "_x_given = x", "a: int = 3", "a **= 2", "del a"])
def test_statements_that_c_has_not(text: str) -> None:
    """Several values at once, a copy of nobody knows what."""
    with pytest.raises(NotInCError):
        writer().plain(statement(text))


@pytest.mark.parametrize(
    ("text", "start", "test", "then"),
    [
        ("for i in range(n): pass", "i = 0", "i < n", "i++"),
        ("for i in range(1, n - 1): pass", "i = 1", "i < n - 1", "i++"),
        ("for i in range(n < 3): pass", "i = 0", "i < (n < 3)", "i++"),
    ],
)
def test_what_stands_in_the_brackets_of_a_loop(text: str, start: str, test: str, then: str) -> None:
    """Where it begins, how long it goes on, what it counts."""
    assert writer().parts(statement(text)) == {"start": start, "test": test, "then": then}
    assert writer().parts(statement("while n > 1: pass")) == {"test": "n > 1"}
    assert writer().parts(statement("if n: pass")) == {"test": "n"}
    assert writer().parts(statement("a = 1")) == {}


@pytest.mark.parametrize("text", ["for i in x: pass", "for i in range(1, 2, 3): pass", "for i, j in range(3): pass"])
def test_loops_that_c_has_not(text: str) -> None:
    """Over what does not count, by other steps, of several names."""
    with pytest.raises(NotInCError):
        writer().parts(statement(text))


@pytest.mark.parametrize(
    ("given", "count"),
    [
        ("double x[][2], int n", "n"),
        ("double x[][2], struct string *s", "s->count"),
        ("double x[][2], double dt", "1"),
        ("struct string *s, int n", "n"),
        ("int n, struct string *s", "n"),
    ],
)
def test_how_many_masses_there_are(given: str, count: str) -> None:
    """By a whole number that is given, or a string's; else one."""
    assert writer(given=given).count() == count


def test_headers_by_other_names() -> None:
    """Static only once."""
    plain, static = functions_in(
        read("double f(int a)\n{\n    return a;\n}\nstatic int *g(void)\n{\n    return 0;\n}\n").tree
    )
    assert header_of(plain) == "double f(int a)"
    assert header_of(plain, "other") == "static double other(int a)"
    assert header_of(static, "other") == "static int *other(void)"
    assert header_of(static) == "static int *g(void)"
