"""What is tried in place of an expression or a simple statement: all that belongs to its kind of node."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest

from experiments.exercises.repair.expression_edits import KINDS, replacements
from experiments.exercises.repair.names import Names
from experiments.exercises.repair.nodes import Replacement
from tests.experiments.exercises.repair.tried import NAMES, costs, tried

FEW = replace(NAMES, own=["a", "b", "i"], fields={"s": ["mass", "drag"]})


def of_its_kind(node: Any, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    """What its kind of node is changed to, without what holds for all values."""
    return KINDS[type(node)](node, names, holder)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("a + b", {"sign": {"a - b"}, "operator": {"a * b"}, "too much": {"a", "b"}}),
        ("a - b", {"sign": {"a + b"}, "operator": {"a * b"}, "too much": {"a", "b"}, "order": {"b - a"}}),
        ("a * b", {"operator": {"a / b", "a + b", "a - b", "a @ b"}, "too much": {"a", "b"}}),
        ("a / b", {"operator": {"a * b", "a - b"}, "too much": {"a", "b"}, "order": {"b / a"}}),
        ("a ** b", {"operator": {"a * b"}, "too much": {"a", "b"}, "order": {"b ** a"}}),
        ("a @ b", {"operator": {"a * b"}, "too much": {"a", "b"}, "order": {"b @ a"}}),
        ("a // b", {"operator": {"a / b"}, "too much": {"a", "b"}}),
        ("a % b", {"operator": {"a / b"}, "too much": {"a", "b"}}),
        ("a << b", {"too much": {"a", "b"}}),
        (
            "a - b * i",
            {
                "sign": {"a + b * i"},
                "operator": {"a * (b * i)"},
                "too much": {"a", "b * i"},
                "order": {"b * i - a", "(a - b) * i"},
            },
        ),
        (
            "(a - b) * i",
            {
                "operator": {"(a - b) / i", "a - b + i", "a - b - i", "(a - b) @ i"},
                "too much": {"a - b", "i"},
                "order": {"a - b * i"},
            },
        ),
        ("-a", {"sign": {"a"}}),
        ("not a", {"condition": {"a"}}),
        ("+a", {}),
        (
            "a < b <= i",
            {
                "condition": {f"a {one} b <= i" for one in (">", "<=", ">=")}
                | {f"a < b {one} i" for one in (">=", "<", ">")}
            },
        ),
        ("a > b", {"condition": {"a < b", "a >= b", "a <= b"}}),
        ("a >= b", {"condition": {"a <= b", "a > b", "a < b"}}),
        ("a == b", {"condition": {"a != b", "a < b", "a > b"}}),
        ("a != b", {"condition": {"a == b", "a < b", "a > b"}}),
        ("a in b", {}),
        ("a and b and i", {"condition": {"a or b or i", "a", "b", "i"}}),
        ("a or b", {"condition": {"a and b", "a", "b"}}),
        ("a if b else i", {"condition": {"a", "i"}}),
        ("True", {"condition": {"False"}}),
        ("3", {"factor": {"4", "2", "6", "1.5", "-3", "0", "1"}}),
        ("0.5", {"factor": {"1.5", "-0.5", "1.0", "0.25", "0", "2"}, "name": {"s.mass", "s.drag"}}),
        ("1000000.0", {"name": {"s.mass", "s.drag"}}),
        ("'text'", {}),
        ("b", {"name": {"a", "i"}}),
        ("np.sin", {"name": {"np.cos", "np.tan"}}),
        ("s.mass", {"name": {"s.drag"}}),
        ("s.other", {"name": {"s.mass", "s.drag"}}),
        ("a.s.mass", {}),
        ("s.anchor", {"name": {"s.mass", "s.drag"}, "condition": {"x[i - 1] if i > 0 else s.anchor"}}),
        ("a.T", {"axis": {"a"}}),
        ("(a, b, i)", {"order": {"(b, a, i)", "(i, b, a)", "(a, i, b)"}}),
        ("[a, b]", {"order": {"[b, a]"}}),
        ("(a,)", {}),
        ("(a, b, i, a, b)", {}),
    ],
)
def test_an_expression_is_taken_for_another(text: str, found: dict[str, set[str]]) -> None:
    """Operators, sides, brackets, conditions, numbers, names, items."""
    assert tried(of_its_kind, f"return {text}", text, FEW) == found


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("a += b", {"sign": {"a -= b"}, "operator": {"a *= b", "a = b"}, "copy": {"a = a + b"}}),
        ("x[0] /= b", {"operator": {"x[0] *= b", "x[0] -= b", "x[0] = b"}, "copy": {"x[0] = x[0] / b"}}),
        ("a = b", {"operator": {"a += b", "a -= b"}}),
        ("x[0] = b", {"operator": {"x[0] += b", "x[0] -= b"}}),
        ("a = i = b", {}),
        ("a.y = b", {}),
        ("a, i = b", {}),
    ],
)
def test_a_statement_keeps_another_value_or_none(text: str, found: dict[str, set[str]]) -> None:
    """Added to, in place of, a new array; or it is not there at all."""
    assert tried(of_its_kind, text, text, FEW) == found
    assert tried(replacements, text, text, FEW) == {**found, "too much": {"pass"}}


def test_what_holds_for_values_is_tried_of_values_only() -> None:
    """Not of numbers, of what has a sign, of comparisons and ranges, of names that are written, of statements."""
    for node in ("3", "-a", "a < b"):
        assert tried(replacements, f"return {node}", node, FEW) == tried(of_its_kind, f"return {node}", node, FEW)
    for text, node in (("return x[1:]", "1:"), ("a = 3", "a"), ("return 3", "return 3")):
        assert tried(replacements, text, node, FEW) == {}
    for node in ("f(3)", "a", "s.mass", "a * b", "x[0]", "a and b", "a if b else i"):
        assert f"-{node}" in {
            one.replace("(" + node + ")", node) for one in tried(replacements, f"return {node}", node, FEW)["sign"]
        }


def test_a_name_that_is_kept_may_need_a_copy() -> None:
    """Where it is given another name; not where it is returned, and not where it is written."""
    assert tried(of_its_kind, "i = b", "b", FEW) == {"name": {"a", "i"}, "copy": {"b.copy()"}}
    assert tried(of_its_kind, "b = i", "b", FEW) == {}


def test_likelier_ones_cost_less() -> None:
    """The first operators of a row; numbers that are off by one; only a side left out, and the second at that."""
    for text, *new in (
        ("a * b", "a / b", "a + b", "a - b", "a @ b"),
        ("a - b", "a + b", "a * b", "a"),
        ("a + b", "a - b", "a", "b"),
        ("3", "4", "6"),
        ("3", "2", "0"),
    ):
        found = costs(of_its_kind, f"return {text}", text, FEW)
        assert [found[one] for one in new] == sorted({found[one] for one in new}), text
    numbers = costs(of_its_kind, "return 3", "3", FEW)
    assert numbers["4"] == numbers["2"]
