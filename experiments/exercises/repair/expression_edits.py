"""What may stand in place of an expression, or of a statement by itself, if its writer meant something else.

Each kind of node has a function of its own; what holds for all values is in `value_edits`. Imports Python's own
library only; see `source_edits`.
"""

from __future__ import annotations

import ast
import copy
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from experiments.exercises.repair.call_edits import of_call
from experiments.exercises.repair.index_edits import of_subscript
from experiments.exercises.repair.names import Names
from experiments.exercises.repair.nodes import Replacement, at_place, expression, renewed
from experiments.exercises.repair.value_edits import given_instead, of_value

#: Operators that are taken for each other, likelier ones first.
OPERATORS: Mapping[type[ast.operator], tuple[type[ast.operator], ...]] = {
    ast.Add: (ast.Sub, ast.Mult),
    ast.Sub: (ast.Add, ast.Mult),
    ast.Mult: (ast.Div, ast.Add, ast.Sub, ast.MatMult),
    ast.Div: (ast.Mult, ast.Sub),
    ast.FloorDiv: (ast.Div,),
    ast.Pow: (ast.Mult,),
    ast.Mod: (ast.Div,),
    ast.MatMult: (ast.Mult,),
}

#: The same of comparisons.
COMPARISONS: Mapping[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.Gt, ast.LtE, ast.GtE),
    ast.Gt: (ast.Lt, ast.GtE, ast.LtE),
    ast.LtE: (ast.GtE, ast.Lt, ast.Gt),
    ast.GtE: (ast.LtE, ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq, ast.Lt, ast.Gt),
    ast.NotEq: (ast.Eq, ast.Lt, ast.Gt),
}

#: Functions, and methods, that are taken for each other.
ALIKE = (
    ("sin", "cos", "tan"),
    ("arcsin", "arccos", "arctan"),
    ("sum", "mean"),
    ("argmax", "argmin"),
    ("max", "min"),
    ("maximum", "minimum"),
    ("tile", "repeat"),
    ("any", "all"),
    ("zeros_like", "ones_like"),
    ("zeros", "ones"),
    ("vstack", "hstack"),
    ("deg2rad", "rad2deg"),
    ("radians", "degrees"),
    ("append", "extend"),
    ("dot", "outer"),
    ("union", "intersection"),
)
OTHER_FUNCTIONS = {name: [other for other in group if other != name] for group in ALIKE for name in group}


