"""A step-size series of an engine: runs with one dt after another, in one process.

Needs NumPy only: engines' processes import it.
"""

from __future__ import annotations

from collections.abc import Sequence

from engines.engine import Engine
from engines.process.isolation import EngineStepper, run_engine
from reference.outcome import Outcome
from reference.system import MassSpringSystem


def engine_series(
    stepper: EngineStepper, system: MassSpringSystem, duration: float, steps: Sequence[int]
) -> list[Outcome]:
    """The outcomes of runs that take these numbers of steps for the same duration [s].

    One process does for all of them; where it breaks, each gets its own, so that it is known which one broke it.
    """
    if stepper.version is not None:
        answer = stepper.isolate(run_series, stepper.engine, system, duration, steps, time_limit=stepper.time_limit)
        if isinstance(answer, list):
            return answer
    return [stepper.run(system, duration / n, n) for n in steps]


def run_series(engine: Engine, system: MassSpringSystem, duration: float, steps: Sequence[int]) -> list[Outcome]:
    """The same in this very process."""
    return [run_engine(engine, system, duration / n, n) for n in steps]
