"""A submission run in a fresh process of its own, that can neither reach the checker nor its files.

The process gets the submission's text and the arrays of the questions, works in a folder that has the files which the
student was given and is removed afterwards, and leaves bytes, in which there is nothing but numbers and words (no
pickle). This process reads them and judges; it never imports a submission. The layers of the sandbox are those of
`sandbox_layers`.
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
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import IO, Any

import numpy as np

from experiments.exercises import child
from experiments.exercises.sandbox_layers import MEMORY, SECONDS

#: A process that sleeps, or waits, is ended after this time [s].
WALL_CLOCK = 20.0

#: Its folder may fill up to that [bytes].
FOLDER = 2**26

#: How often it is looked at [s]; and what a look counts for at most: a machine that stood still is not its fault.
LOOK, STALL = 0.02, 0.5

#: An answer is no longer than that [bytes].
LONGEST = 2**23


@dataclass(frozen=True)
class Limits:
    """What a submission may take: seconds of computing, wall-clock seconds, memory [bytes]."""

    seconds: int = SECONDS
    wall_clock: float = WALL_CLOCK
    memory: int = MEMORY


@dataclass(frozen=True)
class Reply:
    """What came back.

    Attributes:
        ended: how the process ended where it gave no answer: "timed out" or "crashed"; else "done".
        reason: of that, in a line.
        answers: one for each question, as `child.ask` makes them.
        error: what reading the submission raised: type, words, line.
        layers: of the sandbox, those that were active.
        names: what the submission defines.
    """

    ended: str
    reason: str = ""
    answers: Sequence[Mapping[str, Any]] = ()
    error: Mapping[str, Any] | None = None
    layers: Sequence[str] = ()
    names: Sequence[str] = field(default_factory=list)


def run(
    source: str,
    questions: Sequence[Mapping[str, Any]],
    limits: Limits | None = None,
    files: Mapping[str, str] | None = None,
) -> Reply:
    """Put questions to a submission.

    Args:
        source: its text.
        questions: each with function, arguments, steps and parts.
        files: what it finds in its folder, by name: what the student was given.
    """
    limits = limits or Limits()
    scratch = Path(tempfile.mkdtemp(prefix="springlab-submission-"))
    for name, text in (files or {}).items():
        (scratch / name).write_text(text, encoding="utf-8")
        (scratch / name).chmod(0o644)
    task = {
        "source": source,
        "questions": list(questions),
        "readable": list(_readable()),
        "hidden": [str(_packages())],
        "scratch": str(scratch),
        "seconds": limits.seconds,
        "memory": limits.memory,
    }
    try:
        # files without a name: nobody can open, replace or remove them
        with tempfile.TemporaryFile() as asked, tempfile.TemporaryFile() as said, tempfile.TemporaryFile() as printed:
            asked.write(child.pack(task))
            asked.seek(0)
            ending = _watch(_start(scratch, asked, said, printed), scratch, limits)
            return _reply(ending, said)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def _start(scratch: Path, asked: IO[bytes], said: IO[bytes], printed: IO[bytes]) -> subprocess.Popen[bytes]:
    begin = f"import sys; sys.path.append({str(_packages())!r}); import runpy; runpy.run_path({child.__file__!r}"
    command = [sys.executable, "-I", "-S", "-B", "-X", "utf8", "-c", f"{begin}, run_name='__main__')"]
    # nothing of the environment: it may hold secrets; and one thread, which is all that small arrays are worth
    bare = {"HOME": str(scratch), "TMPDIR": str(scratch), "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    if sys.platform == "win32":
        bare["SYSTEMROOT"] = os.environ["SYSTEMROOT"]
    return subprocess.Popen(
        command, stdin=asked, stdout=said, stderr=printed, cwd=scratch, env=bare, start_new_session=True
    )


def _watch(process: subprocess.Popen[bytes], scratch: Path, limits: Limits) -> tuple[str, str]:
    """How it ended: a word and a reason."""
    waited, last = 0.0, time.monotonic()
    ending = None
    try:
        while ending is None:
            with suppress(subprocess.TimeoutExpired):
                return _cause(process.wait(LOOK), limits)
            waited, last = waited + min(time.monotonic() - last, STALL), time.monotonic()
            if waited > limits.wall_clock:
                ending = ("timed out", f"no answer within {limits.wall_clock:g} s")
            elif _size(scratch) > FOLDER:
                ending = ("crashed", f"it wrote more than {FOLDER / 2**20:g} MiB of files")
    finally:
        with suppress(OSError):
            os.killpg(process.pid, signal.SIGKILL)  # and whatever it may have started
        process.kill()
        process.wait()
    return ending


def _cause(code: int, limits: Limits) -> tuple[str, str]:
    if code == 0:
        return "done", ""
    if sys.platform != "win32" and -code in (signal.SIGXCPU, signal.SIGKILL):
        return "timed out", f"it computed for more than {limits.seconds} s"
    if code < 0:
        return "crashed", f"its process was ended by {signal.Signals(-code).name}"
    return "crashed", f"its process ended with exit code {code}"


def _reply(ending: tuple[str, str], said: IO[bytes]) -> Reply:
    word, reason = ending
    if word != "done":
        return Reply(word, reason)
    said.seek(0)
    data = said.read(LONGEST)
    if not data:
        return Reply("crashed", "it ended its process before it had answered")
    try:
        reply = child.unpack(data)
        answers = [a for a in reply["answers"] if isinstance(a["values"], list)]
        return Reply("done", "", answers, reply.get("error"), list(reply["layers"]), list(reply.get("names", [])))
    except (ValueError, KeyError, TypeError, AttributeError):
        return Reply("crashed", "what it answered is not readable")


def _size(folder: Path) -> int:
    total = 0
    for place, _, files in os.walk(folder):
        for name in files:
            with suppress(OSError):
                total += os.lstat(os.path.join(place, name)).st_size
    return total


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
    system += [Path(p) for p in ("/dev/urandom", "/dev/zero", "/usr/share/zoneinfo")]
    return tuple(dict.fromkeys(str(p.resolve()) for p in [*own, *numpy, *system] if p.exists()))


def layers() -> list[str]:
    """Which layers of the sandbox this machine has, by trying: of limits, landlock, user, seccomp."""
    return list(run("", []).layers)
