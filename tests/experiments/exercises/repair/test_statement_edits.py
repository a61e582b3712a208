"""What is tried of whole statements: all of it, of a function, with its line and kind."""

from __future__ import annotations

import ast

import pytest

from experiments.exercises.repair.statement_edits import of_statements


def short(body: list[ast.stmt]) -> str:
    """Statements in a row: calls by their names, and what has others in it with these in brackets."""
    return " ".join(map(_short, body))


def _short(one: ast.stmt) -> str:
    match one:
        case ast.Expr(ast.Call(ast.Name(name), [], [])):
            return name
        case ast.For(body=body):
            return f"L({short(body)})"
        case ast.While(body=body):
            return f"W({short(body)})"
        case ast.If(test=test, body=body, orelse=[]):
            return f"[{ast.unparse(test)}]({short(body)})"
        case ast.If(test=test, body=body, orelse=orelse):
            return f"[{ast.unparse(test)}]({short(body)}|{short(orelse)})"
    return f"{ast.unparse(one)};"


def changes(body: str, given: str = "") -> set[tuple[int, str, str]]:
    """Line, kind and text of each change of a function of these lines, of which the first is 1."""
    tree = ast.parse(f"def own({given}):\n" + "\n".join(f" {line}" for line in body.splitlines()))
    (function,) = tree.body
    assert isinstance(function, ast.FunctionDef)
    before, found = ast.unparse(tree), []
    for edit in of_statements(function):
        with edit.applied():
            found.append((edit.line - 1, edit.family, short(ast.parse(ast.unparse(tree)).body[0].body)))  # type: ignore[attr-defined]
        assert 1.0 <= edit.cost <= 3.0
        assert ast.unparse(tree) == before
    assert len(set(found)) == len(found)
    return set(found)


def test_statements_are_moved_into_loops_out_of_them_and_down() -> None:
    """Three statements down at most; the last out of a loop and the next into it; across its beginning; the ends."""
    body = "a()\nb()\nfor i in range(n):\n c()\n d()\ne()\nf()"
    assert changes(body) == {
        # down: the line of what is moved up by one, else of what is moved
        (2, "order", "b a L(c d) e f"),
        (1, "order", "b L(c d) a e f"),
        (1, "order", "b L(c d) e a f"),
        (3, "order", "a L(c d) b e f"),
        (2, "order", "a L(c d) e b f"),
        (2, "order", "a L(c d) e f b"),
        (6, "order", "a b e L(c d) f"),
        (3, "order", "a b e f L(c d)"),
        (7, "order", "a b L(c d) f e"),
        (5, "order", "a b L(d c) e f"),
        # out and in
        (5, "order", "a b L(c) d e f"),
        (6, "order", "a b L(c d e) f"),
        (2, "order", "a L(b c d) e f"),
        (4, "order", "a b c L(d) e f"),
        # only at an end of the loop
        *(
            (line, "condition", f"a b L({inside}) e f")
            for test in ("i > 0", "i == 0", "i < n - 1", "i == n - 1")
            for line, inside in ((4, f"[{test}](c) d"), (5, f"c [{test}](d)"))
        ),
    }


def test_conditions_are_left_out() -> None:
    """Either way; an elif by itself; what stands in them is moved out of them."""
    assert changes("if t:\n a()\n b()\nelif u:\n c()\nelse:\n d()") == {
        (1, "condition", "a b"),
        (1, "condition", "[u](c|d)"),
        (4, "condition", "[t](a b) [u](c|d)"),
        (4, "condition", "[t](a b|c)"),
        (4, "condition", "[t](a b|d)"),
        (3, "order", "[t](a|[u](c|d)) b"),
        (3, "order", "[t](b a|[u](c|d))"),
    }
    assert changes("if t:\n a()") == {(1, "condition", "a"), (1, "condition", "pass;")}
    assert changes("if t:\n a()\nelse:\n b()") == {(1, "condition", "a"), (1, "condition", "b")}


@pytest.mark.parametrize(
    ("over", "tests"),
    [
        ("n", ("i > 0", "i == 0")),
        ("f(n)", ("i > 0", "i == 0")),
        ("range()", ("i > 0", "i == 0", "i < 0 - 1", "i == 0 - 1")),
        ("range(2, m)", ("i > 0", "i == 0", "i < m - 1", "i == m - 1")),
        ("range(2, m, 3)", ("i > 0", "i == 0", "i < m - 1", "i == m - 1")),
    ],
)
def test_the_ends_of_a_loop_are_those_of_its_range(over: str, tests: tuple[str, ...]) -> None:
    """Where there is one; of several names nothing is known, and a condition is not put about another."""
    assert changes(f"for i in {over}:\n a()") == {(2, "condition", f"L([{test}](a))") for test in tests}
    assert changes(f"for i, j in {over}:\n a()") == set()
    assert changes(f"for i in {over}:\n if t:\n  a()") == {(2, "condition", "L(a)"), (2, "condition", "L(pass;)")}


