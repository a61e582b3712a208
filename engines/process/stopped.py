"""The server that forks processes, stopped (SIGSTOP): nobody would ever be told anything by it. It is ended then.

What waits for it sees that it is no more, and another one is started. That it is slow is no reason, on a busy machine:
it is looked at whether the kernel has it as stopped, many times over.
"""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from multiprocessing import forkserver
from typing import Any

#: Looks at it [s], and how many of them, one after the other, have to find it stopped.
LOOK, LOOKS = 0.1, 50


@contextmanager
def stopped_ends() -> Iterator[None]:
    """Meanwhile a server that is stopped, and stays so, is ended."""
    done = threading.Event()
    watch = threading.Thread(target=_watch, args=(done,), daemon=True)
    with suppress(RuntimeError):  # Python 3.12 starts no thread while a program ends: then nobody watches
        watch.start()
    try:
        yield
    finally:
        done.set()


def _watch(done: threading.Event) -> None:
    found = 0
    while not done.wait(LOOK):
        server = server_pid()
        found = found + 1 if server is not None and is_stopped(server) else 0
        if found == LOOKS and server is not None:
            with suppress(OSError):
                os.kill(server, signal.SIGKILL)


def server_pid() -> int | None:
    """The number of the process that forks; None where there is none. The standard library tells nobody."""
    if not forked_by_server():
        return getattr(forkserver._forkserver, "_forkserver_pid", None)
    parent = os.getppid()
    return parent if _serves(parent) else None


def forked_by_server() -> bool:
    """Whether this process was forked by a server that it can ask for more; CPython 3.14 keeps its key to itself."""
    server: Any = forkserver._forkserver
    known = server._forkserver_pid is None and server._forkserver_address is not None
    return known and getattr(server, "_forkserver_authkey", b"") is not None


def _serves(pid: int) -> bool:
    """Whether it is a server: once that has gone, somebody else is a process's parent."""
    import psutil

    try:
        return any("multiprocessing.forkserver" in word for word in psutil.Process(pid).cmdline())
    except psutil.Error:
        return False


def is_stopped(pid: int) -> bool:
    """Whether a process is stopped, by a signal or by a debugger."""
    import psutil

    try:
        return psutil.Process(pid).status() in (psutil.STATUS_STOPPED, psutil.STATUS_TRACING_STOP)
    except psutil.Error:
        return False
