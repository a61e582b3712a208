"""Trees of C programs (`tree`), and pieces of them, written as C."""

from __future__ import annotations

import ast
import math
from collections.abc import Iterator, Sequence
from typing import Any

from experiments.exercises.c.kinds import UNKNOWN, Kinds, kind_in
from experiments.exercises.c.tree import BINARY, COMPARED, IN_PYTHON, ReadProgram, Verbatim, Word, c_name

#: How tightly C's operators bind, from a comma on.
COMMA, ASSIGNED, CHOICE, EITHER, BOTH, EQUAL, ORDERED, SUM, PRODUCT, UNARY, POSTFIX = range(11)
BITS = SUM

TIGHT = {
    "+": SUM,
    "-": SUM,
    "*": PRODUCT,
    "/": PRODUCT,
    "%": PRODUCT,
    "==": EQUAL,
    "!=": EQUAL,
    "<": ORDERED,
    ">": ORDERED,
    "<=": ORDERED,
    ">=": ORDERED,
}

OPERATORS = {kind: text for text, kind in BINARY.items()}
COMPARISONS = {kind: text for text, kind in COMPARED.items()}
SIGNS = {ast.USub: "-", ast.UAdd: "+", ast.Not: "!", ast.Invert: "~"}
IN_C = {python: c for c, python in IN_PYTHON.items()}

#: What counts the rounds of loops, so that none goes on for ever.
TICK = "springlab_tick();"


class NotInCError(Exception):
    """Something that C has not."""


