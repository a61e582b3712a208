"""A bound by the memory: the bytes a step reads and writes, over the speed at which this machine copies as many.

Counted from the kernel's own text: each array that a pass over springs or masses reads, and each that it writes, once,
as if a cache held whatever a pass looks at again. A kernel that is much slower than that has another reason.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping
from time import perf_counter
from typing import Any

import numpy as np

from reference.jit import HEADER, module

#: A copy that is spread over threads as the kernels' loops are.
_COPY = """
@njit(cache=True, nogil=True, parallel={})
def copy(source, target):
    for i in prange(len(source)):
        target[i] = source[i]
"""


def bytes_per_step(text: str, arrays: Mapping[str, Any]) -> int:
    """What a step of a kernel reads and writes, given its text and the arrays it is called with."""
    functions = {f.name: f for f in ast.walk(ast.parse(text)) if isinstance(f, ast.FunctionDef)}
    advance = functions["advance"]
    step = next(line for line in advance.body if isinstance(line, ast.For))
    names = {argument.arg: argument.arg for argument in advance.args.args}
    passes = [_touched(line, names, functions) for line in step.body if isinstance(line, ast.For)]
    return sum(np.asarray(arrays[name]).nbytes for touched in passes for name, _ in touched)


def _touched(
    node: ast.AST, names: Mapping[str, str], functions: Mapping[str, ast.FunctionDef]
) -> set[tuple[str, type[ast.expr_context]]]:
    """The arrays of which entries are read or written, by the names they have in `advance`, and which of the two."""
    found: set[tuple[str, type[ast.expr_context]]] = set()
    for part in ast.walk(node):
        if isinstance(part, ast.Subscript) and isinstance(part.value, ast.Name) and part.value.id in names:
            found.add((names[part.value.id], type(part.ctx)))
        if isinstance(part, ast.Call) and isinstance(part.func, ast.Name) and part.func.id in functions:
            called = functions[part.func.id]
            given = {a.arg: names.get(_array(value)) for a, value in zip(called.args.args, part.args, strict=True)}
            found |= _touched(called, {a: name for a, name in given.items() if name is not None}, functions)
    return found


def _array(value: ast.expr) -> str:
    """The name of an array that is given to a function, as a whole or one row of it; of other things none."""
    whole = value.value if isinstance(value, ast.Subscript) else value
    return whole.id if isinstance(whole, ast.Name) else ""


def seconds_to_copy(count: int, threads: int) -> float:
    """How long the machine takes now to read and write `count` bytes [s], from an array to another: half of them each.

    Arrays are filled once before, so that the memory is there, and in the cache if it is large enough.
    """
    import numba

    numba.set_num_threads(min(threads, numba.config.NUMBA_NUM_THREADS))
    copy = module(HEADER + _COPY.format(threads > 1)).copy
    source, target = np.ones(max(1, count // 16)), np.zeros(max(1, count // 16))
    copy(source, target)
    begin = perf_counter()
    copy(source, target)
    return perf_counter() - begin
