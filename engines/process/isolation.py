"""An engine run in a process of its own: a crash, a hang or an exit is an outcome with its name, and nobody else's."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Protocol, TypeVar

import numpy as np

from engines.engine import Engine, Precision, absence, precision, version
from engines.line import started
from engines.process.available import interpreter
from engines.process.environments import version_numbers
from engines.process.packages import APART
from engines.process.supervisor import supervisor
from engines.process.worker_main import one_line
from reference.changes import Change, applied, changes_by_step
from reference.errors import Fault, InputError, Unsupported
from reference.outcome import Outcome, outcome_of
from reference.scenes import find
from reference.springs.breaking import breaking
from reference.state import State, Trajectory
from reference.system import BREAK, HELD, MassSpringSystem

#: A run may take this long [s] before it counts as hung.
TIME_LIMIT = 60.0

#: The most memory that its process may hold [bytes].
MEMORY_LIMIT = 4 * 2**30

T = TypeVar("T")


class Isolate(Protocol):
    """Something that calls a function in a process of its own, somewhere."""

    def __call__(self, function: Callable[..., T], *arguments: Any, time_limit: float = TIME_LIMIT) -> T | Outcome:
        """See `isolated`."""


def isolated(
    function: Callable[..., T],
    *arguments: Any,
    time_limit: float = TIME_LIMIT,
    memory_limit: float = MEMORY_LIMIT,
    python: Path | None = None,
) -> T | Outcome:
    """What a function returns, called in a process of its own; if that ends first, the outcome that says why.

    The process works in a scratch folder that is removed afterwards, and what it prints is kept for the reason.

    Args:
        function: of a module (it travels by name); its arguments travel as pickles.
        time_limit: [s].
        memory_limit: [bytes].
        python: an interpreter that can import `engines` and NumPy; left out, that of the environment that is kept for
            the engine among the arguments, or this one.
    """
    python = python or interpreter_for(arguments)
    late = None if python is None else _started_up(arguments, python, memory_limit)
    if late is not None:
        return late
    return supervisor(python).run(function, arguments, time_limit, memory_limit)


#: The engines, of environments of their own, that have made their first step once, by name and interpreter.
_STARTED: set[tuple[str, Path]] = set()


def _started_up(arguments: Sequence[Any], python: Path, memory_limit: float) -> Outcome | None:
    """Let an engine make its first step, within the time its package has for that: importing, compiling kernels.

    Returns:
        How that ended, if not well.
    """
    for argument in arguments:
        package, start = getattr(argument, "package", None), getattr(argument, "start", None)
        if not isinstance(package, str) or package not in APART or not callable(start):
            continue
        if (argument.name, python) in _STARTED:
            continue
        ended = supervisor(python).run(first_step, (argument,), APART[package].start_up, memory_limit)
        if isinstance(ended, Outcome):
            return Outcome(ended.ending, f"starting {package}: {ended.reason}")
        _STARTED.add((argument.name, python))
    return None


def first_step(engine: Engine) -> float:
    """One step of a mass that hangs from a spring, which every engine can do; where the mass then is [m]."""
    system = find("string").system({"masses": 1})
    simulation = engine.start(replace(system, positions=system.positions[:, ::-1] * [1.0, -1.0]), 1e-3)
    simulation.step()
    return float(simulation.state()[0][-1, -1])


def interpreter_for(arguments: Sequence[Any]) -> Path | None:
    """The Python of an engine's own environment, where its package is not beside the lab but in one that is kept."""
    packages = [package for argument in arguments if isinstance(package := getattr(argument, "package", None), str)]
    return next((python for package in packages if (python := interpreter(package)) is not None), None)


def in_this_process(function: Callable[..., T], *arguments: Any, time_limit: float = TIME_LIMIT) -> T | Outcome:
    """What a function returns, called here: for what cannot travel to another process. There is no limit on it.

    What a user's own step does that no step may ends it as an outcome, as it does elsewhere.
    """
    try:
        return function(*arguments)
    except Fault as error:
        return Outcome("crashed", one_line(str(error)))


