"""What the sandbox makes of a process's end, and which folder it gives it; that it holds is in `test_hostile`."""

from __future__ import annotations

import shutil
import signal
import stat
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import IO, Any

import pytest

from experiments.exercises.c.compiler import Compiled
from experiments.exercises.process import child, sandbox
from experiments.exercises.process.reply import Reply
from experiments.exercises.process.sandbox import Limits
from experiments.exercises.process.sandbox_errors import NotGradedError

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="on Linux the kernel tells what a process has computed")

READY = child.READY + child.pack({"layers": ["limits"], "missing": ["seccomp"]})


class Process:
    """In place of a submission's: what it was given, what it leaves."""

    asked: Any = None
    files: tuple[str, ...] = ()
    ending = ("done", "")
    said: bytes = child.pack({"names": ["step"], "answers": []})
    mark: bytes = READY

    def __init__(
        self, asked: IO[bytes], said: IO[bytes], printed: IO[bytes], mark: IO[bytes], folder: Path, limits: Limits
    ) -> None:
        type(self).asked = child.unpack(asked.read())
        type(self).files = tuple(sorted(path.name for path in folder.iterdir()))
        for file, data in ((said, self.said), (mark, self.mark)):
            file.write(data)
            file.flush()

    def watch(self) -> tuple[str, str]:
        """How it ended."""
        return self.ending


@pytest.fixture
def process(monkeypatch: pytest.MonkeyPatch) -> type[Process]:
    """Submissions run nowhere."""

    class Own(Process):
        """Of this test."""

    monkeypatch.setattr(sandbox, "_Process", Own)
    return Own


def test_a_process_is_told_its_limits_and_finds_its_files(process: type[Process]) -> None:
    """What it leaves is read: what it said of its layers, and what it answered."""
    reply = sandbox.run("x = 1", [], Limits(3, 4.0, 5, exposed=True), {"A.csv": "1,2\n"}, {"seconds": 2.0})
    task = process.asked
    assert (task["source"], task["seconds"], task["memory"], task["exposed"]) == ("x = 1", 3, 5, True)
    assert (task["search"], process.files, task["folder"] in task["readable"]) == ({"seconds": 2.0}, ("A.csv",), True)
    assert "library" not in task
    assert (reply.ended, reply.names, reply.layers, reply.missing) == ("done", ["step"], ["limits"], ["seccomp"])


def test_without_limits_there_are_the_usual_ones_and_nothing_is_exposed(process: type[Process]) -> None:
    """Ten seconds, a gigabyte, and no search."""
    sandbox.run("", [])
    assert (process.asked["seconds"], process.asked["memory"]) == (10, 2**30)
    assert (process.asked["exposed"], process.asked["search"]) == (False, {})


def test_what_was_compiled_is_beside_it(process: type[Process]) -> None:
    """The submission, and where changes are searched the same with these; each by its own name."""
    own, changed = Compiled(b"own", ((3, 4),), ()), Compiled(b"changed", (), ())
    sandbox.run("", [], compiled=own, exercise=4)
    assert process.files == (sandbox.LIBRARY,)
    assert (process.asked["exercise"], process.asked["lines"]) == (4, [[3, 4]])
    assert process.asked["library"].endswith(sandbox.LIBRARY)
    sandbox.run("", [], compiled=own, exercise=4, variants=changed)
    assert process.files == tuple(sorted((sandbox.LIBRARY, sandbox.VARIANTS)))
    assert process.asked["variants"].endswith(sandbox.VARIANTS)


@pytest.mark.parametrize(
    ("mark", "ending", "words"),
    [
        (b"", ("crashed", "it had no memory"), "never came so far as to read it: it had no memory"),
        (b"", ("done", ""), "never came so far as to read it: it ended early"),
        (READY, ("not graded", "struck from outside"), "struck from outside"),
        (child.CLOSED + child.pack({"layers": [], "missing": ["seccomp"]}), ("done", ""), "has no seccomp to keep"),
    ],
)
def test_what_is_not_the_submissions_fault_is_not_graded(
    process: type[Process], mark: bytes, ending: tuple[str, str], words: str
) -> None:
    """Where the sandbox did not stand, or something else ended it."""
    process.mark, process.ending = mark, ending
    with pytest.raises(NotGradedError, match=words):
        sandbox.run("", [])


