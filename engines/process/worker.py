"""A process that does one task after another, and what is said of it when it does not answer.

On the standard library's Process and Pipe: a connection that closes without an answer, or a process that is no more,
is noticed at once; what the task had to say on its way out is kept. Needs NumPy only, on both sides.
"""

from __future__ import annotations

import math
import multiprocessing
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from multiprocessing import process, resource_tracker, util
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any, Protocol

from engines.process.stopped import stopped_ends
from engines.process.worker_main import OUTPUT, one_line, work
from reference.outcome import Outcome
from reference.scratch import scratch_folder

#: How often a working process's memory is looked at [s].
LOOK = 0.05

#: How long a process that has closed its connection has to end by itself [s].
GRACE = 1.0

#: How long a process may take to be ready for its first task [s]: it imports NumPy, on a machine however busy.
READY_LIMIT = 600.0

#: How often to try to start a process, should the server that forks it be killed meanwhile.
STARTS = 20

#: Signals that come from outside: the kernel short of memory, a person, a machine that shuts down.
FROM_OUTSIDE = frozenset({signal.SIGKILL, signal.SIGTERM, signal.SIGHUP, signal.SIGINT})

#: The path of a temporary folder for which the path of a socket within one of ours is one that the system takes (104).
LONGEST_PATH = 40

#: The exit code of a process whose end nobody saw: the server that forked it was killed too.
UNSEEN = 255


#: What the server that forks processes imports before it forks any, and so each of them has: what engines need.
_IMPORTED = ["engines.process.isolation"]

#: What processes that run schemes need besides, and import most of a second for.
FOR_SCHEMES = "reference.compiled.preload"


def import_beforehand(*modules: str) -> None:
    """Have processes begin with some modules, which they need not import then; without effect once one was started."""
    _IMPORTED.extend(module for module in modules if module not in _IMPORTED)


def start_beforehand() -> None:
    """Start the server that forks processes: while it imports what they begin with, there is other work to be done."""
    if sys.platform != "win32":
        from engines.process.start_method import start_server

        _own_temporary_folder()
        with _deaf_to_interrupts():
            start_server(_IMPORTED)


class NoAnswerError(Exception):
    """A task did not answer.

    Attributes:
        outcome: how it ended.
        from_outside: whether somebody else ended it.
    """

    def __init__(self, outcome: Outcome, from_outside: bool = False) -> None:
        super().__init__(outcome.reason)
        self.outcome = outcome
        self.from_outside = from_outside


class NotStartedError(OSError):
    """A process came to its end before any task was begun: no task, and no engine, is to blame."""


class Process(Protocol):
    """What a worker needs of the process it is."""

    @property
    def pid(self) -> int | None:
        """Its number."""

    @property
    def sentinel(self) -> int:
        """What becomes ready once the process is no more."""

    def kill(self) -> None:
        """End it now."""

    def exit_code(self) -> int:
        """Wait for its end, not for long: its exit code, or a signal's negative number."""


class Worker:
    """A process of its own, started now.

    Args:
        python: an interpreter that can import `engines`; left out, this one.

    Attributes:
        fresh: whether it has not answered yet, so that whatever happens to it is its first task's doing.
    """

    def __init__(self, python: Path | None = None) -> None:
        self.fresh = True
        self._ready = False
        self._scratch = scratch_folder()
        for _ in range(STARTS - 1):
            with suppress(OSError, EOFError):  # the server was killed just now; once it is gone, a try starts a new one
                self._start(python)
                return
            time.sleep(LOOK)
        self._start(python)

    def _start(self, python: Path | None) -> None:
        """Start it, with pipes that nobody else holds: a try that failed may have left a process."""
        start = _Forked if python is None else _Launched
        self._connection, theirs = multiprocessing.Pipe()
        lifeline, self._lifeline = multiprocessing.Pipe(duplex=False)
        with theirs, lifeline, _deaf_to_interrupts():
            self._process: Process = start(theirs, lifeline, self._scratch, python)

    @property
    def pid(self) -> int | None:
        """The process's number."""
        return self._process.pid

    def do(
        self, function: Callable[..., Any], arguments: tuple[Any, ...], time_limit: float, memory_limit: float
    ) -> Any:
        """What a function returns there.

        Args:
            function: of a module (it travels by name); its arguments travel as pickles.
            time_limit: [s].
            memory_limit: [bytes], of the whole process.

        Raises:
            NoAnswerError: with how it ended. The worker is of no more use then.
            NotStartedError: where the process could not be started at all.
        """
        if not self._ready:
            self._await_start()
        with suppress(BrokenPipeError, ConnectionResetError):  # it is no more; why is seen below
            self._connection.send((function, arguments))
        self._wait(time_limit, memory_limit)
        with suppress(EOFError, OSError):  # no answer, or half of one
            if self._connection.poll():
                answer = self._connection.recv()
                self.fresh = False
                return answer
        raise self._ended()

    def _await_start(self) -> None:
        """Until the process says that it is ready. What goes wrong before that is no task's doing."""
        with suppress(NoAnswerError):  # the time is up
            self._wait(READY_LIMIT, math.inf)
        with suppress(EOFError, OSError):
            if self._connection.poll():
                self._connection.recv()
                self._ready = True
                return
        ended = self._ended()
        if ended.from_outside:
            raise ended
        raise NotStartedError(f"no process for engines could be started: it {ended.outcome.reason}")

    def _ended(self) -> NoAnswerError:
        """How the process came to its end."""
        code = self._process.exit_code()
        outcome = Outcome("crashed", _cause(code) + _last_words(self._scratch / OUTPUT))
        return NoAnswerError(outcome, from_outside=-code in FROM_OUTSIDE or code == UNSEEN)

    def end(self) -> None:
        """End the process, whatever it is at, and remove what it left."""
        self._process.kill()
        self._process.exit_code()
        self._connection.close()
        self._lifeline.close()
        shutil.rmtree(self._scratch, ignore_errors=True)

    def kill(self) -> None:
        """End the process from another thread than the one that waits for it."""
        self._process.kill()

    def _wait(self, time_limit: float, memory_limit: float) -> None:
        """Until there is an answer or the process is gone: a child it left behind may hold the connection open."""
        deadline = time.monotonic() + time_limit
        while not wait([self._connection, self._process.sentinel], min(LOOK, max(deadline - time.monotonic(), 0))):
            if time.monotonic() >= deadline:
                raise NoAnswerError(Outcome("timed out", f"no answer within {time_limit:g} s"))
            if _memory(self.pid) > memory_limit:
                raise NoAnswerError(Outcome("crashed", f"took more than {memory_limit / 2**30:.3g} GiB of memory"))


