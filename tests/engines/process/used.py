"""Tasks that tell which process they are in, and what it has been through. Nothing heavy is imported here."""

from __future__ import annotations

import os
import signal
import sys
import time
from multiprocessing import forkserver
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from engines.process.isolation import isolated
from engines.process.supervisor import Supervisor
from tests.engines.process import misbehaving

#: Whether this process has been used by a task that leaves a mark.
marked = False


def mark() -> int:
    """Leave a mark in this process, and say which it is."""
    global marked
    marked = True
    return os.getpid()


def crash_if_marked() -> int:
    """Say which process this is; but crash where another task has left its mark."""
    if marked:
        misbehaving.segfault()
    return os.getpid()


def pid() -> int:
    """Say which process this is."""
    return os.getpid()


def gather(folder: Path, count: int) -> int:
    """Say which process this is, once this number of processes are in a folder at once."""
    (folder / str(os.getpid())).touch()
    while len(list(folder.iterdir())) < count:
        time.sleep(0.01)
    return os.getpid()


def say(words: str) -> int:
    """Print some words on standard error, and say which process this is."""
    os.write(2, f"{words}\n".encode())
    return os.getpid()


def note(file: Path) -> int:
    """Write one more line with the process's number into a file, and say how many there are."""
    with file.open("a") as opened:
        opened.write(f"{os.getpid()}\n")
    return len(file.read_text().splitlines())


def crash(file: Path) -> NoReturn:
    """Note it, and crash."""
    note(file)
    os.abort()


def kill_oneself(file: Path) -> NoReturn:
    """Note it, and be killed by oneself, as the kernel does for want of memory."""
    note(file)
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError


def wait_at_first(file: Path, tries: int) -> int:
    """Note it, and hang; but come to an end when it has been tried so often."""
    if note(file) < tries:
        time.sleep(60)
    return os.getpid()


def be_sent(number: int) -> NoReturn:
    """Be ended by a signal of that number."""
    os.kill(os.getpid(), number)
    time.sleep(60)
    raise AssertionError


def eat(size: int) -> NoReturn:
    """Hold so much memory [bytes], every page of it touched, for longer than anybody waits."""
    taken = np.ones(size // 8)
    time.sleep(60)
    raise AssertionError(len(taken))


def hears_interrupts() -> bool:
    """Whether Ctrl-C would reach this process."""
    blocked = signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, ())
    return not blocked and signal.getsignal(signal.SIGINT) != signal.SIG_IGN


def have_it_done(file: Path) -> object:
    """Let a process of this one's own note itself and hang."""
    return isolated(wait_at_first, file, 2, time_limit=600.0)


def parent() -> int:
    """Say which process has forked this one."""
    return os.getppid()


def parents(server_is_gone: bool) -> tuple[object, int]:
    """Who has forked a process of this one's own, and this one; perhaps after its server cannot be found any more."""
    if server_is_gone:
        server: Any = forkserver._forkserver
        server._forkserver_address = str(Path("nobody").absolute())
    own = Supervisor()
    theirs = own.run(parent, (), 600.0, 4 * 2**30)
    own.stop()
    return theirs, parent()


def prefix() -> str:
    """Where the interpreter is at home."""
    return sys.prefix


def start_threads() -> int:
    """Let Numba start its threads, and say how many there are."""
    import numba

    return int(numba.get_num_threads())