def test_nothing_is_taken_into_what_does_not_count() -> None:
    """The last out of it; from a function nothing."""
    assert changes("while t:\n a()\n b()\nc()") == {
        (3, "order", "W(a) b c"),
        (3, "order", "W(b a) c"),
        (4, "order", "c W(a b)"),
    }


def test_what_is_given_is_copied() -> None:
    """Each, and the first two; never the object itself."""
    assert changes("a()", "x, v, y") == {
        (0, "copy", "x = x.copy(); a"),
        (0, "copy", "v = v.copy(); a"),
        (0, "copy", "y = y.copy(); a"),
        (0, "copy", "x = x.copy(); v = v.copy(); a"),
    }
    assert changes("a()", "self, x") == {(0, "copy", "x = x.copy(); a")}


KEPT = "_x_given = x.copy() if hasattr(x, 'copy') else x;"


def test_what_was_given_is_read_in_place_of_what_it_became() -> None:
    """Each place of a line, and all of it: of a name that is written over, nowhere else."""
    found = {change for change in changes("x = 2 * x\ny = x - 3 * x\nz = y", "x, y") if "_given" in change[-1]}
    keep_y = KEPT.replace("x", "y")
    assert found == {
        (1, "order", f"{KEPT} x = 2 * _x_given; y = x - 3 * x; z = y;"),
        (2, "order", f"{KEPT} x = 2 * x; y = _x_given - 3 * _x_given; z = y;"),
        (2, "order", f"{KEPT} x = 2 * x; y = _x_given - 3 * x; z = y;"),
        (2, "order", f"{KEPT} x = 2 * x; y = x - 3 * _x_given; z = y;"),
        (3, "order", f"{keep_y} x = 2 * x; y = x - 3 * x; z = _y_given;"),
    }


def test_what_was_there_before_a_loop_is_read_in_it() -> None:
    """Of each array that it writes into and reads, and of both; told where it is written and where it is first read."""
    (one,) = [change for change in changes("for i in r:\n x[i] = g(x)") if "_before" in change[-1]]
    assert one == (2, "order", "_x_before = x.copy(); L(x[i] = g(_x_before);)")
    body = "a()\nfor i in r:\n k = f(v)\n x[i] = g(x)\n v[i] = k\n w[i] = k\nb()"
    x, v, w = "x[i] = g(x);", "v[i] = k;", "w[i] = k;"
    found = {change for change in changes(body) if "_before" in change[-1]}
    keep_x, keep_v = "_x_before = x.copy();", "_v_before = v.copy();"
    old_x, old_v = "x[i] = g(_x_before);", "k = f(_v_before);"
    assert found == {
        (4, "order", f"a {keep_x} L(k = f(v); {old_x} {v} {w}) b"),
        (3, "order", f"a {keep_v} L({old_v} {x} {v} {w}) b"),
        (5, "order", f"a {keep_v} L({old_v} {x} {v} {w}) b"),
        (3, "order", f"a {keep_v} {keep_x} L({old_v} {old_x} {v} {w}) b"),
        (5, "order", f"a {keep_v} {keep_x} L({old_v} {old_x} {v} {w}) b"),
    }


@pytest.mark.parametrize(
    ("line", "more"),
    [
        ("k[i] += x", ("[i > 0](k[i - 1] -= x;)", "k[i + 1] -= x;")),
        ("k[i, 2] -= x", ("[i > 0](k[i - 1, 2] += x;)", "k[i + 1, 2] += x;")),
        ("k[i] *= x", ()),
        ("k[3] += x", ()),
        ("k += x", ()),
        ("w = np.roll(x, 1)", ("w[0] = 0.0;", "w[-1] = 0.0;")),
        ("w = 2 * np.empty(3)", ("w[0] = 0.0;", "w[-1] = 0.0;")),
        ("w = empty_like(x)", ("w[0] = 0.0;", "w[-1] = 0.0;")),
        ("w = np.zeros(3)", ()),
        ("w[i] = np.empty(3)", ()),
    ],
)
def test_what_may_be_missing_after_a_statement(line: str, more: tuple[str, ...]) -> None:
    """The other end of a force, the other way; the end of an array that was turned round, or not filled."""
    assert changes(line) == {(1, "left out", f"{line}; {one}") for one in more}
