"""A C program read into a tree (`tree`), by `pycparser`: its functions, statements and declarations."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from pycparser import c_ast, c_parser

from experiments.exercises.c.expressions import Expressions, at, call, word
from experiments.exercises.c.kinds import Kind, Kinds
from experiments.exercises.c.text import SILENT, without_comments
from experiments.exercises.c.tree import BINARY, ReadProgram, UnreadableError, Verbatim, python_name

#: Names of types that C's own headers bring.
TYPES = (
    *("size_t", "ptrdiff_t", "bool", "FILE", "time_t", "int8_t", "int16_t", "int32_t", "int64_t"),
    *("uint8_t", "uint16_t", "uint32_t", "uint64_t"),
)

#: A text that is longer is not read [letters].
LONGEST = 40_000

#: Types of whole numbers, one of whose words these are.
WHOLE_WORDS = {"int", "long", "short", "unsigned", "signed", "char", "size_t", "bool", "_Bool"}


def read(source: str) -> ReadProgram:
    """Read a program. Raises UnreadableError for one that is not read, such as one with macros for statements."""
    if len(source) > LONGEST:
        raise UnreadableError("it is too long")
    directives: list[str] = []

    def aside(found: re.Match[str]) -> str:
        directives.append(found[0].strip())
        return "\n" * found[0].count("\n")

    text = re.sub(r"^[ \t]*#(?:[^\n\\]|\\\n|\\)*", aside, _lines_kept(source), flags=re.MULTILINE)
    header = (Path(__file__).parent / "exercise.h").read_text(encoding="utf-8")
    structs = re.findall(r"^struct \w+ {.*?};", without_comments(header), re.MULTILINE | re.DOTALL)
    begin = " ".join([*(f"typedef int {name};" for name in TYPES), *structs]).replace("\n", " ")
    try:
        parsed = c_parser.CParser().parse(f'{begin}\n#line 1 "own"\n{text}')
        return _Reader(len(TYPES)).program(parsed, directives)
    except (c_parser.ParseError, AssertionError, AttributeError, RecursionError, ValueError) as error:
        raise UnreadableError(str(error)) from None


def _lines_kept(source: str) -> str:
    """The text without comments, each line where it was."""
    return SILENT.sub(lambda found: found[0] if found[0][0] in "\"'" else " " + "\n" * found[0].count("\n"), source)


class _Reader(Expressions):
    """Makes trees; holds the kinds of the names in the function that is being read."""

    def __init__(self, types: int) -> None:
        super().__init__()
        self._types = types
        #: What names of types stand for.
        self._named: Kinds = {}
        self._kinds: Kinds = {}

    def program(self, parsed: c_ast.FileAST, directives: list[str]) -> ReadProgram:
        fields: Kinds = {}
        outside: Kinds = {}
        made = ReadProgram(ast.Module([], []), directives, {"": fields})
        for node in parsed.ext[self._types :]:
            _note_fields(node, fields, self._named)
            if isinstance(node, c_ast.Typedef):
                self._named[node.name] = kind_of(node.type, self._named)
            if node.coord is not None and node.coord.file != "own":
                continue
            if isinstance(node, c_ast.FuncDef):
                self._kinds = dict(outside)
                if node.decl.name != "main":
                    made.tree.body.append(self._function(node))
                    made.kinds[node.decl.name] = self._kinds
                outside[python_name(node.decl.name)] = Kind("function", 0)
            elif not isinstance(node, c_ast.Pragma):
                self._kinds = outside
                made.tree.body.append(self._verbatim(node))
        ast.fix_missing_locations(made.tree)
        return made

    def _function(self, node: c_ast.FuncDef) -> ast.FunctionDef:
        """With the names that it is given; the one that holds the fields of what is given comes last."""
        given = [p for p in (node.decl.type.args.params if node.decl.type.args else []) if getattr(p, "name", None)]
        for one in given:
            self._kinds[python_name(one.name)] = kind_of(one.type, self._named)
        given.sort(key=lambda one: self._kinds[python_name(one.name)].base.startswith("struct"))
        arguments = ast.arguments([], [ast.arg(python_name(p.name)) for p in given], None, [], [], None, [])
        made = at(node.decl, ast.FunctionDef(python_name(node.decl.name), arguments, self._block(node.body), [], None))
        made.header = self._header(node.decl)
        made.order = [p.name for p in node.decl.type.args.params if getattr(p, "name", None)] if given else []
        return made

    def _header(self, declared: c_ast.Decl) -> str:
        """What stands before the braces, with @ for the name."""
        inner = declared.type
        while not isinstance(inner, c_ast.TypeDecl):
            inner = inner.type
        name, inner.declname = inner.declname, "springlab_name"
        text = self.written.visit(declared).replace("springlab_name", "@", 1)
        inner.declname = name
        return str(text)

    # statements

    def _block(self, node: Any) -> list[ast.stmt]:
        """The statements in braces; or the one there is."""
        if node is None:
            return []
        items = node.block_items or [] if isinstance(node, c_ast.Compound) else [node]
        return [made for item in items for made in self._statements(item)]

    def _statements(self, node: Any) -> Iterator[ast.stmt]:
        if isinstance(node, c_ast.DeclList | c_ast.ExprList):
            for one in node.decls if isinstance(node, c_ast.DeclList) else node.exprs:
                yield from self._statements(one)
        elif not isinstance(node, c_ast.Pragma):
            yield self._statement(node)

    def _statement(self, node: Any) -> ast.stmt:
        kind = type(node).__name__
        if kind == "Decl":
            return self._declaration(node)
        if kind == "Assignment":
            return self._assignment(node)
        if kind == "UnaryOp" and node.op in ("p++", "p--", "++", "--"):
            operator = ast.Add() if "+" in node.op else ast.Sub()
            one = at(node, ast.Constant(1))
            return at(node, ast.AugAssign(self._target(node.expr), operator, one))
        if kind in ("FuncCall", "UnaryOp", "BinaryOp", "TernaryOp", "ID", "Constant", "Cast", "ArrayRef", "StructRef"):
            return at(node, ast.Expr(self.expression(node)))
        if kind == "Return":
            return at(node, ast.Return(self.expression(node.expr) if node.expr is not None else None))
        if kind == "If":
            test = self.expression(node.cond)
            return at(node, ast.If(test, self._block(node.iftrue), self._block(node.iffalse)))
        if kind == "While":
            return at(node, ast.While(self.expression(node.cond), self._block(node.stmt), []))
        if kind == "For":
            return self._loop(node)
        if kind == "Compound":
            return at(node, ast.With([], self._block(node)))
        if kind in ("Break", "Continue", "EmptyStatement"):
            plain = {"Break": ast.Break, "Continue": ast.Continue, "EmptyStatement": ast.Pass}
            return at(node, plain[kind]())
        return self._verbatim(node)

    def _verbatim(self, node: Any) -> Verbatim:
        """Copied, but its names are known."""
        declared = [inner for inner in _below(node) if isinstance(inner, c_ast.Decl) and inner.name]
        for inner in declared:
            self._note(inner)
        made = at(node, Verbatim())
        made.names = [python_name(inner.name) for inner in declared]
        text = self.written.visit(node).rstrip()
        made.text = text if text.endswith(";") or (text.endswith("}") and not _declares(node)) else f"{text};"
        return made

    def _note(self, declared: c_ast.Decl) -> None:
        name, kind = python_name(declared.name), kind_of(declared.type, self._named)
        known = self._kinds.get(name, kind)
        self._kinds[name] = kind if known == kind else Kind("", -1)

    def _declaration(self, node: c_ast.Decl) -> ast.stmt:
        """An assignment that knows how its name is declared; without a value, or kept between calls, it is copied."""
        if node.name is None or node.init is None or node.storage or isinstance(node.type, c_ast.FuncDecl):
            return self._verbatim(node)
        self._note(node)
        value, node.init = node.init, None
        made = at(node, ast.Assign([at(node, ast.Name(python_name(node.name), ast.Store()))], self.expression(value)))
        made.declared = self.written.visit(node)
        made.free = self._free(node)
        node.init = value
        return made

    def _free(self, node: c_ast.Decl) -> str:
        """The same for a name of ours that can be written into."""
        inner = node.type
        kept = list(getattr(inner, "quals", []))
        if hasattr(inner, "quals"):
            inner.quals = []
        text = re.sub(rf"\b{node.name}\b(?!.*\b{node.name}\b)", "springlab_value", self.written.visit(node))
        if hasattr(inner, "quals"):
            inner.quals = kept
        return text.removeprefix("const ") if isinstance(inner, c_ast.TypeDecl) else text

    def _assignment(self, node: c_ast.Assignment) -> ast.stmt:
        if node.op == "=":
            targets, value = [self._target(node.lvalue)], node.rvalue
            while isinstance(value, c_ast.Assignment) and value.op == "=":
                targets.append(self._target(value.lvalue))
                value = value.rvalue
            return at(node, ast.Assign(targets, self.expression(value)))
        operator = BINARY.get(node.op[:-1])
        if operator is None:
            raise UnreadableError(node.op)
        return at(node, ast.AugAssign(self._target(node.lvalue), operator(), self.expression(node.rvalue)))

    def _target(self, node: Any) -> Any:
        made: Any = self.expression(node)
        if hasattr(made, "ctx"):
            made.ctx = ast.Store()
        return made

    def _loop(self, node: c_ast.For) -> ast.For:
        """One that counts up is one over `range`; another one has what begins it, its test, and what it does then."""
        declared, name, start = self._beginning(node.init)
        made = at(node, ast.For(at(node, ast.Name(name, ast.Store())), at(node, ast.Pass()), [], []))
        made.declared, made.test = declared, "<"
        if _counts_up(node, name):
            made.test = node.cond.op
            ends = [self.expression(node.cond.right)]
            if not (isinstance(start, ast.Constant) and start.value == 0):
                ends = [start or at(node, word("")), *ends]
            made.iter = call(node, "range", *ends)
        else:
            test, then = (self.expression(part) if part is not None else word("") for part in (node.cond, node.next))
            made.iter = call(node, "for", start or word(""), at(node, test), at(node, then))
        made.body = self._block(node.stmt)
        return made

    def _beginning(self, init: Any) -> tuple[str | None, str, ast.expr | None]:
        """How the name of a loop is declared, the name, what it begins with."""
        if init is None:
            return None, "_", None
        match init:
            case c_ast.DeclList(decls=[one]) if one.init is not None:
                self._note(one)
                value, one.init = one.init, None
                text, one.init = self.written.visit(one), value
                return str(text), python_name(one.name), self.expression(value)
        if isinstance(init, c_ast.Assignment) and init.op == "=" and isinstance(init.lvalue, c_ast.ID):
            return None, python_name(init.lvalue.name), self.expression(init.rvalue)
        raise UnreadableError("a loop that begins in another way")


def kind_of(declared: Any, types: Mapping[str, Kind]) -> Kind:
    """Of which kind a declared name is: of which type its numbers are, and how many indices it takes to reach one.

    Args:
        types: what names of types stand for.
    """
    depth = 0
    while isinstance(declared, c_ast.ArrayDecl | c_ast.PtrDecl):
        declared, depth = declared.type, depth + 1
    if isinstance(declared, c_ast.FuncDecl):
        return Kind("function", 0)
    inner = getattr(declared, "type", None)
    if isinstance(inner, c_ast.IdentifierType):
        words, name = set(inner.names), " ".join(inner.names)
        if name in types:
            return Kind(types[name].base, types[name].depth + depth)
        return Kind("number" if words & {"double", "float"} else "whole" if words & WHOLE_WORDS else name, depth)
    return Kind(kind_of_struct(inner), depth)


def kind_of_struct(struct: Any) -> str:
    """How a struct is called among kinds; one that has no name by its line."""
    name = getattr(struct, "name", None)
    return f"struct {name}" if name else f"struct at {getattr(struct, 'coord', '')}"


def _note_fields(node: Any, fields: Kinds, types: Kinds) -> None:
    """The kinds of the fields of structs that are declared, by "struct name.field"."""
    for inner in _below(node):
        if isinstance(inner, c_ast.Struct):
            for one in inner.decls or []:
                if isinstance(one, c_ast.Decl) and one.name:
                    fields[f"{kind_of_struct(inner)}.{python_name(one.name)}"] = kind_of(one.type, types)


def _below(node: Any) -> Iterator[Any]:
    yield node
    for _, inner in node.children():
        yield from _below(inner)


def _declares(node: Any) -> bool:
    """Whether a semicolon ends it, also after braces."""
    return isinstance(node, c_ast.Decl | c_ast.Typedef)


def _counts_up(node: c_ast.For, name: str) -> bool:
    """Whether a loop goes from its beginning to an end by ones."""
    test, then = node.cond, node.next
    by_one = (isinstance(then, c_ast.UnaryOp) and then.op in ("p++", "++") and _is(then.expr, name)) or (
        isinstance(then, c_ast.Assignment)
        and then.op == "+="
        and _is(then.lvalue, name)
        and getattr(then.rvalue, "value", "") == "1"
    )
    return by_one and isinstance(test, c_ast.BinaryOp) and test.op in ("<", "<=") and _is(test.left, name)


def _is(node: Any, name: str) -> bool:
    return isinstance(node, c_ast.ID) and python_name(node.name) == name
