"""Processes forked by the standard library's server, which begin with nothing of the program that asks for them.

The standard library has every new process import the program it was asked by, for the functions that stand there: a
plain script would run again in each, and one that is read from standard input cannot be found. Here what a process does
is always a function of a module. Nor does the server look into the folder it happens to be called in, where a file may
be named as one of ours.

A process that a server has forked asks that same server for processes of its own, as long as it is there: one of its
own would import all anew, most of a second.
"""

from __future__ import annotations

import io
import os
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import (
    context,
    forkserver,
    popen_forkserver,
    process,
    reduction,
    resource_tracker,
    spawn,
    util,
)
from typing import Any

from engines.process.stopped import forked_by_server

#: What a process is told of the program that asks for it, and has no use for.
OF_THE_PROGRAM = ("init_main_from_name", "init_main_from_path")


class ForkedProcess(context.ForkServerProcess):
    """A process that is forked by the server, and imports no program."""

    @staticmethod
    def _Popen(process_obj: process.BaseProcess) -> _Started:  # noqa: N802 - its name there
        return _Started(process_obj)


class _Started(popen_forkserver.Popen):
    """As the standard library's, which has no way to leave the program out (CPython 3.11 to 3.14)."""

    def _launch(self, process_obj: process.BaseProcess) -> None:
        told = spawn.get_preparation_data(process_obj.name)
        for name in OF_THE_PROGRAM:
            told.pop(name, None)
        message = io.BytesIO()
        context.set_spawning_popen(self)
        try:
            reduction.dump(told, message)
            reduction.dump(process_obj, message)
        finally:
            context.set_spawning_popen(None)
        with _looking_nowhere_else():
            self.sentinel, pipe = _new_process(self._fds)  # type: ignore[attr-defined]
        # a duplicate of the pipe's end tells the new process, once it is closed, that we are no more
        alive = os.dup(pipe)
        closing = util.close_fds  # type: ignore[attr-defined]
        self.finalizer = util.Finalize(self, closing, (alive, self.sentinel))
        with open(pipe, "wb", closefd=True) as opened:
            opened.write(message.getbuffer())
        self.pid = forkserver.read_signed(self.sentinel)


class _Known(forkserver.ForkServer):
    """A server that somebody else has started: it is there, or it is not."""

    def __init__(self, address: str, alive: int) -> None:
        super().__init__()
        self._forkserver_address, self._forkserver_alive_fd = address, alive

    def ensure_running(self) -> None:
        """Nothing is started here."""
        resource_tracker.ensure_running()


def _new_process(fds: list[int]) -> tuple[int, int]:
    """A new process's sentinel, and the pipe that says what it is to do. Raises OSError if the server has gone."""
    ours: Any = forkserver._forkserver
    if not forked_by_server():
        started: tuple[int, int] = forkserver.connect_to_new_process(fds)
        return started
    try:
        return _Known(ours._forkserver_address, ours._forkserver_alive_fd).connect_to_new_process(fds)
    except OSError:
        ours._forkserver_address = None  # the next process is asked for of a server of our own
        raise


def start_server(preloaded: list[str]) -> None:
    """Start a server of this process's own, unless it has one, which imports some modules and then forks."""
    if not forked_by_server():
        forkserver.set_forkserver_preload(preloaded)
        with _looking_nowhere_else():
            forkserver.ensure_running()


@contextmanager
def _looking_nowhere_else() -> Iterator[None]:
    """A server that is started meanwhile imports from where Python's packages are, not from the working folder."""
    before = os.environ.get("PYTHONSAFEPATH")
    os.environ["PYTHONSAFEPATH"] = "1"
    try:
        yield
    finally:
        if before is None:
            del os.environ["PYTHONSAFEPATH"]
        else:
            os.environ["PYTHONSAFEPATH"] = before
