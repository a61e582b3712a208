"""A C file with a step in it (`springlab.h`): compiled by the system's compiler, called in the process it runs in."""

from __future__ import annotations

import ctypes
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from reference.errors import Fault, Unsupported
from reference.state import Array

#: What its step is given: it is called as one that is given a slope.
ROLES = ("slope", "state", "time", "dt")

#: Compilers that may be there; CC comes before them.
COMPILERS = ("cc", "gcc", "clang")

#: Multiplications and additions round one by one, as in Python.
OPTIONS = ("-O2", "-std=gnu11", "-ffp-contract=off", "-shared", "-fPIC")

#: How long it may take [s].
LIMIT = 30


def read(path: str, name: str, source: str) -> Callable[..., Any]:
    """The function step of a C text, of a library that nothing else has loaded: what is static in it begins anew.

    Raises:
        Unsupported: where there is no compiler.
        Fault: where it does not compile, or has no step.
    """
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "step.so"
        file.write_bytes(_compiled(path, name, source))
        library = ctypes.CDLL(str(file))
    try:
        step, slot = library.step, ctypes.c_void_p.in_dll(library, "slope")
    except (AttributeError, ValueError):
        raise Fault(f'{name}: expected #include "springlab.h" and a function step') from None
    numbers = ctypes.POINTER(ctypes.c_double)
    step.argtypes, step.restype = [numbers, ctypes.c_int, ctypes.c_double, ctypes.c_double], None

    def called(f: Callable[[Array, float], Array], y: Array, t: float, dt: float) -> Array:
        raised: list[BaseException] = []

        def asked(where: Any, time: float, out: Any) -> None:
            try:
                answer = f(np.ctypeslib.as_array(where, y.shape), time) if not raised else np.zeros_like(y)
            except BaseException as error:  # it cannot pass through C: it goes on from there
                raised.append(error)
                answer = np.zeros_like(y)
            np.ctypeslib.as_array(out, y.shape)[:] = answer

        callback = ctypes.CFUNCTYPE(None, numbers, ctypes.c_double, numbers)(asked)
        slot.value = ctypes.cast(callback, ctypes.c_void_p).value
        end = np.ascontiguousarray(y, dtype=float).copy()
        step(end.ctypes.data_as(numbers), len(end), t, dt)
        if raised:
            raise raised[0]
        return end

    return called


def compiler_found() -> str | None:
    """Where the system's C compiler is; None where there is none."""
    return next(filter(None, map(shutil.which, (os.environ.get("CC", ""), *COMPILERS))), None)


@cache
def _compiled(path: str, name: str, source: str) -> bytes:
    """The library made of a C text."""
    compiler = compiler_found()
    if compiler is None:
        raise Unsupported(f"{name} needs a C compiler: expected one of {', '.join(COMPILERS)}")
    here = Path(__file__).parent
    with tempfile.TemporaryDirectory() as folder:
        file, made = Path(folder) / "step.c", Path(folder) / "step.so"
        file.write_text(source, encoding="utf-8")
        command = [compiler, *OPTIONS, f"-I{here}", f"-I{Path(path).parent}", "-o", str(made), str(file), "-lm"]
        try:
            done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=LIMIT)
        except subprocess.TimeoutExpired:
            raise Fault(f"{name} does not compile within {LIMIT} s") from None
        if done.returncode:
            raise Fault(f"{name}{_first_error(done.stderr)}")
        return made.read_bytes()


def _first_error(said: str) -> str:
    """The line and what is wrong there, of what a compiler said."""
    found = re.search(r"step\.c:(\d+):(?:\d+:)? (?:fatal )?error: (.*)", said)
    if found:
        return f", line {found[1]}: {found[2]}"
    lines = [line for line in said.splitlines() if line.strip()]
    return f" does not compile: {lines[0] if lines else 'the compiler does not say why'}"
