"""The kinds of small mistakes, each a function from a node of a syntax tree to what may stand in its place."""

from __future__ import annotations

import ast
import copy
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from types import MappingProxyType
from typing import Any

#: A piece of the tree, and what is to stand in its place.
Change = tuple[ast.expr | ast.stmt, ast.AST]

#: In place of a comparison: with the border on its other side, and its opposite.
COMPARISONS: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
}

#: In place of an operator of arithmetic or of sets.
OPERATORS: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Mult,
    ast.Mod: ast.FloorDiv,
    ast.Pow: ast.Mult,
    ast.BitAnd: ast.BitOr,
    ast.BitOr: ast.BitAnd,
}

#: What + and * do not calculate with, but join: another operator is no program.
JOINED = (ast.JoinedStr, ast.List, ast.Tuple, ast.ListComp)

#: Functions and methods that are taken for each other.
PAIRS = [("min", "max"), ("minimum", "maximum"), ("argmin", "argmax"), ("any", "all"), ("floor", "ceil")]
PAIRS += [("sin", "cos")]
OTHER = {a: b for pair in PAIRS for a, b in (pair, pair[::-1])}

#: Functions of two numbers, or vectors, that are the same in either order.
EITHER_ORDER = {"min", "max", "minimum", "maximum", "hypot", "vdot", "isclose"}

BUILTIN_TYPES = {"int", "float", "str", "bool", "bytes", "list", "tuple", "dict", "set", "frozenset", "type"}

#: Units, and what is mistaken for them: in brackets in a label, or a text of their own.
UNITS = {"s": "ms", "ms": "s", "m": "mm", "mm": "m", "kg": "g", "N": "kN", "J": "kJ", "N/m": "N/mm", "Hz": "kHz"}
IN_BRACKETS = re.compile(r"(?<=\[)[^\[\]]+(?=\])")


def comparison(node: ast.AST) -> Iterator[Change]:
    """< for <= or >=, == for !=, `is` for `is not`, `in` for `not in`."""
    if isinstance(node, ast.Compare):
        for i, operator in enumerate(node.ops):
            for other in COMPARISONS[type(operator)]:
                yield node, _with(node, ops=[*node.ops[:i], other(), *node.ops[i + 1 :]])


def arithmetic(node: ast.AST) -> Iterator[Change]:
    """+ for -, * for /, & for |, also where they assign; a minus is dropped."""
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        joins = any(isinstance(side, JOINED) or _is_text(side) for side in (node.left, node.right))
        if not joins:
            yield node, _with(node, op=OPERATORS[type(node.op)]())
    elif isinstance(node, ast.AugAssign) and type(node.op) in OPERATORS:
        if not isinstance(node.value, JOINED):
            yield node, _with(node, op=OPERATORS[type(node.op)]())
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub) and not isinstance(node.operand, ast.Constant):
        yield node, node.operand


def whole_number(node: ast.AST) -> Iterator[Change]:
    """One more or one less."""
    if isinstance(node, ast.Constant) and type(node.value) is int:
        yield node, ast.Constant(node.value + 1)
        yield node, ast.Constant(node.value - 1)


def factor(node: ast.AST) -> Iterator[Change]:
    """Ten times as large, or the other sign; 1 in place of 0."""
    if isinstance(node, ast.Constant) and type(node.value) is float:
        yield node, ast.Constant(10 * node.value if node.value else 1.0)
        if node.value:
            yield node, ast.Constant(-node.value)


def swapped_arguments(node: ast.AST) -> Iterator[Change]:
    """Two arguments of the same kind that follow one another, where their order means something."""
    if isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2] not in EITHER_ORDER:
        for args in _swapped(node.args):
            yield node, _with(node, args=args)


def swapped_elements(node: ast.AST) -> Iterator[Change]:
    """Two elements of a tuple that follow one another, as what a function returns or the cells of a table's row."""
    if not isinstance(node, ast.Tuple) or not isinstance(node.ctx, ast.Load):
        return
    # a tuple with a slice in it cannot be written out
    if not any(isinstance(element, ast.Slice) for element in node.elts):
        for elements in _swapped(node.elts):
            yield node, _with(node, elts=elements)


def and_or(node: ast.AST) -> Iterator[Change]:
    """`and` for `or`."""
    if isinstance(node, ast.BoolOp):
        yield node, _with(node, op=ast.Or() if isinstance(node.op, ast.And) else ast.And())


