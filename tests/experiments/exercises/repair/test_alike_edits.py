"""The same change at several places: where places are alike, what is tried there, on which line and at what cost."""

from __future__ import annotations

import ast

import pytest

from experiments.exercises.repair.alike_edits import of_alike
from experiments.exercises.repair.names import Names

NAMES = Names(own=["a"], fields={"s": ["c"]}, unread=[], loops=[], arrays=[], has_numpy=False)


def changes(body: str, names: Names = NAMES) -> dict[str, set[tuple[int, str]]]:
    """By kind, line and text of all changes at several places, of a function's lines, of which the first is 1."""
    tree = ast.parse("def own():\n" + "\n".join(f" {line}" for line in body.splitlines()))
    found: dict[str, set[tuple[int, str]]] = {}
    for edit in of_alike(tree.body[0], names):
        assert 1.0 < edit.cost <= 3.0
        with edit.applied():
            text = ast.unparse(ast.parse(ast.unparse(tree)).body[0].body)  # type: ignore[attr-defined]
        found.setdefault(edit.family, set()).add((edit.line - 1, text.strip().replace("\n", "; ")))
    return found


def on(line: int, *texts: str) -> set[tuple[int, str]]:
    """These, on a line."""
    return {(line, text) for text in texts}


def test_what_a_statement_has_twice_is_changed_at_both_places() -> None:
    """Another value, its distance from a field, another index; not the function that is called."""
    found = changes("g()\nw = f(x[1]) + f(x[1])")
    assert found == {
        "name": on(
            2,
            *(f"g(); w = {new} + {new}" for new in ("a", "s.c", "f(a)", "f(s.c)", "f(a[1])", "f(s.c[1])")),
        ),
        "left out": on(
            2,
            *(
                f"g(); w = {first} + {second}"
                for first, second in (
                    ("f(x[1]) - s.c", "(f(x[1]) - s.c)"),
                    ("f(x[1] - s.c)", "f(x[1] - s.c)"),
                    ("f((x - s.c)[1])", "f((x - s.c)[1])"),
                )
            ),
        ),
        "index": on(2, *(f"g(); w = f({new}) + f({new})" for new in ("x[0]", "x[-1]", "x[2]"))),
    }


@pytest.mark.parametrize("statement", ["w = {}", "w += {}", "return {}", "f({})"])
def test_it_is_so_in_every_statement_that_has_a_value(statement: str) -> None:
    """Kept, added, returned, or only done; nothing where all are different."""
    assert changes(statement.format("z * z"))["name"] == on(
        1, *(statement.format(f"{new} * {new}") for new in ("a", "s.c"))
    )
    assert changes(statement.format("y * z")) == {}
    assert changes(statement.format("3 * 3")) == {}
    for begin in ("if t:", "if t:\n  g()\nelse:"):
        assert changes(f"{begin}\n  {statement.format('z * z')}")["name"]


@pytest.mark.parametrize(
    ("parts", "index"),
    [
        # the first range is the same in both, the second is another one
        (
            ("k[:-1, 1:]", "k[:-1, 2:]"),
            {(f"k[{new}, 1:]", f"k[{new}, 2:]") for new in ("1:", ":", "1:-1", "2:", ":-2", "::-1")},
        ),
        (("k[1, 2]", "k[3, 2]"), {(f"k[1, {new}]", f"k[3, {new}]") for new in ("0", "1", "-1", "3")}),
        (("k[5]", "k[5, 2]"), {(f"k[{new}]", f"k[{new}, 2]") for new in ("0", "1", "-1", "6", "4")}),
        (("k[1:]", "k[2:]"), set()),
        (("k[1, 2]", "q[1, 3]"), set()),
    ],
)
def test_parts_of_one_array_side_by_side_get_the_same_other_range(
    parts: tuple[str, str], index: set[tuple[str, str]]
) -> None:
    """At a place that both have, where the same stands in both."""
    found = changes("g()\nw = f({}, {})".format(*parts)).get("index", set())
    assert found == on(2, *("g(); w = f({}, {})".format(*new) for new in index))
    assert changes("w = f({}) + f({})".format(*parts)).get("index", set()) == set()  # not side by side


def test_rows_that_are_alike_are_changed_in_the_same_way() -> None:
    """Numbers, operators and values, each as it is there; told on the first line. Names only where all are one."""
    found = changes("x = 3 * p\ny = 5 * q", Names([], {}, [], [], [], False))
    assert found["operator"] >= on(1, *(f"x = 3 {new} p; y = 5 {new} q" for new in "/+-@"), "x += 3 * p; y += 5 * q")
    assert found["too much"] >= on(1, "x = 3; y = 5", "x = p; y = q", "pass; pass")
    assert found["sign"] == on(1, "x = -(3 * p); y = -(5 * q)")
    assert "name" not in found
    same = changes("x = 3 * p\ny = 5 * p")
    assert on(1, "x = 3 * a; y = 5 * a") <= same["name"]
    assert not on(1, "a = 3 * p; a = 5 * p") & same["name"]
    numbers = zip(("4", "2", "6", "1.5", "-3", "0", "1"), ("5", "3", "8", "2.0", "-4", "0", "1"), strict=True)
    assert (
        on(1, *(f"x = {one} * p; y = {other} * q" for one, other in numbers))
        <= changes("x = 3 * p\ny = 4 * q")["factor"]
    )


def test_rows_are_two_to_four_of_one_shape_one_below_the_other() -> None:
    """Not of calls alone, not with another between them, and each of them is in step with the others."""

    def rows(body: str) -> set[str]:
        return {text for _, text in changes(body).get("sign", set())}

    def row(signs: str) -> str:
        return "; ".join(f"x{i} = {sign.strip('+')}p.z" for i, sign in enumerate(signs))

    five = "\n".join(f"x{i} = p.z" for i in range(5))
    wanted = {row("+" * i + "-" * count + "+" * (5 - i - count)) for count in (2, 3, 4) for i in range(6 - count)}
    assert rows(five) == wanted
    assert rows("x = p.z\ny = p.z + q\nz = p.z") == set()
    assert rows("f(p.z)\nf(p.z)") == set()
    assert rows("x = p.z\ng()\ny = p.z") == set()
    assert rows("g()\nx = p.z\ny = p.z") == {"g(); x = -p.z; y = -p.z"}
    both = changes("for i in r:\n  x = p.z\n  y = q.z")
    assert (2, "for i in r:;     x = -p.z;     y = -q.z") in both["sign"]


def test_each_place_more_costs_as_much_more() -> None:
    """Of the same change."""
    tree = ast.parse("def own():\n x = p.w\n y = p.w\n z = p.w\n")
    costs = {len(e.sites): e.cost for e in of_alike(tree.body[0], NAMES) if e.family == "sign"}
    assert costs[3] - costs[2] == pytest.approx(0.1)
    assert costs[2] == pytest.approx(1.3 + 0.1)
