"""A throw-away copy of a project, in which one source file at a time has a mistake and some tests run."""

from __future__ import annotations

import importlib.util
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from threading import Event

import psutil

from reference.cache import cache_folder
from tests.mutants.mutations import Mutant

#: What is not copied: nothing of it is a source or a test.
LEFT_OUT = (".git", ".venv*", "results", ".*_cache", ".hypothesis", "__pycache__")

#: No more memory than this for one process [kB]: a mistake may ask for any amount.
MEMORY = 8_000_000

#: What pytest ends with when all is well, and when there is no test.
PASSED, NO_TESTS = 0, 5

#: What a process ends with that has been stopped by a limit of time.
OUT_OF_TIME = (-signal.SIGKILL, -signal.SIGXCPU)

#: Tests that for so long use less than a second on a processor wait for ever [s].
WAITS = 180.0


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


class ProjectCopy:
    """A copy of the project at `root` within a folder. Once `stop` is set, all runs in it end."""

    def __init__(self, root: Path, folder: Path, stop: Event) -> None:
        self._root, self._scratch, self._cache = folder / "project", folder / "scratch", folder / "cache"
        self._stop = stop
        shutil.copytree(root, self._root, ignore=shutil.ignore_patterns(*LEFT_OUT))
        self._scratch.mkdir()
        # Kernels stand under the digest of their text, so that a mistake in a law or a loop is compiled anew: but not
        # into the user's own cache, which would keep it.
        shutil.copytree(cache_folder("kernels"), self._cache / "springlab" / "kernels")

    @contextmanager
    def mutated(self, mutant: Mutant) -> Iterator[None]:
        """With a mutant's mistake in its file, and no compiled file left of it, before or after."""
        file = self._root / mutant.file
        source = file.read_text(encoding="utf-8")
        try:
            self._write(file, mutant.applied(source))
            yield
        finally:
            self._write(file, source)

    def run(self, tests: Sequence[str], options: Sequence[str], limit: float) -> TestRun:
        """Some test files, in this order, until the first failure or until a process has used its limit [s].

        Not by the clock: a machine that is busy with something else is no endless loop. What waits for ever is told by
        its using no time at all.

        Raises:
            InterruptedError: once it is to stop.
        """
        if self._stop.is_set():
            raise InterruptedError("stopped")
        pytest = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:randomly", "-p", "no:cacheprovider"]
        limited = ["/bin/sh", "-c", f'ulimit -t {int(limit) + 1} && ulimit -d {MEMORY} && exec "$@"', "sh", *pytest]
        output = self._scratch / "output"
        with output.open("w") as file:
            process = subprocess.Popen(
                [*limited, "--hypothesis-seed=0", *options, *tests],
                cwd=self._root,
                env=self._environment(),
                stdout=file,
                stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL,
                start_new_session=True,
            )
            process.returncode, used = self._ended(process.pid)
        shutil.rmtree(self._root / ".hypothesis", ignore_errors=True)
        said = "\n".join(output.read_text(errors="replace").splitlines()[-8:])
        passed = process.returncode in (PASSED, NO_TESTS)
        return TestRun(passed, process.returncode not in OUT_OF_TIME, used, said)

    def _ended(self, pid: int) -> tuple[int, float]:
        """How a process ended, killed with its group if it is to stop or waits for ever; and what it used [s]."""
        begin, before = time.monotonic(), 0.0
        while True:
            found, status, usage = os.wait4(pid, os.WNOHANG)
            if found:
                return os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime
            if time.monotonic() > begin + WAITS and _used(pid) < before + 1.0:
                os.killpg(pid, signal.SIGKILL)
            elif time.monotonic() > begin + WAITS:
                begin, before = time.monotonic(), _used(pid)
            if self._stop.is_set():
                os.killpg(pid, signal.SIGKILL)
            time.sleep(0.05)

    def _write(self, file: Path, text: str) -> None:
        file.write_text(text, encoding="utf-8")
        Path(importlib.util.cache_from_source(str(file))).unlink(missing_ok=True)

    def _environment(self) -> dict[str, str]:
        """The copy's modules, cache and temporary files."""
        return {
            **os.environ,
            "PYTHONPATH": str(self._root),
            "XDG_CACHE_HOME": str(self._cache),
            "TMPDIR": str(self._scratch),
        }


def _used(pid: int) -> float:
    """How long a processor has worked for a process and all it has started [s]."""
    with suppress(psutil.NoSuchProcess):
        root = psutil.Process(pid)
        return sum(sum(process.cpu_times()[:4]) for process in [root, *root.children(recursive=True)])
    return 0.0