def test_a_library_that_this_machine_cannot_load_is_not_the_submissions_fault(process: type[Process]) -> None:
    """Another error is; and so is a bad end once it has been read."""
    for name in ("LibraryNotLoadedError", "ValueError"):
        process.said = child.pack({"error": {"type": name, "words": "no", "line": None}})
        if name == "ValueError":
            assert sandbox.run("", []).error == {"type": name, "words": "no", "line": None}
        else:
            with pytest.raises(NotGradedError, match="cannot load what was compiled: no"):
                sandbox.run("", [])
    process.ending = ("timed out", "too long")
    assert sandbox.run("", []) == Reply("timed out", "too long")


def test_a_full_disk_is_the_machines_fault(process: type[Process], monkeypatch: pytest.MonkeyPatch) -> None:
    """It is told by its words."""

    def full() -> IO[bytes]:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(sandbox, "_file", full)
    with pytest.raises(NotGradedError, match="could not run it: No space left on device"):
        sandbox.run("", [])


@pytest.mark.parametrize(
    ("code", "computed", "ending", "words"),
    [
        (0, 0.0, "done", ""),
        (-signal.SIGXCPU, 0.0, "timed out", "it computed for more than 10 s"),
        (-signal.SIGKILL, 9.5, "timed out", "it computed for more than 10 s"),
        (-signal.SIGKILL, 8.5, "not graded", "its process was ended from outside: the machine may be short of memory"),
        (-signal.SIGSEGV, 9.5, "crashed", "its process was ended by SIGSEGV"),
        (3, 9.5, "crashed", "its process ended with exit code 3"),
    ],
)
def test_the_cause_of_an_end_is_told(code: int, computed: float, ending: str, words: str) -> None:
    """A process that is killed near its limit was stopped by it; far from it, by somebody else."""
    process = object.__new__(sandbox._Process)
    process._limits = Limits()
    assert process._cause(code, computed) == (ending, words)


def test_a_process_is_begun_with_nothing_of_the_checkers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A session of its own, so that all it starts ends with it; its folder, no variable of the environment but four."""
    begun: dict[str, Any] = {}
    monkeypatch.setenv("SECRET", "sesame")
    monkeypatch.setattr(subprocess, "Popen", lambda command, **given: begun.update(given, command=command))
    with sandbox._file() as asked, sandbox._file() as said, sandbox._file() as printed, sandbox._file() as mark:
        sandbox._Process(asked, said, printed, mark, tmp_path, Limits())
        assert (begun["stdin"], begun["stdout"], begun["stderr"]) == (asked, said, printed)
        assert begun["pass_fds"] == (mark.fileno(),)
    assert (begun["start_new_session"], begun["cwd"]) == (True, tmp_path)
    one = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    assert begun["env"] == {"HOME": str(tmp_path), "TMPDIR": str(tmp_path), **one}
    assert {"-I", "-S", "-B"} < set(begun["command"])


def test_a_folder_can_be_read_by_all_written_by_none_and_goes_away() -> None:
    """Also where it has gone before."""
    with sandbox._folder({"A.csv": "1,2\n", "B.csv": ""}) as folder:
        modes = {path.name: stat.S_IMODE(path.stat().st_mode) for path in (folder, *folder.iterdir())}
        assert modes == {folder.name: 0o755, "A.csv": 0o644, "B.csv": 0o644}
        assert (folder / "A.csv").read_text(encoding="utf-8") == "1,2\n"
    assert not folder.exists()
    with sandbox._folder({}) as folder:
        shutil.rmtree(folder)


def test_layers_are_found_by_trying_also_where_some_are_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    """A program of nothing is run even where nothing keeps it in."""
    tried: list[Sequence[Any]] = []

    def run(*given: Any) -> Reply:
        tried.append(given)
        return Reply("done", layers=("limits",), missing=("seccomp",))

    monkeypatch.setattr(sandbox, "run", run)
    assert (sandbox.layers(), sandbox.missing()) == (["limits"], ["seccomp"])
    assert [(source, questions, limits.exposed) for source, questions, limits in tried] == [("", [], True)] * 2
