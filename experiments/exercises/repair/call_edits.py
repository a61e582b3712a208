"""What may stand in place of the call of a function: other arguments, another axis, another size.

Imports Python's own library only; see `source_edits`.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from experiments.exercises.repair.names import Names
from experiments.exercises.repair.nodes import Replacement, at_place, binary, expression, function_name, moved, renewed
from experiments.exercises.repair.value_edits import given_instead

#: Functions that go along an axis, or over all.
ALONG_AN_AXIS = ("norm", "sum", "mean", "max", "min", "cumsum", "diff")

#: What an axis is taken for.
OTHER_AXES = {"0": "1", "1": "0", "-1": "0"}

#: Those that make an array of an array, of whole numbers where it has such; those that make one of a size.
OF_ITS_KIND = ("zeros_like", "ones_like", "array", "zeros", "asarray")
OF_A_SIZE = ("zeros", "ones", "empty", "full")


def of_call(node: ast.Call, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    """Arguments left out, swapped, shifted; and what belongs to the function that is called."""
    name = function_name(node)
    yield from _of_arguments(node)
    yield from _of_keywords(node)
    if name == "array" or not node.args:
        yield from given_instead(node, names, 2.0)
    if name in ("mean", "sum", "max", "min"):
        yield from _of_one(node, names)
    if name in ("sin", "cos", "tan") and node.args:
        for factor in ("0.017453292519943295", "57.29577951308232"):
            yield Replacement("factor", 1.6, renewed(node, args=[_times(node.args[0], factor)]))
    if name in ("arctan", "atan"):
        yield from _of_two_sides(node, name)
    if name in ALONG_AN_AXIS and not any(k.arg == "axis" for k in node.keywords):
        for axis in ("1", "0"):
            yield Replacement("axis", 1.5, _with_keywords(node, axis=axis))
            yield Replacement("axis", 1.6, _with_keywords(node, axis=axis, keepdims="True"))
    if name in OF_A_SIZE:
        yield from _other_sizes(node, names)
    if name in OF_ITS_KIND and not any(k.arg == "dtype" for k in node.keywords):
        yield Replacement("copy", 1.6, _with_keywords(node, dtype="float"))
    if name == "eigvalsh" and isinstance(node.func, ast.Attribute):
        yield Replacement("name", 1.5, renewed(node, func=renewed(node.func, attr="eigvals")))
    if name == "range":
        yield from _of_range(node)


def _of_arguments(node: ast.Call) -> Iterator[Replacement]:
    for argument in node.args:
        if not isinstance(argument, ast.Starred):
            yield Replacement("too much", 1.9, argument)
    for i, (one, other) in enumerate(zip(node.args, node.args[1:], strict=False)):
        swapped = at_place(at_place(node.args, i, other), i + 1, one)
        yield Replacement("order", 1.7, renewed(node, args=swapped))


def _of_keywords(node: ast.Call) -> Iterator[Replacement]:
    for i, keyword in enumerate(node.keywords):
        yield Replacement("too much", 2.0, renewed(node, keywords=[*node.keywords[:i], *node.keywords[i + 1 :]]))
        axis = OTHER_AXES.get(ast.unparse(keyword.value)) if keyword.arg == "axis" else None
        if axis is not None:
            other = renewed(keyword, value=expression(axis, node))
            yield Replacement("axis", 1.2, renewed(node, keywords=at_place(node.keywords, i, other)))


def _of_one(node: ast.Call, names: Names) -> Iterator[Replacement]:
    """That of the mass whose turn it is, in place of the mean or the sum of all."""
    whole = node.args[0] if node.args else node.func.value if isinstance(node.func, ast.Attribute) else node
    for loop in names.loops:
        yield Replacement(
            "index", 1.9, ast.copy_location(ast.Subscript(whole, expression(loop, node), ast.Load()), node)
        )


def _of_two_sides(node: ast.Call, name: str) -> Iterator[Replacement]:
    """arctan2(a, b) for arctan(a / b)."""
    ratio = node.args[0] if node.args else None
    if isinstance(ratio, ast.BinOp) and isinstance(ratio.op, ast.Div):
        function = renewed(node.func, **{"attr" if isinstance(node.func, ast.Attribute) else "id": f"{name}2"})
        yield Replacement("name", 1.3, renewed(node, func=function, args=[ratio.left, ratio.right]))


def _of_range(node: ast.Call) -> Iterator[Replacement]:
    """One more or one less at each end, and from the beginning or from 1."""
    for i, argument in enumerate(node.args):
        for by in (1, -1):
            yield Replacement("index", 1.3, renewed(node, args=at_place(node.args, i, moved(argument, by))))
    if len(node.args) == 1:
        yield Replacement("index", 1.3, renewed(node, args=[expression("1", node), *node.args]))
    elif len(node.args) == 2:
        yield Replacement("index", 1.4, renewed(node, args=node.args[1:]))


def _other_sizes(node: ast.Call, names: Names) -> Iterator[Replacement]:
    """An array of another size: a length that is a multiple of a name, or a few longer."""
    shape = node.args[0] if node.args else None
    lengths = shape.elts if isinstance(shape, ast.Tuple | ast.List) else [shape] if shape is not None else []
    for i, length in enumerate(lengths):
        longer = [moved(length, n) for n in (1, 2, 3)]
        times = [_times(length, name) for name in names.own]
        for new in (*longer, *times):
            whole = renewed(shape, elts=at_place(lengths, i, new)) if shape is not length else new
            yield Replacement("factor", 1.6, renewed(node, args=[whole, *node.args[1:]]))


def _times(node: ast.expr, text: str) -> ast.BinOp:
    return binary(node, ast.Mult(), expression(text, node))


def _with_keywords(node: ast.Call, **texts: str) -> ast.Call:
    """The call with more arguments, by their names."""
    more = [ast.copy_location(ast.keyword(name, expression(text, node)), node) for name, text in texts.items()]
    made: ast.Call = renewed(node, keywords=[*node.keywords, *more])
    return made
