"""What an engine does in a process of its own, and how the result gets back.

One process runs many cases, which saves starting the engine anew for each. This file is imported in every such process:
it imports nothing heavy.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np

from engines.engine import Engine
from engines.line import started
from engines.process.isolation import TIME_LIMIT, interpreter_for, isolated, run_engine
from reference.outcome import Outcome
from reference.state import Array
from reference.system import MassSpringSystem
from tests.conformance.case import Case

T = TypeVar("T")

#: How long many cases may take in an environment of its own, where some engines take seconds for each start [s].
APART_LIMIT = 900.0


def run_all(engine: Engine, cases: Sequence[Case]) -> list[Outcome]:
    """How all cases end."""
    return [run_engine(engine, case.system, case.dt, case.steps, tuple(case.changes)) for case in cases]


@dataclass(frozen=True, eq=False)
class Look:
    """The states a simulation hands out: at the start, again after the first was overwritten, after a step.

    Attributes:
        kept: the arrays of the second, as they are after the step.
        bare: after another step, which is the engine's own and nothing else.
    """

    first: tuple[Array, Array]
    second: tuple[Array, Array]
    kept: tuple[Array, Array]
    stepped: tuple[Array, Array]
    bare: tuple[Array, Array]


def look_on(engine: Engine, systems: Sequence[MassSpringSystem]) -> list[Look]:
    """Look at the states of systems, write into what the engine hands out, and look again."""
    return [_look(engine, system) for system in systems]


def _look(engine: Engine, system: MassSpringSystem) -> Look:
    simulation = started(engine, system, 1e-3)
    handed_out = simulation.state()
    first = (handed_out[0].copy(), handed_out[1].copy())
    for array in handed_out:
        array[:] = np.nan
    kept = simulation.state()
    second = (kept[0].copy(), kept[1].copy())
    simulation.step()
    stepped = simulation.state()
    simulation.bare_step()()
    return Look(first, second, kept, stepped, simulation.state())


def result_of(task: Callable[..., T], *arguments: object) -> T:
    """What a task returns from a process of its own."""
    python = interpreter_for(arguments)
    if python is not None:
        # an environment of its own sees two rooms of the lab: this process of it is shown the tests, too, before those
        # of packages that bring some along
        isolated(exec, f"import sys; sys.path.insert(0, {str(Path(__file__).parents[2])!r})", python=python)
    result = isolated(task, *arguments, time_limit=TIME_LIMIT if python is None else APART_LIMIT)
    assert not isinstance(result, Outcome), f"{result.ending}: {result.reason}"
    return result
