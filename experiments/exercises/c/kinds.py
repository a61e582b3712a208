"""Of which kind the values of a C program are: what the compiler would refuse, or what makes no sense, is not tried."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import NamedTuple


class Kind(NamedTuple):
    """What a name stands for.

    Attributes:
        base: number, whole (number), a struct, or another type; "" where it is not known.
        depth: how many indices lead to one of these; -1 where it is not known.
    """

    base: str
    depth: int


#: By name.
Kinds = dict[str, Kind]

UNKNOWN, NUMBER, WHOLE = Kind("", -1), Kind("number", 0), Kind("whole", 0)


def kind_in(node: ast.AST, kinds: Mapping[str, Kind], fields: Mapping[str, Kind]) -> Kind:
    """The kind of an expression's value, as far as it can be told."""
    if isinstance(node, ast.Name):
        return kinds.get(node.id, UNKNOWN)
    if isinstance(node, ast.Constant):
        return WHOLE if isinstance(node.value, int) else NUMBER
    if isinstance(node, ast.Attribute):
        of = kind_in(node.value, kinds, fields)
        if node.attr == "at":
            return Kind(of.base, of.depth - 1) if of.depth > 0 else UNKNOWN
        return fields.get(f"{of.base}.{node.attr}", UNKNOWN)
    if isinstance(node, ast.Subscript):
        of = kind_in(node.value, kinds, fields)
        count = len(node.slice.elts) if isinstance(node.slice, ast.Tuple) else 1
        return Kind(of.base, of.depth - count) if of.depth >= count else UNKNOWN
    if isinstance(node, ast.BinOp):
        both = [kind_in(side, kinds, fields) for side in (node.left, node.right)]
        deeper = max(both, key=lambda kind: kind.depth)
        if isinstance(node.op, ast.Pow):
            return NUMBER
        return deeper if deeper.depth > 0 or both[0] == both[1] else NUMBER if NUMBER in both else UNKNOWN
    if isinstance(node, ast.Compare | ast.BoolOp):
        return WHOLE
    if isinstance(node, ast.UnaryOp):
        return WHOLE if isinstance(node.op, ast.Not) else kind_in(node.operand, kinds, fields)
    if isinstance(node, ast.IfExp):
        return kind_in(node.body, kinds, fields)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        return _of_call(node, node.func.id)
    return UNKNOWN


def _of_call(node: ast.Call, name: str) -> Kind:
    if name.startswith("("):
        return NUMBER if name in ("(double)", "(float)") else UNKNOWN
    if name in ("abs", "min", "max", "sqrt", "pow", "hypot", "sin", "cos", "tan", "atan", "atan2", "floor", "ceil"):
        return NUMBER
    if name in ("malloc", "calloc", "realloc"):
        return Kind("void", 1)
    return WHOLE if name in ("abs_c_", "sizeof") else UNKNOWN


def may_replace(
    new: ast.AST, old: ast.AST, is_index: bool, kinds: Mapping[str, Kind], fields: Mapping[str, Kind]
) -> bool:
    """Whether one expression may stand where the other does, as far as is known.

    Args:
        is_index: whether it is in one, which is a whole number.
    """
    before, then = kind_in(old, kinds, fields), kind_in(new, kinds, fields)
    if is_index and then not in {WHOLE, UNKNOWN}:
        return False
    if isinstance(new, ast.Call) and isinstance(old, ast.Call) and not _same_arguments(new, old, kinds, fields):
        return False
    if before.depth >= 0 and then.depth >= 0 and (before.depth != then.depth or _is_struct(before) != _is_struct(then)):
        return False
    return all(_makes_sense(node, kinds, fields) for node in ast.walk(new))


def _same_arguments(new: ast.Call, old: ast.Call, kinds: Mapping[str, Kind], fields: Mapping[str, Kind]) -> bool:
    """Whether what a function is given is of the same kinds as before, where it is the same function."""
    if not (isinstance(new.func, ast.Name) and isinstance(old.func, ast.Name) and new.func.id == old.func.id):
        return True
    pairs = [[kind_in(a, kinds, fields) for a in both] for both in zip(new.args, old.args, strict=False)]
    return all(one.depth == other.depth and _is_struct(one) == _is_struct(other) for one, other in pairs)


def _is_struct(kind: Kind) -> bool:
    return kind.base not in ("number", "whole")


def _makes_sense(node: ast.AST, kinds: Mapping[str, Kind], fields: Mapping[str, Kind]) -> bool:
    """Whether operations are on single numbers, and indices whole ones."""
    if isinstance(node, ast.BinOp):
        sides = [kind_in(side, kinds, fields) for side in (node.left, node.right)]
        whole_step = isinstance(node.op, ast.Add | ast.Sub) and sides[1].base == "whole" and sides[1].depth == 0
        return all(side.depth <= 0 and not _is_no_number(side) for side in sides) or (sides[0].depth > 0 and whole_step)
    if isinstance(node, ast.UnaryOp):
        of = kind_in(node.operand, kinds, fields)
        return isinstance(node.op, ast.Not) or (of.depth <= 0 and not _is_no_number(of))
    if isinstance(node, ast.IfExp):
        return kind_in(node.body, kinds, fields).depth == kind_in(node.orelse, kinds, fields).depth
    if isinstance(node, ast.Subscript):
        of = kind_in(node.value, kinds, fields)
        parts = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        fits = of.depth < 0 or of.depth >= len(parts)
        return fits and all(kind_in(part, kinds, fields) in {WHOLE, UNKNOWN} for part in parts)
    return True


def _is_no_number(kind: Kind) -> bool:
    return kind.base not in ("number", "whole", "")
