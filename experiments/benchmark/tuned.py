"""The anchor for speed: `tuned.c`, built with the system's compiler, where there is one."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import time
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from reference.errors import Unsupported
from reference.forces import springs_of_masses
from reference.scratch import scratch_folder
from reference.state import Array
from reference.system import MassSpringSystem

FLAGS = ("-O3", "-march=native", "-fno-math-errno", "-shared", "-fPIC")


@cache
def library(dimension: int) -> ctypes.CDLL:
    """tuned.c for 2 or 3 axes. Raises Unsupported where there is no C compiler, or it refuses."""
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        raise Unsupported("there is no C compiler to build the anchor with")
    built = scratch_folder() / "tuned.so"
    source = Path(__file__).with_suffix(".c")
    command = [compiler, *FLAGS, f"-DAXES={dimension}", str(source), "-o", str(built), "-lm"]
    made = subprocess.run(command, capture_output=True, text=True, check=False)
    if made.returncode:
        raise Unsupported(f"the C compiler refused the anchor: {made.stderr.strip().splitlines()[0]}")
    return ctypes.CDLL(str(built))


class TunedHeun:
    """A system in the hands of tuned.c.

    Args:
        system: any; as a string only where spring j joins masses j and j + 1 and the first mass is fixed.
        as_string: whether to use the loops for strings.
    """

    def __init__(self, system: MassSpringSystem, as_string: bool) -> None:
        self._library = library(system.dimension)
        self._as_string = as_string and system.is_string
        n, d = system.positions.shape
        self._x, self._v, gx, gv = (
            [q[:, i].copy() for i in range(d)] for q in 2 * (system.positions, system.velocities)
        )
        first, force = ([np.zeros(rows) for _ in range(d)] for rows in (n, len(system.springs)))
        self._axes = [self._x, self._v, gx, gv, first, force]
        self._numbers = [system.masses, system.rest_lengths, system.stiffness, system.damping, system.gravity]
        begin, spring, sign = springs_of_masses(system)
        lists = [np.ascontiguousarray(a, dtype=np.uint32) for a in (*system.springs.T, begin, spring)]
        self._lists: list[Any] = [*lists, sign, system.fixed.astype(np.uint8)]
        self._drag, self._n, self._springs = system.drag, n, len(system.springs)

    def advance(self, dt: float, steps: int) -> float:
        """A number of steps of dt [s]; how long they took [s]."""
        pointers = [(ctypes.c_void_p * len(a))(*(one.ctypes.data for one in a)) for a in self._axes]
        numbers = [ctypes.c_void_p(a.ctypes.data) for a in self._numbers]
        counts = [ctypes.c_double(self._drag), ctypes.c_double(dt), ctypes.c_int64(self._n), ctypes.c_int64(steps)]
        lists = [ctypes.c_void_p(a.ctypes.data) for a in self._lists]
        function = self._library.heun_string if self._as_string else self._library.heun_mesh
        more = [] if self._as_string else [*lists, ctypes.c_int64(self._springs)]
        begin = time.perf_counter()
        function(*pointers, *numbers, *counts, *more)
        return time.perf_counter() - begin

    @property
    def positions(self) -> Array:
        """Now, shape (n, d) [m]."""
        return np.stack(self._x, axis=1)
