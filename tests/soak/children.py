"""Processes: those that are started here, what they have started in turn, and who kills them when."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from random import Random

import psutil

ROOT = Path(__file__).parents[2]

#: Every process that is left alone has ended after this time [s], however busy the machine is.
SOON = 600.0


def start(*words: str, environment: dict[str, str] | None = None) -> subprocess.Popen[str]:
    """A program in a session of its own, in the project's folder; its output can be read, and it hears Ctrl-C.

    A shell that runs the tests in its background has them, and all they start, ignore it.
    """
    return subprocess.Popen(
        words,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), **(environment or {})},
        start_new_session=True,
        preexec_fn=partial(signal.signal, signal.SIGINT, signal.SIG_DFL),
    )


def start_sweep(store: Path, count: int, *options: str) -> subprocess.Popen[str]:
    """The sweep as a program, its store open."""
    child = start(sys.executable, "-m", "tests.soak.sweep", str(store), str(count), *options)
    assert child.stdout is not None
    assert child.stdout.readline() == "begun\n", child.communicate()[1]
    return child


def run_sweep(store: Path, count: int, *options: str) -> int:
    """The sweep, to its end: how many runs were done."""
    out, err = start_sweep(store, count, *options).communicate()
    assert out.startswith("done "), err
    assert err == ""
    return int(out.split()[1])


def family(pid: int) -> list[psutil.Process]:
    """All processes that a process has started, and theirs."""
    with suppress(psutil.NoSuchProcess):
        return psutil.Process(pid).children(recursive=True)
    return []


def check_all_end(processes: Iterable[psutil.Process]) -> None:
    """They are no more, or will soon be; one that only waits to be buried counts as gone."""
    deadline = time.monotonic() + SOON
    left = [p for p in processes if lives(p)]
    while left and time.monotonic() < deadline:
        time.sleep(0.02)
        left = [p for p in left if lives(p)]
    names = [(p.pid, " ".join(p.cmdline())) for p in left if lives(p)]
    for process in left:
        process.kill()
    assert not names, f"still there after {SOON:g} s: {names}"


def lives(process: psutil.Process) -> bool:
    """Whether a process is still there and not a zombie."""
    with suppress(psutil.NoSuchProcess):
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE
    return False


def kill_one(victims: Sequence[int], random: Random) -> bool:
    """Kill one of some processes with SIGKILL: whether there was one to be killed."""
    if not victims:
        return False
    try:
        os.kill(random.choice(victims), signal.SIGKILL)
    except ProcessLookupError:
        return False
    return True
