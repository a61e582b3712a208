"""Functions compiled from their texts, and kept on disk under the digest of all they were made from.

Numba's own disk cache looks at the file a function stands in, not at the functions it calls: with it, a law of the
spring that has changed would go on as it was in every loop that calls it. Here a compiled module is a text, of which
the digest is the name: another text of anything in it is another module.
"""

from __future__ import annotations

import ast
import hashlib
import importlib.util
import inspect
import os
import sys
import tempfile
import textwrap
from collections.abc import Callable, Mapping
from functools import cache
from types import ModuleType
from typing import Any

from reference.cache import cache_folder

#: What every compiled module begins with.
HEADER = "import numpy as np\nfrom numba import njit, prange\n"

#: Options of functions that compiled ones alone call: no way in from Python or C, which takes a sixth of the compiling.
INNER = "no_cpython_wrapper=True, no_cfunc_wrapper=True"


def compiled(*functions: Callable[..., Any], kinds: Mapping[str, str] | None = None) -> tuple[Any, ...]:
    """The functions, compiled: each may call those before it, NumPy, and nothing else.

    A division by zero gives what it gives in NumPy, and no exception.

    Args:
        kinds: Numba's types of parameters, by name. Functions of which all are known are compiled for these alone, at
            once; others for whatever they are called with, anew for each kind of array.
    """
    made = module("\n\n".join([HEADER, *(text_of(function, kinds) for function in functions)]))
    return tuple(getattr(made, function.__name__) for function in functions)


def array(dimension: int, entries: str = "float64", written: bool = False) -> str:
    """Numba's type of an array, row by row; one that is not written may be given whether it can be written or not.

    >>> array(2)
    "Array(float64, 2, 'C', True)"
    """
    return f"Array({entries}, {dimension}, 'C', {not written})"


def text_of(function: Callable[..., Any], kinds: Mapping[str, str] | None = None, inner: bool = False) -> str:
    """The text of a function as it is compiled: without its types, which Numba finds out itself, and its docstring.

    Args:
        kinds: see `compiled`.
        inner: whether compiled functions alone call it.

    >>> from reference.springs.linear_law import spring_force
    >>> print(text_of(spring_force))
    @njit(cache=True, error_model='numpy')
    def spring_force(stiffness, stretch, damping, rate):
        return stiffness * stretch + damping * rate
    """
    (definition,) = ast.parse(textwrap.dedent(inspect.getsource(function))).body
    assert isinstance(definition, ast.FunctionDef)
    definition.returns, definition.decorator_list = None, []
    for argument in definition.args.args:
        argument.annotation = None
    if ast.get_docstring(definition) is not None:
        definition.body = definition.body[1:]
    names = [argument.arg for argument in definition.args.args]
    signature = ""
    if kinds is not None and kinds.keys() >= set(names):
        signature = f'"void({", ".join(kinds[name] for name in names)})", '
    ways_in = f", {INNER}" if inner else ""
    return f"@njit({signature}cache=True, error_model='numpy'{ways_in})\n{ast.unparse(definition)}"


@cache
def module(text: str) -> ModuleType:
    """A text as a module: a file in the user's cache by its digest, beside which Numba keeps its code."""
    name = f"springlab_{hashlib.sha256(text.encode()).hexdigest()[:16]}"
    file = cache_folder("kernels") / f"{name}.py"
    if not file.exists() or file.read_text(encoding="utf-8") != text:
        with tempfile.NamedTemporaryFile("w", dir=file.parent, suffix=".tmp", delete=False, encoding="utf-8") as new:
            new.write(text)
        os.replace(new.name, file)
    spec = importlib.util.spec_from_file_location(name, file)
    assert spec is not None
    assert spec.loader is not None
    made = importlib.util.module_from_spec(spec)
    sys.modules[name] = made
    spec.loader.exec_module(made)
    return made
