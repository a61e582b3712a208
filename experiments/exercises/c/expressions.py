"""Expressions of a C program, as `pycparser` reads them, made into those of a tree (`tree`)."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Mapping
from typing import Any

from pycparser import c_ast, c_generator

from experiments.exercises.c.tree import BINARY, COMPARED, IN_PYTHON, UnreadableError, Word, python_name

SIGNS: Mapping[str, type[ast.unaryop]] = {"-": ast.USub, "+": ast.UAdd, "!": ast.Not, "~": ast.Invert}


class Expressions:
    """Makes expressions; one that has no form of its own is copied."""

    def __init__(self) -> None:
        self.written = c_generator.CGenerator()
        self._makers: Mapping[type, Callable[[Any], ast.expr]] = {
            c_ast.Constant: self._of_number,
            c_ast.ID: self._of_name,
            c_ast.BinaryOp: self._of_operation,
            c_ast.UnaryOp: self._of_sign,
            c_ast.Assignment: self._of_assignment,
            c_ast.TernaryOp: self._of_choice,
            c_ast.ArrayRef: self._of_part,
            c_ast.StructRef: self._of_field,
            c_ast.FuncCall: self._of_call,
            c_ast.Cast: self._of_cast,
            c_ast.InitList: self._of_list,
            c_ast.ExprList: self._of_row,
        }

    def expression(self, node: Any) -> ast.expr:
        """Of whatever kind."""
        made = self._makers.get(type(node))
        return at(node, made(node) if made is not None else word(self.written.visit(node)))

    def _of_number(self, node: c_ast.Constant) -> ast.expr:
        text = node.value
        if "int" in node.type and re.fullmatch(r"(0|[1-9]\d*)[uUlL]*", text):
            return _number(int(text.rstrip("uUlL")), text)
        if node.type in ("double", "float", "long double") and "x" not in text.lower():
            return _number(float(text.rstrip("fFlL")), text)
        return word(text)

    def _of_name(self, node: c_ast.ID) -> ast.expr:
        return ast.Name(python_name(node.name), ast.Load())

    def _of_operation(self, node: c_ast.BinaryOp) -> ast.expr:
        left, right = self.expression(node.left), self.expression(node.right)
        if node.op in BINARY:
            return ast.BinOp(left, BINARY[node.op](), right)
        if node.op in COMPARED:
            return ast.Compare(left, [COMPARED[node.op]()], [right])
        return ast.BoolOp(ast.And() if node.op == "&&" else ast.Or(), [left, right])

    def _of_sign(self, node: c_ast.UnaryOp) -> ast.expr:
        if node.op == "sizeof" and isinstance(node.expr, c_ast.Typename):
            return word(self.written.visit(node))
        inner = self.expression(node.expr)
        if node.op in SIGNS:
            return ast.UnaryOp(SIGNS[node.op](), inner)
        if node.op == "*":
            return ast.Attribute(inner, "at", ast.Load())
        return call(node, node.op, inner)

    def _of_assignment(self, node: c_ast.Assignment) -> ast.expr:
        return call(node, node.op, self.expression(node.lvalue), self.expression(node.rvalue))

    def _of_choice(self, node: c_ast.TernaryOp) -> ast.expr:
        return ast.IfExp(*(self.expression(part) for part in (node.cond, node.iftrue, node.iffalse)))

    def _of_part(self, node: c_ast.ArrayRef) -> ast.expr:
        indices: list[Any] = []
        while isinstance(node, c_ast.ArrayRef):
            indices.insert(0, node.subscript)
            node = node.name
        parts = [self.expression(index) for index in indices]
        index = parts[0] if len(parts) == 1 else ast.Tuple(parts, ast.Load())
        return ast.Subscript(self.expression(node), index, ast.Load())

    def _of_field(self, node: c_ast.StructRef) -> ast.expr:
        made = ast.Attribute(self.expression(node.name), python_name(node.field.name), ast.Load())
        made.arrow = node.type == "->"  # type: ignore[attr-defined]
        return made

    def _of_call(self, node: c_ast.FuncCall) -> ast.expr:
        if not isinstance(node.name, c_ast.ID):
            raise UnreadableError("a function that has no name")
        arguments = [self.expression(part) for part in (node.args.exprs if node.args else [])]
        name = IN_PYTHON.get(node.name.name, python_name(node.name.name))
        return call(node, name, *arguments)

    def _of_cast(self, node: c_ast.Cast) -> ast.expr:
        return call(node, f"({self.written.visit(node.to_type)})", self.expression(node.expr))

    def _of_list(self, node: c_ast.InitList) -> ast.expr:
        if any(isinstance(part, c_ast.NamedInitializer) for part in node.exprs):
            return word(f"{{{self.written.visit(node)}}}")
        return ast.List([self.expression(part) for part in node.exprs], ast.Load())

    def _of_row(self, node: c_ast.ExprList) -> ast.expr:
        return call(node, ",", *map(self.expression, node.exprs))


def word(text: str) -> Word:
    """An expression that is only copied."""
    made = Word()
    made.text = text
    return made


def _number(value: float, text: str) -> ast.Constant:
    made = ast.Constant(value)
    made.as_written = (value, text)  # type: ignore[attr-defined]
    return made


def call(node: Any, name: str, *arguments: ast.expr) -> ast.Call:
    """The call of a function, or what is taken for one."""
    return at(node, ast.Call(at(node, ast.Name(name, ast.Load())), list(arguments), []))


def at(node: Any, made: Any) -> Any:
    """At the line of a node, where it has one; else it will be that of what it is in."""
    if node.coord is not None:
        made.lineno = made.end_lineno = node.coord.line
    return made
