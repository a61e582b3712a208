"""The functions of a compiled C submission, called as those of a Python one are: arrays and namespaces in, arrays out.

Used in the process of a submission, which finds NumPy and nothing else of the project. `c/exercise.h` says what the
functions are given. Arrays stand in pages of their own between pages that cannot be touched, by turns at the end and at
the beginning of theirs: who reaches outside one is stopped at once (`c/guard.c`), and told the line.
"""

from __future__ import annotations

import bisect
import ctypes
import mmap
import signal
from collections.abc import Callable, Sequence
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np

#: Arrays that are given to a function, at most, and pages of each.
SLOTS, PAGES = 8, 4

#: Around each as many bytes that nobody can touch: an index that is a product goes far.
FAR = 2**21

NUMBER = ctypes.POINTER(ctypes.c_double)


class EndedBySignalError(Exception):
    """Something that ends a C program: its words are the signal's name; its line, where the machine tells it."""

    line: int | None = None


class OutsideArrayError(EndedBySignalError):
    """Memory that is none of an array was reached."""


class LibraryNotLoadedError(Exception):
    """The machine cannot load what was compiled."""


class FullStackError(EndedBySignalError):
    """Functions called one another until there was no room."""


class Spring(ctypes.Structure):
    """struct spring."""

    _fields_ = [(name, ctypes.c_double) for name in ("mass", "stiffness", "rest_length", "damping", "gravity")]


class String(ctypes.Structure):
    """struct string."""

    _fields_ = [
        ("count", ctypes.c_int),
        *((name, NUMBER) for name in ("masses", "stiffness", "rest_lengths")),
        *((name, ctypes.c_double) for name in ("drag", "gravity")),
        ("anchor", ctypes.c_double * 2),
    ]


class Circle(ctypes.Structure):
    """struct circle."""

    _fields_ = [("centre", ctypes.c_double * 2), ("radius", ctypes.c_double)]


