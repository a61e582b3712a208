"""Wall time of stepping alone, nothing else. Needs NumPy only: engines' processes import it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from math import log
from time import perf_counter

from engines.engine import Engine, Simulation
from engines.line import started
from reference.errors import Unsupported
from reference.outcome import Outcome
from reference.state import Array
from reference.system import MassSpringSystem

#: A time is the least of some tries, as whatever else a machine does only adds to it: of this many at most, ...
TRIES = 8

#: ... together at most this long [s], ...
BUDGET = 0.015

#: ... and each at least this long [s]: well above what a call takes, and below what a busy machine interrupts.
WINDOW = 1e-3

#: A system is too large for an engine where its start or a step takes longer than this [s].
LIMIT = 0.5


@dataclass(frozen=True)
class Timing:
    """One run: its wall time [s], and where its masses end [m]."""

    seconds: float
    positions: Array


@dataclass(frozen=True)
class Speeds:
    """Wall time of a step [s] on ever larger systems, as many as were small enough; why the others were not tried."""

    seconds: Sequence[float]
    reason: str = ""


def least(runs: Sequence[Callable[[], Timing]]) -> list[Timing]:
    """The quickest try of each run. They take turns, so that all meet the same disturbances."""
    best = [run() for run in runs]
    spent = [timing.seconds for timing in best]
    for _ in range(TRIES - 1):
        for i, run in enumerate(runs):
            if spent[i] < BUDGET:
                timing = run()
                spent[i] += timing.seconds
                best[i] = min(best[i], timing, key=lambda t: t.seconds)
    return best


def seconds_of(task: Callable[[], object]) -> float:
    """How long a task takes [s]."""
    begin = perf_counter()
    task()
    return perf_counter() - begin


def seconds_per_step(advance: Callable[[int], object]) -> float:
    """How long a step takes [s], given a function that takes some number of them."""
    advance(1)  # the first time may load or compile something
    steps = 1
    while seconds_of(partial(advance, steps)) < WINDOW:
        steps *= 2
    tries = [seconds_of(partial(advance, steps))]
    while len(tries) < TRIES and sum(tries) < BUDGET:
        tries.append(seconds_of(partial(advance, steps)))
    return min(tries) / steps


def engine_cost(
    engine: Engine,
    system: MassSpringSystem,
    runs: Sequence[tuple[float, int]],
    larger: Sequence[MassSpringSystem],
    dt: float,
) -> tuple[list[Timing], Speeds] | Outcome:
    """In this very process: runs of a system, each of a dt [s] and a number of steps, and the speed on larger ones."""
    try:
        timings = least([partial(_engine_run, engine, system, *run) for run in runs])
        return timings, engine_speeds(engine, larger, dt)
    except Unsupported as error:
        return Outcome("unsupported", str(error))


def _engine_run(engine: Engine, system: MassSpringSystem, dt: float, steps: int) -> Timing:
    simulation = started(engine, system, dt)
    seconds = seconds_of(partial(_advance, simulation, steps))
    return Timing(seconds, simulation.state()[0])


def engine_speeds(engine: Engine, systems: Sequence[MassSpringSystem], dt: float) -> Speeds:
    """An engine's speed on ever larger systems, up to where a start or a step is expected to take too long."""
    sizes: list[int] = []
    starts: list[float] = []
    steps: list[float] = []
    for system in systems:
        size = int((~system.fixed).sum())
        expected = max(_extrapolated(sizes, starts, size), _extrapolated(sizes, steps, size))
        if expected > LIMIT:
            return Speeds(steps, f"the next start or step, of {size} masses, would take some {expected:.1g} s")
        begin = perf_counter()
        simulation = started(engine, system, dt)
        starts.append(perf_counter() - begin)
        steps.append(seconds_per_step(partial(_advance, simulation)))
        sizes.append(size)
    return Speeds(steps)


def _advance(simulation: Simulation, steps: int) -> None:
    for _ in range(steps):
        simulation.step()


def _extrapolated(sizes: Sequence[int], seconds: Sequence[float], size: int) -> float:
    """The time at a size [s] if it goes on as a power of it, as it did last; 0 where there is nothing to go by."""
    if len(sizes) < 2:
        return 0.0
    power = log(seconds[-1] / seconds[-2]) / log(sizes[-1] / sizes[-2])
    return seconds[-1] * (size / sizes[-1]) ** power


def adapter_overhead(engine: Engine, system: MassSpringSystem, dt: float) -> tuple[float, float] | Outcome:
    """Seconds of a step through the adapter, and of the engine's own step alone, in this very process.

    One simulation is stepped both ways in turns, as two would lie in different places of the memory, which alone makes
    some per cent; of each way the least of many tries is kept.
    """
    try:
        simulation = started(engine, system, dt)
    except Unsupported as error:
        return Outcome("unsupported", str(error))
    loops = (_loop(simulation.step), _loop(simulation.bare_step()))
    steps = max(10, int(2e-2 / seconds_per_step(loops[1])))
    tries = [[seconds_of(partial(loop, steps)) / steps for loop in loops] for _ in range(25)]
    step, alone = (min(column) for column in zip(*tries, strict=True))
    return step, alone


def _loop(step: Callable[[], object]) -> Callable[[int], None]:
    def loop(steps: int) -> None:
        for _ in range(steps):
            step()

    return loop