def negation(node: ast.AST) -> Iterator[Change]:
    """`not` or ~ dropped, or put before a condition that is not a comparison."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not | ast.Invert):
        yield node, node.operand
    elif isinstance(node, ast.If | ast.While | ast.IfExp) and isinstance(
        node.test, ast.Name | ast.Attribute | ast.Call | ast.Subscript
    ):
        yield node.test, ast.UnaryOp(ast.Not(), node.test)


def dropped_copy(node: ast.AST) -> Iterator[Change]:
    """Without .copy()."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "copy":
        yield node, node.func.value


def unstable_sort(node: ast.AST) -> Iterator[Change]:
    """Without kind="stable"."""
    if isinstance(node, ast.Call):
        others = [keyword for keyword in node.keywords if ast.unparse(keyword) != "kind='stable'"]
        if others != node.keywords:
            yield node, _with(node, keywords=others)


def opposite(node: ast.AST) -> Iterator[Change]:
    """`min` for `max` and their like, as functions and as methods."""
    if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load) and node.id in OTHER:
        yield node, ast.Name(OTHER[node.id])
    elif isinstance(node, ast.Attribute) and node.attr in OTHER:
        yield node, _with(node, attr=OTHER[node.attr])


def first_last(node: ast.AST) -> Iterator[Change]:
    """[0] for [-1], and an index that is a variable becomes 0."""
    if isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Load):
        index = ast.unparse(node.slice)
        if index in ("0", "-1"):
            yield node, _with(node, slice=ast.parse("-1" if index == "0" else "0", mode="eval").body)
        elif index in ("i", "j", "k"):
            yield node, _with(node, slice=ast.Constant(0))


def truth(node: ast.AST) -> Iterator[Change]:
    """True for False."""
    if isinstance(node, ast.Constant) and isinstance(node.value, bool):
        yield node, ast.Constant(not node.value)


def unit(node: ast.AST) -> Iterator[Change]:
    """[ms] for [s] in a label."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        if (other := _other_unit(node.value)) != node.value:
            yield node, ast.Constant(other)
    elif isinstance(node, ast.JoinedStr):
        for i, part in enumerate(node.values):
            if isinstance(part, ast.Constant) and (other := _other_unit(part.value)) != part.value:
                yield node, _with(node, values=[*node.values[:i], ast.Constant(other), *node.values[i + 1 :]])


#: All kinds of mistakes by the name they are reported with.
KINDS: Mapping[str, Callable[[ast.AST], Iterator[Change]]] = MappingProxyType(
    {
        kind.__name__.replace("_", " "): kind
        for kind in (
            comparison,
            arithmetic,
            whole_number,
            factor,
            swapped_arguments,
            swapped_elements,
            and_or,
            negation,
            dropped_copy,
            unstable_sort,
            opposite,
            first_last,
            truth,
            unit,
        )
    }
)


def is_type(node: ast.AST) -> bool:
    """Whether an expression is a type, by its name: float, None, Array, Mapping[str, int], int | None."""
    if isinstance(node, ast.BinOp):
        return isinstance(node.op, ast.BitOr) and is_type(node.left) and is_type(node.right)
    if isinstance(node, ast.Subscript):
        return is_type(node.value)
    if isinstance(node, ast.Constant):
        return node.value is None
    name = node.attr if isinstance(node, ast.Attribute) else node.id if isinstance(node, ast.Name) else ""
    return name in BUILTIN_TYPES or re.fullmatch(r"_?[A-Z]+[a-z]\w*", name) is not None


def _swapped(nodes: Sequence[ast.expr]) -> Iterator[list[ast.expr]]:
    """The nodes with two neighbours swapped that are alike in kind and not the same."""
    for i, (a, b) in enumerate(pairwise(nodes)):
        alike = type(a) is type(b) and isinstance(a, ast.Name | ast.Attribute | ast.Subscript | ast.Call)
        if alike and ast.unparse(a) != ast.unparse(b) and not is_type(a):
            yield [*nodes[:i], b, a, *nodes[i + 2 :]]


def _other_unit(text: str) -> str:
    return UNITS.get(text) or IN_BRACKETS.sub(lambda found: UNITS.get(found[0], found[0]), text)


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _with(node: ast.AST, **fields: Any) -> ast.AST:
    """The node with some fields set otherwise."""
    other = copy.copy(node)
    for name, value in fields.items():
        setattr(other, name, value)
    return other
