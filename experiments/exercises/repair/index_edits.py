"""What may stand in place of a part of an array: another index, another range, the whole.

Imports Python's own library only; see `source_edits`.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from experiments.exercises.repair.names import Names
from experiments.exercises.repair.nodes import Replacement, at_place, binary, expression, moved, renewed
from experiments.exercises.repair.value_edits import given_instead

#: Ranges that are taken for each other.
RANGES = ("1:", ":-1", ":", "1:-1", "2:", ":-2", "::-1")


def of_subscript(node: ast.Subscript, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    """Another index at one place, indices swapped, a field in its place, the whole array."""
    index = node.slice
    parts = index.elts if isinstance(index, ast.Tuple) else [index]
    for i, part in enumerate(parts):
        for cost, new in other_indices(part, names):
            yield Replacement("index", cost, with_index(node, i, new))
    if isinstance(index, ast.Tuple) and len(parts) == 2:
        yield Replacement("index", 1.6, renewed(node, slice=renewed(index, elts=parts[::-1])))
    if isinstance(node.ctx, ast.Load):
        yield Replacement("index", 2.2, node.value)
        yield from given_instead(node, names, 2.3)
        yield from _with_another_at_the_end(node, names)
        if isinstance(holder, ast.Assign):
            method = ast.copy_location(ast.Attribute(node, "copy", ast.Load()), node)
            yield Replacement("copy", 1.6, ast.copy_location(ast.Call(method, [], []), node))


def _with_another_at_the_end(node: ast.Subscript, names: Names) -> Iterator[Replacement]:
    """What is above the first mass: a field of what is given, or nothing that moves."""
    index = node.slice
    if isinstance(index, ast.BinOp) and isinstance(index.op, ast.Sub) and isinstance(index.left, ast.Name):
        test = expression(f"{index.left.id} > 0", node)
        nothing = binary(expression("0", node), ast.Mult(), node)
        for other in (nothing, *(expression(text, node) for text in names.values)):
            yield Replacement("condition", 2.2, ast.copy_location(ast.IfExp(test, node, other), node))


def with_index(node: ast.Subscript, place: int, new: ast.expr) -> ast.Subscript:
    """The same array with another index at a place."""
    index = node.slice
    whole = renewed(index, elts=at_place(index.elts, place, new)) if isinstance(index, ast.Tuple) else new
    made: ast.Subscript = renewed(node, slice=whole)
    return made


def other_indices(part: ast.expr, names: Names) -> Iterator[tuple[float, ast.expr]]:
    """What may stand in place of one index, with its cost."""
    if isinstance(part, ast.Slice):
        for text in RANGES:
            made = _index(text, part)
            if ast.dump(made) != ast.dump(part):
                yield 1.3, made
    elif isinstance(part, ast.Constant) and isinstance(part.value, int):
        if part.value == 0:
            yield 1.4, _index(":, None", part)  # of all masses, for that of the first
        for value in (0, 1, -1, part.value + 1, part.value - 1):
            if value != part.value:
                yield 1.2, renewed(part, value=value)
        for loop in names.loops:
            yield 1.5, expression(loop, part)
    elif isinstance(part, ast.BinOp) and isinstance(part.op, ast.Add | ast.Sub):
        yield 1.2, part.left
        yield 1.2, renewed(part, op=ast.Sub() if isinstance(part.op, ast.Add) else ast.Add())
    elif not isinstance(part, ast.UnaryOp):
        yield 1.3, moved(part, -1)
        yield 1.3, moved(part, 1)


def _index(text: str, at: ast.expr) -> ast.expr:
    """What stands between the brackets of a[text]."""
    made = expression(f"a[{text}]", at)
    assert isinstance(made, ast.Subscript)
    return made.slice
