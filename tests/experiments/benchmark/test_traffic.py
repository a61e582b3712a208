"""The bytes that a step moves: counted by hand for Heun, with 8 bytes a number, and a copy that takes its time."""

from __future__ import annotations

from types import SimpleNamespace

import numba
import numpy as np
import pytest

from experiments.benchmark import traffic
from experiments.benchmark.meshes import CLOTH, lattice, string
from experiments.benchmark.traffic import bytes_per_step, seconds_to_copy
from reference.compiled import runs
from reference.compiled.kernels import Kernel
from reference.schemes.catalogue import find
from reference.state import Array

#: Of both stages and each axis, for each mass: x, v and weight read, guess (two) and acceleration written; then x, v,
#: guess, weight and acceleration read, x and v written. One divisor for all axes in each stage.
HEUN = {d: 8 * (d * (3 + 3) + 1 + d * (6 + 2) + 1) for d in (2, 3)}

#: Where springs are a pass of their own: x and v once more for them, and of the guess masses need only velocities.
HEUN_IN_TWO_PASSES = {d: HEUN[d] + 8 * d * (2 + 2 - 1) for d in (2, 3)}


def test_a_string_moves_its_masses_its_forces_and_three_numbers_of_each_spring() -> None:
    """Forces are written and read once in each stage; there is one at either end more than there are springs."""
    kernel = Kernel(string(200), find("heun"), 1)
    n, s = 201, 200
    assert bytes_per_step(kernel.text, kernel.arrays) == n * HEUN_IN_TWO_PASSES[2] + 2 * (
        8 * 3 * s + 2 * 2 * 8 * (s + 2)
    )


def test_a_mesh_moves_its_lists_too() -> None:
    """Two ends of 4 bytes for each spring, and for each of its ends its number and sign; where each mass begins."""
    system = lattice((9, 8), CLOTH)
    kernel = Kernel(system, find("heun"), 1)
    n, s = len(system.masses), len(system.springs)
    lists = s * (2 * 4 + 2 * (4 + 8)) + 4 * (n + 1)
    assert bytes_per_step(kernel.text, kernel.arrays) == n * HEUN_IN_TWO_PASSES[2] + 2 * (
        lists + 8 * 3 * s + 2 * 2 * 8 * s
    )


def test_runs_move_a_rest_length_of_each_spring_and_little_else(monkeypatch: pytest.MonkeyPatch) -> None:
    """Beside masses and rest lengths: what is kept in the cache, and lists for each run and row, of 8 bytes."""
    monkeypatch.setattr(runs, "LARGE", 0)
    monkeypatch.setattr(runs, "LONG", 0)
    system = lattice((300, 20), CLOTH)
    kernel = Kernel(system, find("heun"), 1)
    n, s = len(system.masses), len(system.springs)
    least = n * HEUN[2] + 2 * 8 * s
    kept = sum(a.nbytes for name, a in kernel.arrays.items() if name.startswith(("force", "sum")))
    lists = sum(a.nbytes for name, a in kernel.arrays.items() if a.dtype == np.int64 or name.startswith("entry"))
    own = 2 * 8 * 2 * len(kernel.arrays["stiffness"])
    # the places for forces and sums are written and read
    assert bytes_per_step(kernel.text, kernel.arrays) == least + own + 2 * (2 * kept + lists)


@pytest.mark.parametrize("threads", [1, 2])
def test_a_copy_takes_time(threads: int) -> None:
    """Whatever the number of threads; how much is the machine's affair."""
    assert seconds_to_copy(160_000, threads) > 0


@pytest.mark.parametrize(("count", "numbers"), [(160_000, 10_000), (8, 1)])
def test_half_of_the_bytes_are_read_and_half_written(count: int, numbers: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of numbers of 8 bytes, one at least, twice: the first time is for the cache."""
    copied: list[tuple[int, int]] = []

    def copy(source: Array, target: Array) -> None:
        copied.append((len(source), len(target)))

    monkeypatch.setattr(traffic, "module", lambda _: SimpleNamespace(copy=copy))
    seconds_to_copy(count, 1)
    assert copied == [(numbers, numbers)] * 2
    assert numba.get_num_threads() == 1
