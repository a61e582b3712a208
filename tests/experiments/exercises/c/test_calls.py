"""How functions in C are called: what they are given, what is made of it, and what is told where they end badly."""

from __future__ import annotations

import ctypes
import mmap
import signal
import subprocess
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from engines.own.c_file import compiler_found
from experiments.exercises.c import calls
from experiments.exercises.c.calls import (
    FAR,
    PAGES,
    Called,
    EndedBySignalError,
    FullStackError,
    Guarded,
    LibraryNotLoadedError,
    OutsideArrayError,
    functions_of,
    module_of,
)

pytestmark = pytest.mark.skipif(compiler_found() is None, reason="there is no C compiler")

#: In place of `guard.c`: functions that tell what they were given by what they write, and end as they are told to.
STAND_IN = """
#include "exercise.h"
#include <stdint.h>
uintptr_t address = 70;
int full, ends;
#if EXERCISE <= 2
int guarded(double *y, double *v, double dt, const struct spring *s)
{
    *y += 10 * *v + 100 * dt;
    *v = s->mass + 10 * s->stiffness + 100 * s->rest_length + 1000 * s->damping + 10000 * s->gravity;
    return ends;
}
#elif EXERCISE == 3
int guarded(double x[][2], double v[][2], const struct string *s, double f[][2])
{
    for (int i = 0; i < s->count; i++)
        for (int j = 0; j < 2; j++)
            f[i][j] = x[i][j] + 10 * v[i][j] + 100 * s->masses[i] + 1000 * s->stiffness[i] + 1e4 * s->rest_lengths[i]
                      + 1e5 * s->drag + 1e6 * s->gravity + 1e7 * s->anchor[j];
    x[0][0] = -7;
    return ends;
}
#elif EXERCISE == 4
int guarded(double x[][2], double v[][2], double dt, const struct string *s)
{
    x[s->count - 1][1] += 10 * dt;
    v[0][1] += 100 * s->masses[1];
    return ends;
}
#else
int guarded(int count, double x[][2], double v[][2], const struct circle *c)
{
    x[count - 1][0] += 10 * c->centre[0] + 100 * c->centre[1];
    v[count - 1][1] += 1000 * c->radius;
    return ends;
}
#endif
"""

SPRING = SimpleNamespace(mass=1.0, stiffness=2.0, rest_length=3.0, damping=4.0, gravity=5.0)
STRING = SimpleNamespace(
    masses=np.array([1.0, 2.0]),
    stiffness=np.array([3.0, 4.0]),
    rest_lengths=np.array([5.0, 6.0]),
    drag=7.0,
    gravity=8.0,
    anchor=np.array([9.0, 0.0]),
)
CIRCLE = SimpleNamespace(centre=np.array([1.0, 2.0]), radius=3.0)
X, V = np.array([[0.1, 0.2], [0.3, 0.4]]), np.array([[0.5, 0.6], [0.7, 0.8]])


@pytest.fixture(scope="module")
def libraries(tmp_path_factory: pytest.TempPathFactory) -> dict[int, Path]:
    """One for each exercise that can be done in C."""
    folder, compiler = tmp_path_factory.mktemp("libraries"), compiler_found()
    (folder / "own.c").write_text(STAND_IN, encoding="utf-8")
    made = {number: folder / f"{number}.so" for number in (1, 2, 3, 4, 7)}
    for number, file in made.items():
        include = f"-I{Path(calls.__file__).parent}"
        command = [compiler, "-shared", "-fPIC", f"-DEXERCISE={number}", include, folder / "own.c", "-o", file]
        subprocess.run([str(word) for word in command], check=True)
    return made


@pytest.mark.parametrize("number", [1, 2])
def test_one_mass(libraries: dict[int, Path], number: int) -> None:
    """Height, velocity and dt; then all fields of the spring, in the order of exercise.h; numbers or arrays of one."""
    step = module_of(str(libraries[number]), number, []).step
    for given in ((1.0, 2.0), (np.array(1.0), np.array(2.0))):
        y, v = step(*given, 3.0, SPRING)
        assert (y, v) == (321.0, 54321.0)
        assert type(y) is type(v) is float


def test_forces(libraries: dict[int, Path]) -> None:
    """Of all that they are given; what is written into positions shows; each call has an array of its own."""
    forces = module_of(str(libraries[3]), 3, []).forces
    x, v = X.copy(), V.copy()
    first = forces(x, v, STRING)
    parts = [[100 + 3e3 + 5e4 + 7e5 + 8e6 + 9e7], [200 + 4e3 + 6e4 + 7e5 + 8e6 + 9e7]]
    wanted = X + 10 * V + parts - [[0.0, 9e7], [0.0, 9e7]]
    assert first == pytest.approx(wanted, rel=1e-14)
    assert x.tolist() == [[-7.0, 0.2], [0.3, 0.4]]
    assert v.tolist() == V.tolist()
    for _ in range(2):
        forces(2 * X, V, STRING)
    assert first == pytest.approx(wanted, rel=1e-14)


