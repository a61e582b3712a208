"""An engine run in a process of its own: a crash, a hang or an exit is an outcome with its name, and nobody else's.

On the standard library's Process and Pipe: a connection that closes without an answer, or a process that is no more,
is noticed at once; what the engine had to say on its way out is kept.
"""

from __future__ import annotations

import faulthandler
import multiprocessing
import os
import signal
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from engines.engine import Engine, version
from reference.changes import Change, changes_by_step
from reference.errors import Unsupported
from reference.outcome import Outcome, outcome_of
from reference.state import State, Trajectory
from reference.system import MassSpringSystem

#: A run may take this long [s] before it counts as hung.
TIME_LIMIT = 60.0

T = TypeVar("T")

#: Once it has answered, a process has so long [s] to tidy up and end by itself.
GRACE = 1.0

#: Where, in its scratch folder, a process's output is kept.
OUTPUT = "output.txt"


@dataclass(frozen=True)
class EngineStepper:
    """An engine as a stepper: every run in a fresh process."""

    engine: Engine
    time_limit: float = TIME_LIMIT
    kind: str = "engine"

    @property
    def name(self) -> str:
        """The engine's name."""
        return self.engine.name

    @property
    def version(self) -> str | None:
        """The installed version of the engine's package."""
        return version(self.engine)

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """See reference.stepper.Stepper."""
        if self.version is None:
            return Outcome("unsupported", f"{self.engine.package} is not installed")
        return isolated(run_engine, self.engine, system, dt, steps, tuple(changes), time_limit=self.time_limit)


def run_engine(
    engine: Engine, system: MassSpringSystem, dt: float, steps: int, changes: tuple[Change, ...] = ()
) -> Outcome:
    """Run an engine in this very process, ending early once its state is not a number."""
    pending = changes_by_step(changes, dt)
    try:
        simulation = engine.start(system, dt)
        states = [system.start]
        for step in range(steps):
            for change in pending.get(step, ()):
                simulation.change(change.parameter, change.value)
            simulation.step()
            states.append(State((step + 1) * dt, *simulation.state()))
            if not np.isfinite(states[-1].positions).all():
                break
    except Unsupported as error:
        return Outcome("unsupported", str(error))
    return outcome_of(system, Trajectory.of(states))


def isolated(task: Callable[..., T], *arguments: Any, time_limit: float = TIME_LIMIT) -> T | Outcome:
    """What a task in a process of its own returns; if that ends without an answer, the outcome that says why.

    The process works in a scratch folder that is removed afterwards, and what it prints is kept for the reason.

    Args:
        task: a function of a module (it travels by name); its arguments travel as pickles.
        time_limit: [s].
    """
    context = _context()
    ours, theirs = context.Pipe(duplex=False)
    with tempfile.TemporaryDirectory(prefix="springlab-") as scratch:
        process = context.Process(target=_work, args=(theirs, scratch, task, arguments))
        process.start()
        theirs.close()
        try:
            return _answer(process, ours, Path(scratch), time_limit)
        finally:
            process.kill()
            process.join()
            ours.close()


def _context() -> Any:
    """Processes forked from a server that has imported this file and nothing heavy: 10 ms each, and no shared state."""
    if sys.platform == "win32":
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["engines.isolation"])
    return context


def _work(answer: Connection, scratch: str, task: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    """What the process does: the task, and its outcome or its exception down the pipe."""
    os.chdir(scratch)
    output = os.open(OUTPUT, os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    for standard in (1, 2):
        os.dup2(output, standard)
    faulthandler.disable()
    try:
        answer.send(task(*arguments))
    except Exception as error:
        answer.send(Outcome("crashed", f"{type(error).__name__}: {_one_line(str(error))}"))


def _answer(process: BaseProcess, answer: Connection, scratch: Path, time_limit: float) -> Any:
    """Wait for the answer, or for the process to be gone: a child it left behind may still hold the pipe open."""
    if not wait([answer, process.sentinel], time_limit):
        return Outcome("timed out", f"no answer within {time_limit:g} s")
    try:
        if answer.poll():
            received = answer.recv()
            process.join(GRACE)
            return received
    except (EOFError, OSError):  # no answer, or half of one
        pass
    process.join()
    return Outcome("crashed", _cause(process.exitcode or 0) + _last_words(scratch / OUTPUT))


def _cause(exit_code: int) -> str:
    if exit_code < 0:
        return f"killed by {signal.Signals(-exit_code).name}"
    return f"ended with exit code {exit_code} and no answer"


def _last_words(output: Path) -> str:
    """The last line that says something of what the process printed, if any does."""
    text = output.read_text(errors="replace") if output.exists() else ""
    lines = [line for line in text.splitlines() if any(map(str.isalpha, line))]
    return f"; it said: {_one_line(lines[-1])}" if lines else ""


def _one_line(text: str) -> str:
    return " ".join(text.split())[:300]
