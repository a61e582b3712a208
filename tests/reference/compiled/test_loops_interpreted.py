"""The loops' text run by Python itself, which refuses to go beyond an array: compiled, nobody would notice."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from reference.compiled import kernels
from reference.compiled import sweep as sweeps
from reference.compiled.loops import LANES, Loops
from reference.jit import HEADER
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.state import Array
from reference.system import MassSpringSystem
from tests.reference.systems import moving_string, random_mesh

DT, STEPS = 1e-3, 3

SYSTEMS = {
    "string": moving_string(5, damping=0.05, drag=0.02),
    "mesh": random_mesh(3, 7, 3, anchors=2),
    "obstacle": find_scene("barrier").system({}),
}


def interpreted(loops: Loops) -> Any:
    """The functions of a text, as they are written."""
    names = {"np": np, "njit": lambda **_: lambda function: function, "prange": range}
    exec(loops.text().replace(HEADER, ""), names)
    return SimpleNamespace(**names)


@pytest.fixture(autouse=True)
def by_python(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is compiled."""
    for file in (kernels, sweeps):
        monkeypatch.setattr(file, "compiled", interpreted)


def check_end(system: MassSpringSystem, scheme: str, positions: Array, velocities: Array) -> None:
    """It is where the scheme's function ends, to the bit."""
    end = simulate(system, find(scheme), DT, STEPS * DT)
    assert positions.tolist() == end.positions[-1].tolist()
    assert velocities.tolist() == end.velocities[-1].tolist()


@pytest.mark.parametrize("scheme", ["euler", "rk4"])
@pytest.mark.parametrize("name", SYSTEMS)
def test_the_loops_stay_within_their_arrays(name: str, scheme: str) -> None:
    """And compute what the scheme does."""
    end = kernels.advance(SYSTEMS[name], find(scheme), DT, STEPS)
    check_end(SYSTEMS[name], scheme, end.positions, end.velocities)


@pytest.mark.parametrize("count", [1, LANES + 2])
@pytest.mark.parametrize("name", SYSTEMS)
def test_sweeps_stay_within_their_arrays(name: str, count: int) -> None:
    """In one block of systems, and in more; each has its own drag."""
    drags = np.linspace(0.0, 0.1, count)
    found = sweeps.sweep(SYSTEMS[name], find("heun"), np.full(count, DT), STEPS, {"drag": drags})
    for i in {0, count // 2, count - 1}:
        system = SYSTEMS[name].with_parameter("drag", float(drags[i]))
        check_end(system, "heun", found.positions[i], found.velocities[i])


def test_python_refuses_what_a_compiled_loop_would_not() -> None:
    """Shown to fail: with room for a force too few."""
    kernel = kernels.Kernel(SYSTEMS["string"], find("euler"))
    kernel.advance(DT, 1)
    kernel._arrays["force0"] = kernel._arrays["force0"][:-1]
    with pytest.raises(IndexError):
        kernel.advance(DT, 1)
