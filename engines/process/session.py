"""An engine that stays: one simulation under way in a process of its own, advanced a few steps at a time.

What a run does at once (`isolation`), a page that people watch does bit by bit. A crash, a hang or an exit of the
engine is the end of this simulation, with its reason, and of nothing else. Needs NumPy only.
"""

from __future__ import annotations

import atexit
from collections.abc import Callable
from typing import Any
from weakref import WeakSet

from engines.engine import Engine, Simulation
from engines.line import started
from engines.process.available import interpreter
from engines.process.worker import NoAnswerError, NotStartedError, Worker
from reference.errors import InputError, Unsupported
from reference.outcome import Outcome
from reference.state import Array
from reference.system import MassSpringSystem, Value

#: An answer may take this long [s] before the engine counts as hung.
TIME_LIMIT = 10.0

#: The most memory that its process may hold [bytes].
MEMORY_LIMIT = 2 * 2**30

#: What stays between two tasks, in the process of its own: the simulation under way.
_under_way: list[Simulation] = []


class EngineStopped(Exception):  # noqa: N818 - an ending, as the five words are
    """An engine did not answer as it should.

    Attributes:
        outcome: how it ended.
    """

    def __init__(self, outcome: Outcome) -> None:
        super().__init__(outcome.reason)
        self.outcome = outcome


class Session:
    """A simulation in a process of its own, until `end`.

    Args:
        engine: which.
        system: where it starts, also in motion.
        dt: the step [s].
        time_limit: for every answer [s].

    Raises:
        EngineStopped: here and in all that follows, where the engine cannot do it, crashes, or does not answer.
    """

    def __init__(self, engine: Engine, system: MassSpringSystem, dt: float, time_limit: float = TIME_LIMIT) -> None:
        self._engine, self._time_limit = engine, time_limit
        self._worker: Worker | None = Worker(interpreter(engine.package))
        _open.add(self)
        self.restart(system, dt)

    @property
    def pid(self) -> int | None:
        """The process's number; None once it is no more."""
        return self._worker.pid if self._worker else None

    def restart(self, system: MassSpringSystem, dt: float) -> None:
        """Go on from another state, or with another dt [s]: the engine is given a system that is in motion."""
        self._ask(begin, self._engine, system, dt)

    def advance(self, steps: int) -> tuple[Array, Array]:
        """A number of steps: positions [m] and velocities [m/s] after them, each (n, d)."""
        x, v = self._ask(advance, steps)
        return x, v

    def change(self, parameter: str, value: Value) -> None:
        """Set one of reference.system.PARAMETERS on the fly."""
        self._ask(change, parameter, value)

    def end(self) -> None:
        """End the process."""
        if self._worker is not None:
            self._worker.end()
            self._worker = None

    def _ask(self, function: Callable[..., Any], *arguments: Any) -> Any:
        if self._worker is None:
            raise EngineStopped(Outcome("crashed", "the engine is no more"))
        try:
            answer = self._worker.do(function, arguments, self._time_limit, MEMORY_LIMIT)
        except NoAnswerError as failure:
            self.end()
            raise EngineStopped(failure.outcome) from None
        except NotStartedError as failure:
            self.end()
            raise EngineStopped(Outcome("unsupported", str(failure))) from None
        if isinstance(answer, Outcome):
            self.end()
            raise EngineStopped(answer)
        return answer


#: Those that have not been ended: Python, at its own end, would wait for their processes.
_open: WeakSet[Session] = WeakSet()


@atexit.register
def end_sessions() -> None:
    """End all processes of simulations under way."""
    for session in list(_open):
        session.end()


def begin(engine: Engine, system: MassSpringSystem, dt: float) -> Outcome | None:
    """Start a simulation, in place of the one before."""
    _under_way.clear()
    try:
        _under_way.append(started(engine, system, dt))
    except (Unsupported, InputError) as error:
        return Outcome("unsupported", str(error))
    return None


def advance(steps: int) -> tuple[Array, Array] | Outcome:
    """A number of steps of the simulation under way, and where it is then."""
    (simulation,) = _under_way
    try:
        for _ in range(steps):
            simulation.step()
    except Unsupported as error:
        return Outcome("unsupported", str(error))
    return simulation.state()


def change(parameter: str, value: Value) -> Outcome | None:
    """Set a parameter of the simulation under way."""
    (simulation,) = _under_way
    try:
        simulation.change(parameter, value)
    except (Unsupported, InputError) as error:
        return Outcome("unsupported", str(error))
    return None
