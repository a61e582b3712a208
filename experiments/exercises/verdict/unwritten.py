"""Which functions of a submission are not written yet: those that are still the starter's, or have nothing in them."""

from __future__ import annotations

import ast
from collections.abc import Iterable

from experiments.exercises.handed_in.parsing import parsed


def unwritten(source: str, starter: str, functions: Iterable[str]) -> list[str]:
    r"""Of these functions, those that nothing was written into; none where Python cannot read the file.

    Comments and docstrings are nothing.

    >>> starter = "def a(x):\n    return 0.0\n\ndef b(x):\n    return 0.0"
    >>> unwritten("def a(x):  # mine\n    return 0.0\n\ndef b(x):\n    return x", starter, ["a", "b"])
    ['a']
    """
    try:
        written = _functions(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    begun = _functions(starter)
    return [
        name
        for name in dict.fromkeys(functions)
        if name in written and (_is_empty(written[name]) or _same(written[name], begun.get(name)))
    ]


def _functions(source: str) -> dict[str, ast.FunctionDef]:
    return {node.name: node for node in parsed(source).body if isinstance(node, ast.FunctionDef)}


def _body(function: ast.FunctionDef) -> list[ast.stmt]:
    """What is done in it: strings that stand by themselves do nothing."""
    return [s for s in function.body if not (isinstance(s, ast.Expr) and isinstance(s.value, ast.Constant))]


def _is_empty(function: ast.FunctionDef) -> bool:
    return all(isinstance(statement, ast.Pass) or _gives_up(statement) for statement in _body(function))


def _gives_up(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Raise) and "NotImplemented" in ast.dump(statement)


def _same(function: ast.FunctionDef, other: ast.FunctionDef | None) -> bool:
    return other is not None and list(map(ast.dump, _body(function))) == list(map(ast.dump, _body(other)))