def replacements(node: ast.AST, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    """What may stand in place of a node.

    Args:
        holder: what the node is in.
    """
    kind = KINDS.get(type(node))
    if kind is not None:
        yield from kind(node, names, holder)
    if isinstance(node, ast.Expr | ast.Assign | ast.AugAssign):
        yield Replacement("too much", 2.5, ast.copy_location(ast.Pass(), node))
    written = isinstance(getattr(node, "ctx", None), ast.Store)
    if isinstance(node, ast.expr) and not written and not isinstance(node, NO_VALUES):
        yield from of_value(node, names, holder)


#: What no value is made of by a sign, a factor or a term beside it.
NO_VALUES = (ast.Constant, ast.UnaryOp, ast.Slice, ast.Compare)


def _of_operator(node: ast.BinOp | ast.AugAssign) -> Iterator[Replacement]:
    """Another one, likelier ones first: plus and minus are signs."""
    for i, other in enumerate(OPERATORS.get(type(node.op), ())):
        family = "sign" if {type(node.op), other} == {ast.Add, ast.Sub} else "operator"
        yield Replacement(family, 1.0 + 0.3 * i, renewed(node, op=other()))


def _of_operation(node: ast.BinOp, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    yield from _of_operator(node)
    yield Replacement("too much", 1.5, node.left)
    yield Replacement("too much", 1.8, node.right)
    if isinstance(node.op, ast.Sub | ast.Div | ast.Pow | ast.MatMult):
        yield Replacement("order", 1.4, renewed(node, left=node.right, right=node.left))
    # the other way to set brackets: (a - b) * c for a - b * c, and so on
    if isinstance(node.left, ast.BinOp):
        yield Replacement("order", 1.5, renewed(node.left, right=renewed(node, left=node.left.right)))
    if isinstance(node.right, ast.BinOp):
        yield Replacement("order", 1.5, renewed(node.right, left=renewed(node, right=node.right.left)))


def _of_sign(node: ast.UnaryOp, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    if isinstance(node.op, ast.USub | ast.Not):
        yield Replacement("sign" if isinstance(node.op, ast.USub) else "condition", 1.0, node.operand)


def _of_comparison(node: ast.Compare, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    for i, compared in enumerate(node.ops):
        for other in COMPARISONS.get(type(compared), ()):
            yield Replacement("condition", 1.2, renewed(node, ops=at_place(node.ops, i, other())))


def _of_conditions(node: ast.BoolOp, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    other_way: ast.boolop = ast.Or() if isinstance(node.op, ast.And) else ast.And()
    yield Replacement("condition", 1.3, renewed(node, op=other_way))
    for value in node.values:
        yield Replacement("condition", 2.0, value)


def _of_choice(node: ast.IfExp, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    yield Replacement("condition", 2.0, node.body)
    yield Replacement("condition", 2.0, node.orelse)


def _of_number(node: ast.Constant, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    value = node.value
    if isinstance(value, bool):
        yield Replacement("condition", 1.3, renewed(node, value=not value))
    elif isinstance(value, int | float) and abs(value) < 1e6:
        for new in dict.fromkeys((value + 1, value - 1, 2 * value, value / 2, -value, 0, 1, 2)):
            if new != value:
                yield Replacement("factor", 1.3 if abs(new - value) == 1 else 1.6, renewed(node, value=new))
    if isinstance(value, float):
        yield from given_instead(node, names, 1.9)


def _of_name(node: ast.Name, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    if isinstance(node.ctx, ast.Load):
        for other in names.own:
            if other != node.id:
                yield Replacement("name", 2.2, renewed(node, id=other))
        if isinstance(holder, ast.Assign):
            yield Replacement("copy", 1.5, expression(f"{node.id}.copy()", node))


def _of_attribute(node: ast.Attribute, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    for other in OTHER_FUNCTIONS.get(node.attr, ()):
        yield Replacement("name", 1.4, renewed(node, attr=other))
    if isinstance(node.value, ast.Name) and node.attr not in OTHER_FUNCTIONS:
        for other in names.fields.get(node.value.id, ()):
            if other != node.attr:
                yield Replacement("name", 1.8, renewed(node, attr=other))
    if node.attr == "anchor":
        yield from _of_the_last(node, names)
    if node.attr == "T":
        yield Replacement("axis", 1.4, node.value)


def _of_the_last(node: ast.Attribute, names: Names) -> Iterator[Replacement]:
    """The one before, of all but the first: only the first hangs on the anchor."""
    for loop in names.loops:
        for array in names.arrays:
            one = expression(f"{array}[{loop} - 1]", node)
            chosen = ast.copy_location(ast.IfExp(expression(f"{loop} > 0", node), one, node), node)
            yield Replacement("condition", 2.1, chosen)


def _of_items(node: ast.Tuple | ast.List, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    """Two of them in each other's place."""
    if 2 <= len(node.elts) <= 4:
        for i in range(len(node.elts)):
            for j in range(i):
                swapped = at_place(at_place(node.elts, i, node.elts[j]), j, node.elts[i])
                yield Replacement("order", 1.6, renewed(node, elts=swapped))


def _of_augmented(node: ast.AugAssign, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    """Another operator; only the new value; a = a + b for a += b, which makes a new array."""
    yield from _of_operator(node)
    yield Replacement("operator", 1.6, ast.copy_location(ast.Assign([node.target], node.value), node))
    read: Any = copy.deepcopy(node.target)
    read.ctx = ast.Load()
    anew = ast.copy_location(ast.BinOp(read, node.op, node.value), node)
    yield Replacement("copy", 1.4, ast.copy_location(ast.Assign([node.target], anew), node))


def _of_assignment(node: ast.Assign, names: Names, holder: ast.AST) -> Iterator[Replacement]:
    """The value added to what there was, or taken from it."""
    match node.targets:
        case [ast.Name() | ast.Subscript() as target]:
            for operator in (ast.Add(), ast.Sub()):
                yield Replacement("operator", 1.6, ast.copy_location(ast.AugAssign(target, operator, node.value), node))


#: What is done by the kind of a node.
KINDS: Mapping[type[ast.AST], Callable[[Any, Names, ast.AST], Iterator[Replacement]]] = {
    ast.BinOp: _of_operation,
    ast.UnaryOp: _of_sign,
    ast.Compare: _of_comparison,
    ast.BoolOp: _of_conditions,
    ast.IfExp: _of_choice,
    ast.Constant: _of_number,
    ast.Name: _of_name,
    ast.Attribute: _of_attribute,
    ast.Subscript: of_subscript,
    ast.Call: of_call,
    ast.Tuple: _of_items,
    ast.List: _of_items,
    ast.AugAssign: _of_augmented,
    ast.Assign: _of_assignment,
}
