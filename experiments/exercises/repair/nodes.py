"""Pieces of a syntax tree: copies with other children, and new ones at the line of another.

Imports Python's own library only; see `source_edits`.
"""

from __future__ import annotations

import ast
import copy
from functools import lru_cache
from typing import Any, NamedTuple


class Replacement(NamedTuple):
    """What may stand in place of a node.

    Attributes:
        family: the kind of the change; see `source_edits.Edit`.
        cost: how far from the text it is.
    """

    family: str
    cost: float
    node: Any


def renewed(node: Any, **fields: Any) -> Any:
    """A copy of a node, children shared, with these fields."""
    made = copy.copy(node)
    for name, value in fields.items():
        setattr(made, name, value)
    return made


def at_place(parts: list[Any], place: int, new: Any) -> list[Any]:
    """A copy of a list with another item at a place."""
    return [*parts[:place], new, *parts[place + 1 :]]


def expression(text: str, at: ast.expr | ast.stmt) -> ast.expr:
    """What the text says, at the line of a node; one and the same for one line, so it is not to be changed."""
    return _expression(text, at.lineno)


@lru_cache(maxsize=100_000)
def _expression(text: str, line: int) -> ast.expr:
    return ast.increment_lineno(ast.parse(text, mode="eval").body, line - 1)


def statement(text: str, at: ast.stmt) -> ast.stmt:
    """The same of a statement."""
    (made,) = ast.parse(text).body
    for node in ast.walk(made):
        ast.copy_location(node, at)
    return made


def binary(left: ast.expr, operator: ast.operator, right: ast.expr) -> ast.BinOp:
    """An operation, at the line of its left side."""
    return ast.copy_location(ast.BinOp(left, operator, right), left)


def moved(node: ast.expr, by: int) -> ast.BinOp:
    """A whole number more or less."""
    way = ast.Add() if by > 0 else ast.Sub()
    return binary(node, way, ast.copy_location(ast.Constant(abs(by)), node))


def called(function: str, node: ast.expr, *more: str) -> ast.Call:
    """A function of a node, and of what else it is given."""
    arguments = [node, *(expression(text, node) for text in more)]
    return ast.copy_location(ast.Call(expression(function, node), arguments, []), node)


def as_column(node: ast.expr) -> ast.Subscript:
    """node[:, None]."""
    made: ast.Subscript = renewed(expression("a[:, None]", node), value=node)
    return made


def function_name(call: ast.Call) -> str:
    """How a function is called, without its module."""
    return call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