class Guarded:
    """Room for arrays, each between two pages that nobody can touch."""

    def __init__(self) -> None:
        page = mmap.PAGESIZE
        self._room = page * PAGES
        self._blocks = []
        protect = ctypes.CDLL(None).mprotect
        for _ in range(SLOTS):
            block = mmap.mmap(-1, self._room + 2 * FAR)
            first = ctypes.addressof(ctypes.c_char.from_buffer(block))
            for closed in (first, first + FAR + self._room):
                protect(ctypes.c_void_p(closed), ctypes.c_size_t(FAR), 0)
            self._blocks.append((block, first + FAR))
        self.at_end = True
        self._next = 0

    def begin(self) -> None:
        """A new call: its arrays stand at the other side of their pages than those of the last."""
        self.at_end, self._next = not self.at_end, 0

    def array(self, like: Any = None, shape: tuple[int, ...] = ()) -> Any:
        """A copy of an array, or one of a shape that nothing was written into: what is around it is no number."""
        shape = np.shape(like) if like is not None else shape
        _, start = self._blocks[self._next]
        self._next += 1
        size = 8 * int(np.prod(shape))
        if size > self._room:
            raise ValueError("an array that is too large")
        offset = self._room - size if self.at_end else 0
        whole = np.ctypeslib.as_array(ctypes.cast(start, NUMBER), (self._room // 8,))
        whole[:] = np.nan
        part = whole[offset // 8 : offset // 8 + size // 8].reshape(shape)
        if like is not None:
            part[...] = like
        return part


def pointer(array: Any) -> Any:
    """To its first number."""
    return array.ctypes.data_as(NUMBER)


class Called:
    """A function of a library, by what it is given."""

    def __init__(self, library: ctypes.CDLL, lines: Sequence[Sequence[int]]) -> None:
        self._guarded = library.guarded
        self._address, self._full = ctypes.c_size_t.in_dll(library, "address"), ctypes.c_int.in_dll(library, "full")
        self._addresses, self._lines = [row[0] for row in lines], [row[1] for row in lines]
        self._room = Guarded()

    def _call(self, *arguments: Any) -> None:
        """Call it; what would have ended the process is raised, with the line where the machine tells it."""
        number = self._guarded(*arguments)
        if number == 0:
            return
        name = signal.Signals(number).name
        # out of bounds of the program's own arrays: the compiler's check traps
        outside = number in (signal.SIGSEGV, signal.SIGBUS, signal.SIGILL, signal.SIGTRAP)
        kind = FullStackError if self._full.value else OutsideArrayError if outside else EndedBySignalError
        error = kind(name)
        error.line = self.line(self._address.value)
        raise error

    def line(self, address: int) -> int | None:
        """The line of the program that an address belongs to; None where it is none of it."""
        place = bisect.bisect_right(self._addresses, address) - 1
        return (self._lines[place] or None) if place >= 0 else None

    def step_of_one(self, y: Any, v: Any, dt: float, spring: SimpleNamespace) -> tuple[float, float]:
        """Exercises 1 and 2."""
        self._room.begin()
        height, speed = (self._room.array([float(value)]) for value in (y, v))
        given = Spring(*(float(getattr(spring, name)) for name, _ in Spring._fields_))  # type: ignore[misc]
        self._call(pointer(height), pointer(speed), ctypes.c_double(dt), ctypes.byref(given))
        return height.item(), speed.item()

    def forces(self, x: Any, v: Any, string: SimpleNamespace) -> Any:
        """Exercise 3."""
        self._room.begin()
        positions, velocities, f = self._room.array(x), self._room.array(v), self._room.array(shape=x.shape)
        self._call(pointer(positions), pointer(velocities), ctypes.byref(self._string(string)), pointer(f))
        x[...], v[...] = positions, velocities  # they are to stay as they were
        return f.copy()

    def step(self, x: Any, v: Any, dt: float, string: SimpleNamespace) -> tuple[Any, Any]:
        """Exercise 4."""
        self._room.begin()
        positions, velocities = self._room.array(x), self._room.array(v)
        given = self._string(string)
        self._call(pointer(positions), pointer(velocities), ctypes.c_double(dt), ctypes.byref(given))
        return positions.copy(), velocities.copy()

    def push_out(self, x: Any, v: Any, circle: SimpleNamespace) -> tuple[Any, Any]:
        """Exercise 7."""
        self._room.begin()
        positions, velocities = self._room.array(x), self._room.array(v)
        given = Circle((ctypes.c_double * 2)(*circle.centre), float(circle.radius))
        self._call(len(x), pointer(positions), pointer(velocities), ctypes.byref(given))
        return positions.copy(), velocities.copy()

    def _string(self, string: SimpleNamespace) -> String:
        arrays = [self._room.array(getattr(string, name)) for name in ("masses", "stiffness", "rest_lengths")]
        anchor = (ctypes.c_double * 2)(*string.anchor)
        return String(len(arrays[0]), *map(pointer, arrays), float(string.drag), float(string.gravity), anchor)


def module_of(path: str, exercise: int, lines: Sequence[Sequence[int]]) -> ModuleType:
    """A module with the function of a compiled submission.

    Args:
        lines: of the library's code: address, and line in the submission (0: none of it), in order of addresses.

    Raises:
        LibraryNotLoadedError: where the machine cannot load it, which is not the submission's fault.
    """
    try:
        library = ctypes.CDLL(path)
    except OSError as error:
        raise LibraryNotLoadedError(str(error)) from None
    module = ModuleType("submission")
    vars(module).update(functions_of(library, exercise, lines))
    return module


def functions_of(library: ctypes.CDLL, exercise: int, lines: Sequence[Sequence[int]]) -> dict[str, Callable[..., Any]]:
    """The function of a library, by its name."""
    called = Called(library, lines)
    functions: dict[int, tuple[str, Callable[..., Any]]] = {
        1: ("step", called.step_of_one),
        2: ("step", called.step_of_one),
        3: ("forces", called.forces),
        4: ("step", called.step),
        7: ("push_out", called.push_out),
    }
    return dict([functions[exercise]])
