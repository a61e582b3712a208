"""A C program as a syntax tree of Python's kind, so that one search for small changes serves both languages.

What is the same in both is the same: `x[i][0]` is x[i, 0], a loop that counts is one over `range`, `fabs` is abs. What
only C has keeps a form that Python's tree can hold: `*y` is the attribute y.at, a cast a call, a declaration an
assignment that knows how its name was declared. `reading` makes such trees, `written` writes them as C.
"""

from __future__ import annotations

import ast
import keyword
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from experiments.exercises.c.kinds import Kinds

#: What C calls by another name, and names that mean something in Python only: read as the name and `OTHERWISE`.
IN_PYTHON = {"fabs": "abs", "fmin": "min", "fmax": "max"}
OTHERWISE, PYTHONS = "_c_", ("abs", "min", "max", "range", "hasattr", "len", "sum", "np", "self", "math")

#: Its operators, of values and of comparisons.
BINARY: Mapping[str, type[ast.operator]] = {
    "+": ast.Add,
    "-": ast.Sub,
    "*": ast.Mult,
    "/": ast.Div,
    "%": ast.Mod,
    "&": ast.BitAnd,
    "|": ast.BitOr,
    "^": ast.BitXor,
    "<<": ast.LShift,
    ">>": ast.RShift,
}
COMPARED: Mapping[str, type[ast.cmpop]] = {
    "<": ast.Lt,
    ">": ast.Gt,
    "<=": ast.LtE,
    ">=": ast.GtE,
    "==": ast.Eq,
    "!=": ast.NotEq,
}


class UnreadableError(Exception):
    """A program, or a part of one, that is not read into a tree."""


class Verbatim(ast.stmt):
    """A statement that is only copied: its text, and the names that it declares."""

    _fields = ()
    text: str
    names: list[str]


class Word(ast.expr):
    """An expression that is only copied: its text."""

    _fields = ()
    text: str


@dataclass
class ReadProgram:
    """A C program.

    Attributes:
        tree: its functions, and what stands beside them, in order; without `main`.
        directives: its lines that begin with #, as they are.
        kinds: of the names in each function; under "" of the fields of structs.
    """

    tree: ast.Module
    directives: list[str]
    kinds: dict[str, Kinds] = field(default_factory=dict)


def functions_in(tree: ast.Module) -> Sequence[ast.FunctionDef]:
    """The functions of a program."""
    return [node for node in tree.body if isinstance(node, ast.FunctionDef)]


def python_name(name: str) -> str:
    """A name in the tree."""
    return name + OTHERWISE if keyword.iskeyword(name) or name in PYTHONS else name


def c_name(name: str) -> str:
    """A name of the tree as it is in C."""
    return name.removesuffix(OTHERWISE)