@pytest.mark.parametrize("number", [4, 7])
def test_steps_and_circles(libraries: dict[int, Path], number: int) -> None:
    """What they leave are new arrays, which later calls leave alone; what they are given stays."""
    module = module_of(str(libraries[number]), number, [])
    if number == 4:
        arguments: tuple[Any, ...] = (3.0, STRING)
        wanted = X + np.array([[0, 0], [0, 30]]), V + np.array([[0, 200], [0, 0]])
    else:
        arguments = (CIRCLE,)
        wanted = X + np.array([[0, 0], [210, 0]]), V + np.array([[0, 0], [0, 3000]])
    called = module.step if number == 4 else module.push_out
    found = called(X, V, *arguments)
    for _ in range(2):
        called(2 * X, 2 * V, *arguments)
    for one, other in zip(found, wanted, strict=True):
        assert one == pytest.approx(other, rel=1e-14)
    assert (X[1].tolist(), V[0].tolist()) == ([0.3, 0.4], [0.5, 0.6])


@pytest.mark.parametrize(
    ("name", "full", "kind"),
    [
        ("SIGSEGV", 0, OutsideArrayError),
        ("SIGBUS", 0, OutsideArrayError),
        ("SIGILL", 0, OutsideArrayError),
        ("SIGTRAP", 0, OutsideArrayError),
        ("SIGFPE", 0, EndedBySignalError),
        ("SIGABRT", 0, EndedBySignalError),
        ("SIGSEGV", 1, FullStackError),
    ],
)
def test_what_ends_a_call_is_told_with_its_line(
    libraries: dict[int, Path], name: str, full: int, kind: type[EndedBySignalError]
) -> None:
    """By the signal, and whether the stack was full; the code at 70 is of line 5, as it begins at 64."""
    library = ctypes.CDLL(str(libraries[1]))
    step = functions_of(library, 1, [(0, 0), (32, 4), (64, 5), (96, 6)])["step"]
    ends, is_full = (ctypes.c_int.in_dll(library, word) for word in ("ends", "full"))
    ends.value, is_full.value = signal.Signals[name], full
    try:
        with pytest.raises(EndedBySignalError) as ended:
            step(1.0, 2.0, 3.0, SPRING)
    finally:
        ends.value = is_full.value = 0
    assert type(ended.value) is kind
    assert (str(ended.value), ended.value.line) == (name, 5)
    assert step(1.0, 2.0, 3.0, SPRING)[0] == 321.0


def test_the_line_of_an_address(libraries: dict[int, Path]) -> None:
    """From where its code begins to where the next does; none before the first, and none of what is no line."""
    called = Called(ctypes.CDLL(str(libraries[1])), [(16, 3), (32, 0), (64, 5)])
    assert [called.line(at) for at in (0, 15, 16, 31, 32, 63, 64, 10**6)] == [None, None, 3, 3, None, None, 5, 5]


def test_arrays_stand_between_closed_pages_by_turns_at_either_side() -> None:
    """What is around them is no number; as many calls as there may be have arrays of their own."""
    room = Guarded()
    where = []
    for _ in range(3):
        room.begin()
        arrays = [room.array(np.full((3, 2), float(i))) for i in range(8)]
        empty = [float(array[2, 1]) for array in arrays]
        assert empty == [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
        where.append(arrays[0].ctypes.data)
    size = mmap.PAGESIZE * PAGES
    assert where[0] == where[2]
    assert where[1] == where[0] + size - 8 * 6
    room.begin()
    unwritten = room.array(shape=(4,))
    assert unwritten.shape == (4,)
    assert np.isnan(unwritten).all()
    room.begin()
    largest = room.array(np.ones(size // 8))
    assert largest.sum() == size // 8
    room.begin()
    with pytest.raises(ValueError, match="too large"):
        room.array(np.ones(size // 8 + 1))
    assert FAR % mmap.PAGESIZE == 0


def test_what_cannot_be_loaded_is_not_the_submissions_fault(tmp_path: Path) -> None:
    """It has an error of its own."""
    (tmp_path / "own.so").write_bytes(b"no library")
    with pytest.raises(LibraryNotLoadedError):
        module_of(str(tmp_path / "own.so"), 1, [])
