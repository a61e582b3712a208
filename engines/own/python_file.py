"""A Python file with a step in it: which function it is, told without running it; and the function, by running it."""

from __future__ import annotations

import ast
import sys
from collections.abc import Sequence
from types import ModuleType
from typing import Any

from engines.own.forms import roles_of
from reference.errors import Fault, InputError, unknown_name

#: The function that is taken where none is named.
DEFAULT = "step"


def step_in(file: str, source: str, wanted: str | None) -> tuple[str, tuple[str, ...]]:
    """The name of the function and the roles of its parameters.

    Args:
        file: what the file is called, for messages.
        wanted: the function's name; left out, `step`, or the one there is.

    Raises:
        InputError: where the text is no Python, has no such function, or its parameters are of no form.
    """
    try:
        tree = ast.parse(source)
    except (SyntaxError, ValueError) as error:
        line = getattr(error, "lineno", None)
        raise InputError(f"{file}{f', line {line}' if line else ''}: expected Python: {error.args[0]}") from None
    functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    if (wanted or DEFAULT) not in functions:
        _refuse_what_is_no_def(file, tree, wanted or DEFAULT)
    if not functions:
        raise InputError(f"{file}: expected a function {wanted or DEFAULT}, it has none")
    name = wanted or (DEFAULT if DEFAULT in functions or len(functions) > 1 else next(iter(functions)))
    if name not in functions:
        raise unknown_name(f"function of {file}", name, functions)
    return name, roles_of(f"{file}: {name}", _required(file, functions[name]))


def _refuse_what_is_no_def(file: str, tree: ast.Module, name: str) -> None:
    """Say of something else of that name what it is. Raises InputError."""
    for node in tree.body:
        if isinstance(node, ast.ClassDef | ast.AsyncFunctionDef) and node.name == name:
            what = "a class" if isinstance(node, ast.ClassDef) else "an async function"
        elif isinstance(node, ast.Assign) and any(isinstance(t, ast.Name) and t.id == name for t in node.targets):
            what = "a lambda" if isinstance(node.value, ast.Lambda) else "a variable"
        else:
            continue
        raise InputError(f"{file}, line {node.lineno}: {name} is {what}: expected def {name}(...)")


def _required(file: str, function: ast.FunctionDef) -> Sequence[str]:
    """The parameters without defaults, and those with that are a form's too."""
    by_name = [
        argument.arg
        for argument, default in zip(function.args.kwonlyargs, function.args.kw_defaults, strict=True)
        if default is None
    ]
    if by_name:
        what = f"{', '.join(by_name)} after a star, by name only"
        raise InputError(f"{file}, line {function.lineno}: {function.name} takes {what}: expected them before it")
    given = [*function.args.posonlyargs, *function.args.args]
    return [argument.arg for argument in given[: len(given) - len(function.args.defaults)]]


def read(path: str, name: str, source: str, function: str) -> Any:
    """The function, from a module that is run anew. Raises Fault where that fails."""
    import traceback
    from pathlib import Path

    module = ModuleType("springlab_own_step")
    module.__file__ = path
    folder = str(Path(path).parent)
    sys.path.insert(0, folder)
    try:
        exec(compile(source, path, "exec"), module.__dict__)
    except Exception as error:
        lines = [f.lineno for f in traceback.extract_tb(error.__traceback__) if f.filename == path]
        where = f", line {lines[-1]}" if lines else ""
        raise Fault(f"{name}{where}: {type(error).__name__}: {error}") from None
    finally:
        sys.path.remove(folder)
    found = module.__dict__.get(function)
    if not callable(found):
        raise Fault(f"{name}: {function} is no function")
    return found
