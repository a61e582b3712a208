"""A submission run in a fresh process of its own, that can neither reach the checker nor any file.

The process gets the submission's text and the arrays of the questions, in a folder that has the files which the student
was given and in which nobody can write, and leaves bytes, in which there is nothing but numbers and words (no pickle).
This process reads them (`reply`) and judges; it never imports a submission. The layers of the sandbox are those of
`sandbox_layers`; where one is missing the submission is not read.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import sysconfig
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import IO, Any

import numpy as np

from experiments.exercises.c.compiler import Compiled
from experiments.exercises.process import child
from experiments.exercises.process.reply import LONGEST, Reply, read
from experiments.exercises.process.sandbox_errors import NotGradedError

#: What a submission may have unless told otherwise: seconds of computing, and in all; memory [bytes].
SECONDS, MEMORY = 10, 2**30
WALL_CLOCK = 20.0

#: What a compiled submission is called in its folder, and what is compiled of it with its changes.
LIBRARY, VARIANTS = "submission.so", "variants.so"

#: How often its process is looked at [s]; and what a look counts for at most: a machine that stood still is not its
#: fault.
LOOK, STALL = 0.02, 0.5


@dataclass(frozen=True)
class Limits:
    """What a submission may take.

    Attributes:
        seconds: of computing.
        wall_clock: seconds in all, but for those in which it waits for a processor.
        memory: [bytes].
        exposed: whether it is run even where the machine cannot keep it from files and processes.
    """

    seconds: int = SECONDS
    wall_clock: float = WALL_CLOCK
    memory: int = MEMORY
    exposed: bool = False


def run(
    source: str,
    questions: Sequence[Mapping[str, Any]],
    limits: Limits | None = None,
    files: Mapping[str, str] | None = None,
    search: Mapping[str, Any] | None = None,
    compiled: Compiled | None = None,
    exercise: int = 0,
    variants: Compiled | None = None,
) -> Reply:
    """Put questions to a submission.

    Args:
        source: its text.
        questions: each with function, arguments, steps and parts.
        files: what it finds in its folder, by name: what the student was given.
        search: what small changes of it are searched for (`source_search.search`).
        compiled: what was made of it, where it is in C; and the number of its exercise.
        variants: the same with all its changes, where they are searched.

    Raises:
        NotGradedError: where it is not the submission's fault that there is no answer.
    """
    if sys.platform == "win32":
        raise NotGradedError("on Windows nothing can keep submissions in: grade them in a Linux container")
    limits = limits or Limits()
    task = {
        "source": source,
        "questions": list(questions),
        "hidden": [str(_packages())],
        "seconds": limits.seconds,
        "memory": limits.memory,
        "exposed": limits.exposed,
        "search": dict(search or {}),
        "parent": os.getpid(),
    }
    try:
        with _folder(files or {}) as folder, _file() as asked, _file() as said, _file() as printed, _file() as mark:
            for name, library in ((LIBRARY, compiled), (VARIANTS, variants)):
                if library is not None:
                    (folder / name).write_bytes(library.library)
                    (folder / name).chmod(0o644)
            if compiled is not None:
                task |= {"library": str(folder / LIBRARY), "lines": list(compiled.lines), "exercise": exercise}
                task |= {"variants": str(folder / VARIANTS)}
            task |= {"folder": str(folder), "readable": [*_readable(), str(folder)], "mark": mark.fileno()}
            asked.write(child.pack(task))
            asked.flush()
            with _for_reading(asked) as given:
                ending, reason = _Process(given, said, printed, mark, folder, limits).watch()
            said.seek(0)
            mark.seek(0)
            data, marked = said.read(LONGEST + 1), mark.read(LONGEST)
    except OSError as error:  # a full disk, no more processes: the machine's fault
        raise NotGradedError(f"the checker could not run it: {error.strerror or error}") from error
    if not marked.startswith((child.READY, child.CLOSED)):
        raise NotGradedError(f"its process never came so far as to read it: {reason or 'it ended early'}")
    if ending == "not graded":
        raise NotGradedError(reason)
    reply = Reply(ending, reason) if ending != "done" else read(marked, data, len(questions))
    if reply.error and reply.error["type"] == "LibraryNotLoadedError":
        raise NotGradedError(f"this machine cannot load what was compiled: {reply.error['words']}")
    return reply


@contextmanager
def _folder(files: Mapping[str, str]) -> Iterator[Path]:
    """A folder with these files, which everybody may read and only its owner may write."""
    folder = Path(tempfile.mkdtemp(prefix="springlab-submission-"))
    try:
        for name, text in files.items():
            (folder / name).write_text(text, encoding="utf-8")
            (folder / name).chmod(0o644)
        folder.chmod(0o755)
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _file() -> IO[bytes]:
    """A file without a name: in memory, where that can be, so that no full disk costs an answer."""
    if sys.platform == "linux":
        return open(os.memfd_create("springlab"), "w+b")
    return tempfile.TemporaryFile()


@contextmanager
def _for_reading(file: IO[bytes]) -> Iterator[IO[bytes]]:
    """The same, opened anew, for reading only."""
    if sys.platform == "linux":
        with open(f"/proc/self/fd/{file.fileno()}", "rb") as given:
            yield given
    else:
        file.seek(0)
        yield file


class _Process:
    """The process of a submission."""

    def __init__(
        self, asked: IO[bytes], said: IO[bytes], printed: IO[bytes], mark: IO[bytes], folder: Path, limits: Limits
    ) -> None:
        root = Path(child.__file__).parents[3]
        begin = (
            f"import sys; sys.path += {[str(root), str(_packages())]}; import runpy; runpy.run_path({child.__file__!r}"
        )
        command = [sys.executable, "-I", "-S", "-B", "-X", "utf8", "-c", f"{begin}, run_name='__main__')"]
        # nothing of the environment: it may hold secrets; and one thread, which is all that small arrays are worth
        bare = {"HOME": str(folder), "TMPDIR": str(folder), "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
        self._limits = limits
        self._process = subprocess.Popen(
            command,
            stdin=asked,
            stdout=said,
            stderr=printed,
            pass_fds=(mark.fileno(),),
            cwd=folder,
            env=bare,
            start_new_session=True,
        )

    def watch(self) -> tuple[str, str]:
        """How it ended: "done", "timed out", "crashed" or "not graded", and the reason."""
        waited, last, computed = 0.0, time.monotonic(), 0.0
        try:
            while True:
                with suppress(subprocess.TimeoutExpired):
                    return self._cause(self._process.wait(LOOK), computed)
                computed, queued = self._look()
                waited, last = waited + min(time.monotonic() - last, STALL), time.monotonic()
                if waited - queued > self._limits.wall_clock:
                    return "timed out", f"no answer within {self._limits.wall_clock:g} s"
        finally:
            with suppress(OSError):
                os.killpg(self._process.pid, signal.SIGKILL)  # and whatever it may have started
            self._process.kill()
            self._process.wait()

    def _look(self) -> tuple[float, float]:
        """How long it has computed and how long it has waited for a processor [s], where the system tells."""
        with suppress(OSError, ValueError):
            computed, queued, _ = map(int, Path(f"/proc/{self._process.pid}/schedstat").read_text().split())
            return computed / 1e9, queued / 1e9
        return 0.0, 0.0

    def _cause(self, code: int, computed: float) -> tuple[str, str]:
        if code == 0:
            return "done", ""
        at_its_limit = computed > 0.9 * self._limits.seconds
        if sys.platform != "win32" and (
            code == -signal.SIGXCPU or (code == -signal.SIGKILL and (at_its_limit or sys.platform != "linux"))
        ):
            return "timed out", f"it computed for more than {self._limits.seconds} s"
        if sys.platform != "win32" and code == -signal.SIGKILL:
            return "not graded", "its process was ended from outside: the machine may be short of memory"
        if code < 0:
            return "crashed", f"its process was ended by {signal.Signals(-code).name}"
        return "crashed", f"its process ended with exit code {code}"


@cache
def _packages() -> Path:
    return Path(np.__file__).parents[1]


@cache
def _readable() -> tuple[str, ...]:
    """What the process may read: Python's own library, NumPy, the system's libraries; not this project."""
    own = [
        entry
        for name in ("stdlib", "platstdlib")
        for entry in Path(sysconfig.get_paths()[name]).iterdir()
        if entry.name not in ("site-packages", "dist-packages")
    ]
    numpy = [_packages() / "numpy", _packages() / "numpy.libs"]
    system = [p for base in ("/lib", "/usr/lib") for p in Path(base).glob("*-linux-gnu*")]
    system += [Path(p) for p in ("/dev/urandom", "/dev/zero", "/dev/null", "/usr/share/zoneinfo")]
    return tuple(dict.fromkeys(str(p.resolve()) for p in [*own, *numpy, *system] if p.exists()))


def layers() -> list[str]:
    """Which layers of the sandbox this machine has, by trying: of `sandbox_layers.LAYERS`."""
    return list(run("", [], Limits(exposed=True)).layers)


def missing() -> list[str]:
    """Which layers this machine would have to have and has not."""
    return list(run("", [], Limits(exposed=True)).missing)
