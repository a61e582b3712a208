"""Mutants of a source text: each a small mistake, as a piece of the text and what stands there in its place.

Left out is what no test should hold: docstrings, annotations and types, `assert`, the words of errors, `__repr__`,
settings of dataclasses, `strict=` of zip, and what scenes are shown with: defaults of parameters given by name.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import accumulate

from tests.mutants.kinds import KINDS, is_type

#: Keywords, decorators and functions in which a mistake has no meaning that a test could hold.
SKIPPED_KEYWORDS = {"strict", "encoding"}
SKIPPED_DECORATORS = {"dataclass", "cache", "lru_cache", "property", "overload", "scene"}
SKIPPED_FUNCTIONS = {"__repr__", "__str__"}


@dataclass(frozen=True)
class Mutant:
    """One small mistake in one file.

    Attributes:
        file: relative to the project, with slashes.
        line: where it begins, from 1.
        kind: of mistake, as in `kinds.KINDS`.
        start: the first byte of the text that is replaced.
        end: the byte after its last.
        text: what stands there then.
        before: the lines it is in, as one, without indentation.
        after: what becomes of them.
    """

    file: str
    line: int
    kind: str
    start: int
    end: int
    text: str
    before: str
    after: str

    def applied(self, source: str) -> str:
        """The source with this mistake."""
        data = source.encode()
        return (data[: self.start] + self.text.encode() + data[self.end :]).decode()


def mutants(file: str, source: str) -> list[Mutant]:
    """All mutants of a source text, in its order."""
    data = source.encode()
    starts = [0, *accumulate(map(len, data.splitlines(keepends=True)))]
    found: dict[tuple[int, int, str], Mutant] = {}
    for node in _nodes(ast.parse(source)):
        for kind, changes in KINDS.items():
            for old, new in changes(node):
                assert old.end_lineno is not None
                assert old.end_col_offset is not None
                start, end = starts[old.lineno - 1] + old.col_offset, starts[old.end_lineno - 1] + old.end_col_offset
                text = ast.unparse(ast.fix_missing_locations(new))
                text = f"({text})" if _needs_parentheses(old, new) else text
                first, last = starts[old.lineno - 1], starts[old.end_lineno]
                before, head, tail = data[first:last], data[first:start], data[end:last]
                after = head + text.encode() + tail
                mutant = Mutant(file, old.lineno, kind, start, end, text, _one_line(before), _one_line(after))
                if mutant.before != mutant.after:
                    found.setdefault((start, end, text), mutant)
    return [found[place] for place in sorted(found)]


def _nodes(node: ast.AST) -> Iterator[ast.AST]:
    """The nodes of a tree in which a mistake counts, from above."""
    yield node
    for name, value in ast.iter_fields(node):
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and not _is_skipped(node, name, child):
                yield from _nodes(child)


def _is_skipped(parent: ast.AST, field: str, node: ast.AST) -> bool:
    """Whether nothing in a node, which is a field of its parent, can be a mistake that counts."""
    if field in ("annotation", "returns", "kw_defaults") or isinstance(
        node, ast.Assert | ast.Raise | ast.Import | ast.ImportFrom
    ):
        return True
    if isinstance(node, ast.FunctionDef):
        return node.name in SKIPPED_FUNCTIONS
    if field == "decorator_list":
        called = node.func if isinstance(node, ast.Call) else node
        return getattr(called, "attr", getattr(called, "id", "")) in SKIPPED_DECORATORS
    if isinstance(parent, ast.Call) and isinstance(node, ast.UnaryOp):
        # of what is left to NumPy to find any negative number will do
        return ast.unparse(parent.func).endswith(".reshape")
    if isinstance(node, ast.keyword):
        return node.arg in SKIPPED_KEYWORDS
    if isinstance(node, ast.Expr):
        return isinstance(node.value, ast.Constant)
    if isinstance(node, ast.If):
        return ast.unparse(node.test) == "TYPE_CHECKING" or "__name__" in ast.unparse(node.test)
    # pieces of f-strings have no places of their own in Python 3.11: the f-string is changed as a whole
    return isinstance(parent, ast.JoinedStr) or (isinstance(node, ast.Subscript | ast.BinOp) and is_type(node))


def _needs_parentheses(old: ast.AST, new: ast.AST) -> bool:
    """Whether what is put in the place of an expression binds less than it."""
    if isinstance(old, ast.BinOp) and isinstance(new, ast.BinOp):
        closer = (ast.Pow, ast.BitAnd)
        return isinstance(old.op, closer) or isinstance(new.op, closer)
    return isinstance(new, ast.BoolOp) or (isinstance(new, ast.UnaryOp) and isinstance(new.op, ast.Not))


def _one_line(text: bytes) -> str:
    return " ".join(text.decode().split())
