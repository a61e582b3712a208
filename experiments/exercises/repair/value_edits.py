"""What may stand in place of any value: with another sign, a factor, a term beside it, or a function of it.

Imports Python's own library only; see `source_edits`.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from experiments.exercises.repair.names import MODULES, Names
from experiments.exercises.repair.nodes import Replacement, as_column, binary, called, expression, renewed

#: What single numbers often are called.
SCALARS = ("dt", "h", "m", "mass", "k", "g")


def given_instead(node: ast.expr, names: Names, cost: float) -> Iterator[Replacement]:
    """A field of what is given, in place of a number or another value; of all, and of one."""
    for text in names.values:
        yield Replacement("name", cost, expression(text, node))


def of_value(node: ast.expr, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    """All that holds wherever a value stands.

    Args:
        holder: what it is in: a term of a sum and a factor are taken for other things than an argument.
    """
    in_product = isinstance(holder, ast.BinOp) and not isinstance(holder.op, ast.Pow)
    if in_product or (isinstance(holder, ast.Attribute) and isinstance(node, ast.Name)):
        yield Replacement("factor", 1.8, binary(node, ast.Pow(), expression("2", node)))
    if isinstance(node, ast.List) and len(node.elts) > 1 and isinstance(node.ctx, ast.Load):
        for i in range(len(node.elts)):
            yield Replacement("too much", 1.9, renewed(node, elts=[*node.elts[:i], *node.elts[i + 1 :]]))
    if isinstance(node, ast.Tuple | ast.List | ast.Starred):
        return
    is_term = isinstance(holder, ast.BinOp) and isinstance(holder.op, ast.Add | ast.Sub)
    is_whole = isinstance(holder, ast.Assign | ast.AugAssign | ast.Return | ast.Tuple)
    if is_term or is_whole or isinstance(holder, ast.Call):
        yield Replacement("sign", 1.3, ast.copy_location(ast.UnaryOp(ast.USub(), node), node))
    if is_term or is_whole:
        for text in ("2", "0.5"):
            yield Replacement("factor", 1.7, binary(node, ast.Mult(), expression(text, node)))
        yield from _with_what_is_unread(node, names)
        yield from _later(node, names)
    if is_term or is_whole or isinstance(holder, ast.Compare | ast.BinOp) or _is_root(holder):
        yield from _with_another(node, names)
    if in_product or is_whole:
        yield from _functions_of(node, names, is_whole)
    if in_product and isinstance(node, ast.Name | ast.BinOp | ast.Attribute):
        yield Replacement("left out", 2.2, binary(node, ast.Pow(), expression("0.5", node)))
    if isinstance(holder, ast.Call) and isinstance(node, ast.Name | ast.BinOp):
        yield Replacement("left out", 2.2, called("np.abs" if names.has_numpy else "abs", node))
    if is_whole and isinstance(node, ast.BinOp | ast.Call):
        yield from _projected(node, names)
    if in_product and isinstance(node, ast.Name) and "dt" in names.own:
        yield from _averaged(node, names)


def _is_root(holder: ast.AST) -> bool:
    return isinstance(holder, ast.Call) and ast.unparse(holder.func).split(".")[-1] == "sqrt"


def _later(node: ast.expr, names: Names) -> Iterator[Replacement]:
    """A value a step further on."""
    for name in names.own if "dt" in names.own else ():
        for operator in (ast.Add(), ast.Sub()):
            yield Replacement("left out", 2.3, binary(node, operator, expression(f"dt * {name}", node)))


def _averaged(node: ast.Name, names: Names) -> Iterator[Replacement]:
    """The mean of two values: of two slopes, of which one was forgotten."""
    for name in names.own:
        if name not in (*SCALARS, *names.loops, node.id):
            yield Replacement("left out", 2.3, expression(f"(({node.id} + {name}) / 2)", node))


def _projected(node: ast.expr, names: Names) -> Iterator[Replacement]:
    """A product of two vectors by the square of the length of one of them, by its own name or that of its length."""
    for name in dict.fromkeys(inner.id for inner in ast.walk(node) if isinstance(inner, ast.Name)):
        if name not in MODULES:
            yield Replacement("left out", 2.5, binary(node, ast.Div(), expression(f"({name} @ {name})", node)))
    for name in names.own:
        if name not in (*SCALARS, *names.loops):
            yield Replacement("left out", 2.5, binary(node, ast.Div(), expression(f"{name} ** 2", node)))


def _functions_of(node: ast.expr, names: Names, is_whole: bool) -> Iterator[Replacement]:
    """A column of an array; its length 1; its size, its root, what of it is above or below zero."""
    if not isinstance(node, ast.Name | ast.Attribute | ast.Call | ast.BinOp | ast.Subscript):
        return
    if not names.has_numpy:
        if is_whole:
            yield Replacement("left out", 2.3, called("abs", node))
            yield Replacement("left out", 2.3, binary(node, ast.Pow(), expression("0.5", node)))
            for function in ("min", "max"):
                yield Replacement("left out", 2.4, called(function, node, "0.0"))
        return
    if not is_whole:
        yield Replacement("axis", 1.7, as_column(node))
    if isinstance(node, ast.Name | ast.Call):
        yield Replacement("axis", 2.2, ast.copy_location(ast.Attribute(node, "T", ast.Load()), node))
    if isinstance(node, ast.Name | ast.BinOp):
        for text in ("np.linalg.norm(a)", "np.linalg.norm(a, axis=1, keepdims=True)"):
            norm: ast.Call = renewed(expression(text, node), args=[node])
            yield Replacement("left out", 2.3, binary(node, ast.Div(), norm))
    if is_whole:
        for function in ("np.abs", "np.sqrt"):
            yield Replacement("left out", 2.3, called(function, node))
        for function in ("np.minimum", "np.maximum"):
            yield Replacement("left out", 2.4, called(function, node, "0.0"))


def _with_what_is_unread(node: ast.expr, names: Names) -> Iterator[Replacement]:
    """A factor or a term of what the function is given, and the program never reads."""
    for text in names.unread:
        for operator in (ast.Mult(), ast.Div(), ast.Add(), ast.Sub()):
            yield Replacement("left out", 1.9, binary(node, operator, expression(text, node)))
        for name in names.own:
            for operator in (ast.Sub(), ast.Add()):
                yield Replacement("left out", 2.1, binary(node, operator, expression(f"{text} * {name}", node)))
            for difference in (f"({name} - {text})", f"({name} - {text}[:, None])"):
                yield Replacement("left out", 2.2, binary(node, ast.Mult(), expression(difference, node)))


def _with_another(node: ast.expr, names: Names) -> Iterator[Replacement]:
    """A value times, over, plus or minus another one that the function has."""
    for text in (*names.own, *names.values):
        if isinstance(node, ast.Name) and node.id == text:
            continue
        plain = 2.0 if text in SCALARS or "." in text else 2.4
        for cost, operator in ((0.0, ast.Mult()), (0.1, ast.Div()), (0.3, ast.Add()), (0.3, ast.Sub())):
            family = "factor" if cost < 0.2 else "left out"
            yield Replacement(family, plain + cost, binary(node, operator, expression(text, node)))