@dataclass(frozen=True)
class EngineStepper:
    """An engine as a stepper: every run in a process of its own.

    Attributes:
        isolate: who sees to that.
        pinned: the engine's version there; left out, the one installed here.
    """

    engine: Engine
    time_limit: float = TIME_LIMIT
    isolate: Isolate = isolated
    pinned: str | None = None
    kind: str = "engine"

    @property
    def name(self) -> str:
        """The engine's name."""
        return self.engine.name

    @property
    def version(self) -> str | None:
        """The version of the engine's package."""
        return self.pinned or version(self.engine)

    @property
    def claims(self) -> tuple[str, ...]:
        """The schemes that the engine claims to step by: identification tries them too."""
        return tuple(dict.fromkeys(self.identified_as.values()))

    @property
    def identified_as(self) -> Mapping[str, str]:
        """The engine's, or those of an earlier version of its package, where it is run in one (`formerly`)."""
        formerly: Mapping[str, Mapping[str, str]] = getattr(self.engine, "formerly", {})
        now = version_numbers(self.version or "")
        claims = [claims for last, claims in formerly.items() if now and now <= version_numbers(last)]
        return claims[0] if claims else self.engine.identified_as

    @property
    def precision(self) -> Precision:
        """In which floating-point numbers the engine keeps its state: how far rounding goes."""
        return precision(self.engine)

    @property
    def interactive_up_to(self) -> int | None:
        """How many masses the engine steps some hundred times within half a minute; None where it does not say."""
        return getattr(self.engine, "interactive_up_to", None)

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """See reference.stepper.Stepper."""
        if self.version is None:
            return Outcome("unsupported", absence(self.engine))
        return self.isolate(run_engine, self.engine, system, dt, steps, tuple(changes), time_limit=self.time_limit)

    def run_each(self, runs: Sequence[tuple[MassSpringSystem, float, int]]) -> list[Outcome]:
        """What `run` does, of many systems with their dt [s] and steps, all in one process: for short runs."""
        if self.version is None:
            return [Outcome("unsupported", absence(self.engine))] * len(runs)
        cases = [tuple(run) for run in runs]
        # many short runs are no run to be kept
        call = in_this_process if self.isolate is in_this_process else isolated
        answer = call(run_engine_on_each, self.engine, cases, time_limit=self.time_limit)
        return [answer] * len(runs) if isinstance(answer, Outcome) else answer


def run_engine_on_each(engine: Engine, runs: Sequence[tuple[MassSpringSystem, float, int]]) -> list[Outcome]:
    """Run an engine in this very process on one system after another; what it cannot do once it is not asked again."""
    outcomes: list[Outcome] = []
    for run in runs:
        refused = bool(outcomes) and outcomes[-1].ending == "unsupported"
        outcomes.append(outcomes[-1] if refused else run_engine(engine, *run))
    return outcomes


def run_engine(
    engine: Engine, system: MassSpringSystem, dt: float, steps: int, changes: tuple[Change, ...] = ()
) -> Outcome:
    """Run an engine in this very process, ending early once its state is not a number."""
    pending, first = changes_by_step(changes, dt), system
    try:
        simulation = started(engine, system, dt)
        states = [system.start]
        for step in range(steps):
            for change in pending.get(step, ()):
                if change.parameter in HELD:
                    # no engine is asked to do that while it runs: it goes on from here as another system
                    system, state = applied(change, system, states[-1])
                    simulation = started(engine, system.at(state), dt)
                else:
                    system = system.with_parameter(change.parameter, change.value)
                    simulation.change(change.parameter, change.value)
            simulation.step()
            states.append(State((step + 1) * dt, *simulation.state()))
            broken = breaking(system, states[-1])
            if len(broken):
                system = system.with_parameter(BREAK, broken.tolist())
                simulation.change(BREAK, broken.tolist())
            if not np.isfinite(states[-1].positions).all():
                break
    except (Unsupported, InputError) as error:
        return Outcome("unsupported", str(error))
    except Fault as error:
        return Outcome("crashed", one_line(str(error)))
    return outcome_of(first, Trajectory.of(states), changes)