class Writer:
    """Writes functions. Who switches between variants of their parts overrides `part` and `simple`."""

    tick = ""

    def __init__(self, program: ReadProgram, told: bool = False) -> None:
        """It is for people, who are told of a copy in words."""
        self._told = told
        self._program = program
        self._kinds: Kinds = {}
        self._fields = program.kinds[""]
        self._all: list[str] = []

    def enter(self, function: ast.FunctionDef) -> None:
        """What is written next is of this function."""
        self._kinds = self._program.kinds[c_name(function.name)]
        self._all = [argument.arg for argument in function.args.args]

    def function(self, function: ast.FunctionDef) -> list[str]:
        """The whole of it."""
        self.enter(function)
        return [header_of(function), "{", *self._indented(function.body), "}"]

    def _indented(self, body: Sequence[ast.stmt]) -> list[str]:
        return [f"    {line}" for statement in body for line in self.statement(statement)]

    def block(self, body: Sequence[ast.stmt]) -> list[str]:
        """Statements in braces."""
        return ["{", *self._indented(body), "}"]

    # statements

    def statement(self, node: ast.stmt) -> list[str]:
        """The lines of one."""
        if isinstance(node, Verbatim):
            return node.text.splitlines()
        if isinstance(node, ast.With):
            return self.block(node.body)
        if isinstance(node, ast.If):
            lines = [f"if ({self.part(node, 'test')})", *self.block(node.body)]
            return lines + (["else", *self.block(node.orelse)] if node.orelse else [])
        if isinstance(node, ast.While):
            return [f"while ({self.part(node, 'test')})", *self._round(node.body)]
        if isinstance(node, ast.For):
            start, test, then = (self.part(node, name) for name in ("start", "test", "then"))
            return [f"for ({start}; {test}; {then})", *self._round(node.body)]
        return self.simple(node)

    def _round(self, body: Sequence[ast.stmt]) -> list[str]:
        lines = self.block(body)
        return ["{", f"    {self.tick}", *lines[1:]] if self.tick else lines

    def part(self, node: ast.stmt, name: str) -> str:
        """A condition, or what begins a loop or goes on in it."""
        return self.parts(node)[name]

    def simple(self, node: ast.stmt) -> list[str]:
        """A statement without others in it."""
        return [self.plain(node)]

    def parts(self, node: ast.stmt) -> dict[str, str]:
        """What stands in the brackets of a condition or a loop, as it is."""
        if isinstance(node, ast.If | ast.While):
            return {"test": self.expression(node.test)}
        if not isinstance(node, ast.For):
            return {}
        if not isinstance(node.iter, ast.Call) or not isinstance(node.target, ast.Name):
            raise NotInCError("a loop")
        name, declared = c_name(node.target.id), getattr(node, "declared", None)
        given = node.iter.args
        if isinstance(node.iter.func, ast.Name) and node.iter.func.id == "for" and len(given) == 3:
            start, test, then = (self.expression(part) for part in given)
        elif isinstance(node.iter.func, ast.Name) and node.iter.func.id == "range" and 1 <= len(given) <= 2:
            start = self.expression(given[0], ASSIGNED) if len(given) == 2 else "0"
            test = f"{name} {getattr(node, 'test', '<')} {self.expression(given[-1], SUM)}"
            then = f"{name}++"
        else:
            raise NotInCError("a loop")
        begin = f"{declared or name} = {start}" if start else ""
        return {"start": begin, "test": test, "then": then}

    def plain(self, node: ast.stmt) -> str:
        """A statement without others in it, as it is."""
        if isinstance(node, ast.Assign):
            return self._assignment(node)
        if isinstance(node, ast.AugAssign):
            target, value = self.expression(node.target, UNARY), self.expression(node.value, ASSIGNED)
            one = isinstance(node.value, ast.Constant) and node.value.value == 1
            if one and isinstance(node.op, ast.Add | ast.Sub) and isinstance(node.target, ast.Name):
                return f"{target}{2 * OPERATORS[type(node.op)]};"
            return f"{target} {self._operator(node.op)}= {value};"
        if isinstance(node, ast.Return):
            return f"return {self.expression(node.value)};" if node.value is not None else "return;"
        if isinstance(node, ast.Expr):
            return f"{self.expression(node.value)};"
        words = {ast.Pass: ";", ast.Break: "break;", ast.Continue: "continue;"}
        if type(node) in words:
            return words[type(node)]
        if isinstance(node, Verbatim):
            return node.text
        raise NotInCError(type(node).__name__)

    def _assignment(self, node: ast.Assign) -> str:
        targets, value = node.targets, node.value
        match targets:
            case [ast.Name(name)] if name.startswith("_") and name.endswith(("_before", "_given")):
                return self._kept(name, value)
        if any(isinstance(target, ast.Tuple) for target in targets):
            raise NotInCError("several values")
        if getattr(node, "declared", None):
            return f"{node.declared} = {self.value(value)};"  # type: ignore[attr-defined]
        copied = self._copied(value)
        names = [self.expression(target, UNARY) for target in targets]
        return f"{' = '.join(names)} = {copied or self.expression(value, ASSIGNED)};"

    def _kept(self, name: str, value: ast.expr) -> str:
        """What was there before, under a name of its own."""
        inner = value.body if isinstance(value, ast.IfExp) else value
        kept = self._copied(inner)
        if kept is None:
            raise NotInCError(name)
        plain = inner.func.value if isinstance(inner, ast.Call) and isinstance(inner.func, ast.Attribute) else inner
        whole = kind_in(plain, self._kinds, self._fields)
        if whole.depth == 0:
            return f"const {'double' if whole.base == 'number' else 'int'} {name} = {self.expression(plain)};"
        return f"{name} = {kept};" if self._told else f"__typeof__(&({self.expression(plain)})[0]) {name} = {kept};"

    def _copied(self, value: ast.expr) -> str | None:
        """A copy of an array, made anew; of a number itself."""
        if not (isinstance(value, ast.Call) and isinstance(value.func, ast.Attribute) and value.func.attr == "copy"):
            return None
        of = value.func.value
        kind, text = kind_in(of, self._kinds, self._fields), self.expression(of, POSTFIX)
        if kind.depth == 0 and kind.base in ("number", "whole"):
            return text
        if kind.depth <= 0:
            raise NotInCError("a copy")
        if self._told:
            return f"a copy of {text}"
        return f"springlab_copied({text}, sizeof *({text}) * ({self.count()}))"

    def count(self) -> str:
        """How many masses there are, where that is given; else one."""
        for name in self._all:
            kind = self._kinds.get(name, UNKNOWN)
            if kind == ("struct string", 1):
                return f"{c_name(name)}->count"
            if kind == ("whole", 0):
                return c_name(name)
        return "1"

    # expressions

    def value(self, node: ast.expr) -> str:
        """What a name is declared with."""
        return self._copied(node) or self.expression(node, ASSIGNED)

    def expression(self, node: ast.expr, least: int = COMMA) -> str:
        """An expression, in brackets where it binds less tightly."""
        text, tight = self._bound(node)
        return f"({text})" if tight < least else text

    def _bound(self, node: Any) -> tuple[str, int]:
        """Its text, and how tightly it binds."""
        if isinstance(node, Word):
            return node.text, UNARY
        if isinstance(node, ast.Name):
            return c_name(node.id), POSTFIX
        if isinstance(node, ast.Constant):
            return _number(node)
        if isinstance(node, ast.BinOp):
            return self._operation(node)
        if isinstance(node, ast.UnaryOp):
            inner = self.expression(node.operand, UNARY)
            sign = SIGNS[type(node.op)]
            return sign + (f"({inner})" if inner.startswith(sign) else inner), UNARY
        if isinstance(node, ast.Compare):
            (operator,), (right,) = node.ops, node.comparators
            text = COMPARISONS.get(type(operator))
            if text is None:
                raise NotInCError("a comparison")
            tight = TIGHT[text]
            return f"{self.expression(node.left, tight)} {text} {self.expression(right, tight + 1)}", tight
        if isinstance(node, ast.BoolOp):
            text, tight = (" && ", BOTH) if isinstance(node.op, ast.And) else (" || ", EITHER)
            return text.join(self.expression(value, tight + 1) for value in node.values), tight
        if isinstance(node, ast.IfExp):
            test, body = self.expression(node.test, EITHER), self.expression(node.body)
            return f"{test} ? {body} : {self.expression(node.orelse, CHOICE)}", CHOICE
        if isinstance(node, ast.Subscript):
            parts = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
            if isinstance(node.value, ast.List):
                raise NotInCError("a part of a list")
            indices = "".join(f"[{self.expression(part)}]" for part in parts)
            return self.expression(node.value, POSTFIX) + indices, POSTFIX
        if isinstance(node, ast.List):
            return f"{{{', '.join(self.expression(part, ASSIGNED) for part in node.elts)}}}", POSTFIX
        if isinstance(node, ast.Attribute):
            return self._attribute(node)
        if isinstance(node, ast.Call):
            return self._call(node)
        raise NotInCError(type(node).__name__)

    def _operator(self, operator: ast.operator) -> str:
        text = OPERATORS.get(type(operator))
        if text is None:
            raise NotInCError(type(operator).__name__)
        return text

    def _operation(self, node: ast.BinOp) -> tuple[str, int]:
        if isinstance(node.op, ast.Pow):
            by = node.right.value if isinstance(node.right, ast.Constant) else None
            if by == 0.5:
                return f"sqrt({self.expression(node.left)})", POSTFIX
            if by == 2 and isinstance(node.left, ast.Name | ast.Attribute | ast.Subscript):
                inner = self.expression(node.left, UNARY)
                return f"{inner} * {inner}", PRODUCT
            return f"pow({self.expression(node.left, ASSIGNED)}, {self.expression(node.right, ASSIGNED)})", POSTFIX
        text = self._operator(node.op)
        tight = TIGHT.get(text, BITS)
        if text not in TIGHT:  # brackets about all: nobody knows how tightly & and << bind
            return f"({self.expression(node.left, POSTFIX)} {text} {self.expression(node.right, POSTFIX)})", POSTFIX
        right = self.expression(node.right, tight + 1)
        return f"{self.expression(node.left, tight)} {text} {right}", tight

    def _attribute(self, node: ast.Attribute) -> tuple[str, int]:
        if node.attr == "at":
            return f"*{self.expression(node.value, UNARY)}", UNARY
        if node.attr in ("T", "copy"):
            raise NotInCError(node.attr)
        kind = kind_in(node.value, self._kinds, self._fields)
        arrow = kind.depth > 0 if kind.depth >= 0 else getattr(node, "arrow", True)
        return f"{self.expression(node.value, POSTFIX)}{'->' if arrow else '.'}{c_name(node.attr)}", POSTFIX

    def _call(self, node: ast.Call) -> tuple[str, int]:
        if not isinstance(node.func, ast.Name) or node.keywords:
            raise NotInCError("a call")
        name = node.func.id
        if name == "hasattr":
            raise NotInCError(name)
        if name == ",":
            return ", ".join(self.expression(part, ASSIGNED) for part in node.args), COMMA
        if name.startswith("(") and len(node.args) == 1:
            (inner,) = node.args
            return name + self.expression(inner, UNARY), UNARY
        if not (name[0].isalpha() or name[0] == "_") or name in ("p++", "p--"):
            return self._of_operator(name, node.args)
        parts = [self.expression(part, ASSIGNED) for part in node.args]
        return f"{IN_C.get(name) or c_name(name)}({', '.join(parts)})", POSTFIX

    def _of_operator(self, name: str, given: Sequence[ast.expr]) -> tuple[str, int]:
        if len(given) == 2 and name.endswith("="):
            target, value = self.expression(given[0], UNARY), self.expression(given[1], ASSIGNED)
            return f"{target} {name} {value}", ASSIGNED
        if len(given) == 1:
            (one,) = given
            inner = self.expression(one, UNARY)
            return (inner + name[1:], POSTFIX) if name in ("p++", "p--") else (name + inner, UNARY)
        raise NotInCError(name)


def _number(node: ast.Constant) -> tuple[str, int]:
    value, written = node.value, getattr(node, "as_written", (None, ""))
    if isinstance(value, bool):
        return str(int(value)), POSTFIX
    if not isinstance(value, int | float) or not math.isfinite(value):
        raise NotInCError("a number")
    text = written[1] if written[0] == value and type(written[0]) is type(value) else repr(value)
    return text, POSTFIX if value >= 0 else UNARY


def header_of(function: ast.FunctionDef, other: str = "") -> str:
    """What stands before the braces of a function; by another name it is one that only its file knows."""
    header: str = function.header.replace("@", other or c_name(function.name))  # type: ignore[attr-defined]
    return f"static {header}" if other and "static" not in header.split("(")[0].split() else header


def begun(program: ReadProgram) -> Iterator[str]:
    """The lines before the first function: the directives."""
    yield from program.directives


def text_of(program: ReadProgram, told: bool = False) -> str:
    """The whole program, without `main`; where it is told to people, copies are in words."""
    writer = Writer(program, told)
    lines = list(begun(program))
    for node in program.tree.body:
        lines += writer.function(node) if isinstance(node, ast.FunctionDef) else writer.statement(node)
    return "\n".join(lines) + "\n"