class _Forked:
    """A process forked from a server that has loaded what runs need, and runs nothing itself: 10 ms."""

    def __init__(self, connection: Connection, lifeline: Connection, scratch: Path, _: Path | None) -> None:
        if sys.platform == "win32":
            make: Any = multiprocessing.get_context("spawn").Process
        else:
            from engines.process.start_method import ForkedProcess

            _own_temporary_folder()
            multiprocessing.get_context("forkserver").set_forkserver_preload(_IMPORTED)
            make = ForkedProcess
        self._process = make(target=work, args=(connection, lifeline, scratch))
        with stopped_ends():
            self._process.start()
        self.pid, self.sentinel = self._process.pid, self._process.sentinel

    def kill(self) -> None:
        self._process.kill()

    def exit_code(self) -> int:
        self._process.join(GRACE)
        self._process.kill()
        with stopped_ends():
            self._process.join()
        return self._process.exitcode or 0


class _Launched:
    """A process of another interpreter."""

    def __init__(self, connection: Connection, lifeline: Connection, scratch: Path, python: Path | None) -> None:
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        pipes = [connection.fileno(), lifeline.fileno()]
        command = [str(python), "-m", "engines.process.worker_main", *map(str, pipes), str(scratch)]
        self._process = subprocess.Popen(command, pass_fds=pipes, cwd=scratch, env=environment)
        self.pid = self._process.pid
        self.sentinel = os.pidfd_open(self.pid)

    def kill(self) -> None:
        self._process.kill()

    def exit_code(self) -> int:
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(GRACE)
        self._process.kill()
        code = self._process.wait()
        if self.sentinel >= 0:
            os.close(self.sentinel)
            self.sentinel = -1
        return code


def _own_temporary_folder() -> None:
    """The standard library's folder for its sockets is one that says whose it is; where its path is not too long."""
    configuration: dict[str, Any] = process.current_process()._config  # type: ignore[attr-defined]
    if configuration.get("tempdir") is None and len(tempfile.gettempdir()) <= LONGEST_PATH:
        folder = configuration["tempdir"] = str(scratch_folder())
        util.Finalize(None, shutil.rmtree, args=(folder, True), exitpriority=-100)


@contextmanager
def _deaf_to_interrupts() -> Iterator[None]:
    """Processes started meanwhile hear no Ctrl-C from their first moment on; this one hears it afterwards."""
    if sys.platform == "win32":
        yield
        return
    # where it is started only now, it lets interrupts through again, before the server that forks is started
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _memory(pid: int | None) -> int:
    """What a process holds of the machine's memory [bytes]."""
    import psutil  # here: a bare environment, where nobody is watched, does without

    try:
        return int(psutil.Process(pid).memory_info().rss)
    except psutil.Error:  # it has ended, which is seen elsewhere
        return 0


def _cause(exit_code: int) -> str:
    if exit_code < 0:
        names = {known.value: known.name for known in signal.Signals}
        return f"killed by {names.get(-exit_code, f'signal {-exit_code}')}"
    return f"ended with exit code {exit_code} and no answer"


def _last_words(output: Path) -> str:
    """The last line that says something of what the process printed, if any does."""
    text = output.read_text(errors="replace") if output.exists() else ""
    lines = [line for line in text.splitlines() if any(map(str.isalpha, line))]
    return f"; it said: {one_line(lines[-1])}" if lines else ""
