"""How a process of tests ends: by itself, by a limit of what it may use, or because it waits for ever."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

import psutil

#: What a process ends with that has been stopped by a limit of time.
OUT_OF_TIME = (-signal.SIGKILL, -signal.SIGXCPU)

#: No more memory than this for one process [kB]: a mistake may ask for any amount.
MEMORY = 8_000_000

#: Tests that for so long use less than a second on a processor wait for ever [s].
WAITS = 60.0


@dataclass(frozen=True)
class TestRun:
    """What came of some tests.

    Attributes:
        passed: all of them, or there were none.
        in_time: they ended before a limit of time.
        used: how long a processor worked for them, in all their processes [s].
        said: the last lines they printed.
    """

    passed: bool
    in_time: bool
    used: float
    said: str


def ended(pid: int, stop: Callable[[], bool]) -> tuple[int, float]:
    """What a process, the first of its group, ends with, and what a processor worked for it and all it started [s].

    It is killed with its group if it is to `stop`, or waits for ever. Not by the clock: a machine that is busy with
    something else is no endless loop. What waits for ever is told by its using no time at all.
    """
    begin, before = time.monotonic(), 0.0
    while True:
        found, status, usage = os.wait4(pid, os.WNOHANG)
        if found:
            return os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime
        if time.monotonic() > begin + WAITS and _used(pid) < before + 1.0:
            os.killpg(pid, signal.SIGKILL)
        elif time.monotonic() > begin + WAITS:
            begin, before = time.monotonic(), _used(pid)
        if stop():
            os.killpg(pid, signal.SIGKILL)
        time.sleep(0.01)


def _used(pid: int) -> float:
    """How long a processor has worked for a process and all it has started [s]."""
    with suppress(psutil.NoSuchProcess):
        root = psutil.Process(pid)
        return sum(sum(process.cpu_times()[:4]) for process in [root, *root.children(recursive=True)])
    return 0.0
