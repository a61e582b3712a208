"""A class with submissions that are up to something: each is one row with a name, and nothing else is touched."""

from __future__ import annotations

import contextlib
import importlib
import os
import platform
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from itertools import count
from pathlib import Path
from time import sleep
from unittest import mock

import pytest

from experiments.exercises.exercise import find
from experiments.exercises.grading import grade_class
from experiments.exercises.process import sandbox
from experiments.exercises.process.library_finder import LibraryFinder
from experiments.exercises.process.sandbox_errors import NotGradedError
from experiments.exercises.teaching.gradescope import grade_folder
from experiments.exercises.verdict.judge import judge
from tests.experiments.exercises.process.hostile import HOSTILE, Hostile, text_of
from tests.experiments.exercises.process.hostile_calls import HOSTILE_CALLS
from tests.report.commands.terminal import springlab

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the sandbox's layers are those of Linux")

MODELS = Path(__file__).parents[1] / "models"

#: A right program.
RIGHT = (MODELS / "e01_euler.py").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def layers() -> set[str]:
    """Those layers of the sandbox that this machine has."""
    return set(sandbox.layers())


def everything(folder: Path) -> dict[str, tuple[bytes, int, int]]:
    """All files of a folder: contents, mode, time of change."""
    files = [p for p in folder.rglob("*") if p.is_file() and "__pycache__" not in p.parts]
    return {str(p): (p.read_bytes(), p.stat().st_mode, p.stat().st_mtime_ns) for p in files}


@pytest.mark.rotating(7)
@pytest.mark.parametrize("quarter", range(4))
def test_hostile_submissions_are_rows_with_a_name_and_touch_nothing(
    quarter: int, tmp_path: Path, layers: set[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Between right ones, which pass; all outside of their folders stays as it was, no process, no folder is left."""
    check({name: HOSTILE[name] for name in sorted(HOSTILE)[quarter::4]}, tmp_path, layers, monkeypatch)


def test_a_hundred_more(corpus_part: slice, tmp_path: Path, layers: set[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """A part of them, another every day; with --full all."""
    everyone = sorted(HOSTILE_CALLS)
    assert len(everyone) > 100
    check({name: HOSTILE_CALLS[name] for name in everyone[corpus_part]}, tmp_path, layers, monkeypatch)


def check(
    hostile_ones: Mapping[str, Hostile], tmp_path: Path, layers: set[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Grade them as a class with two right ones among them: each row has the expected name, and nothing is left."""
    if {"landlock", "seccomp"} - layers:
        pytest.skip("this machine has no landlock or no seccomp")
    outside, folder, scratch = tmp_path / "outside", tmp_path / "class", tmp_path / "scratch"
    for new in (outside, folder, scratch):
        new.mkdir()
    for place in (tmp_path, scratch):
        place.chmod(0o755)
    monkeypatch.setattr(tempfile, "tempdir", str(scratch))
    monkeypatch.setenv("SPRINGLAB_EXERCISE_KEY", "sesame")
    (outside / "kept.txt").write_text("kept")
    (outside / "kept.txt").chmod(0o666)  # that anybody may write it is no reason that a submission may
    right = {f"right_{i}": Hostile(RIGHT.replace("{", "{{").replace("}", "}}"), "right", "right") for i in range(2)}
    chosen = {**hostile_ones, **right}
    for name, hostile in chosen.items():
        (folder / f"{name}.py").write_text("EXERCISE = 1\n" + text_of(hostile, str(outside), str(MODELS)))
    before = everything(outside), everything(MODELS), everything(folder)
    rows = []
    for limits in {hostile.limits for hostile in chosen.values()}:
        files = [(folder / f"{name}.py", name) for name, hostile in chosen.items() if hostile.limits == limits]
        rows += grade_class(files, tmp_path / "grades.csv", limits=limits)
    assert (everything(outside), everything(MODELS), everything(folder)) == before
    assert list(scratch.iterdir()) == []
    named = {row["file"]: (row["outcome"], row["finding"]) for row in rows}
    assert named == {name: (hostile.outcome, hostile.finding) for name, hostile in chosen.items()}
    assert {row["file"]: row["score"] for row in rows} == {n: "100.0" if n in right else "0.0" for n in chosen}
    assert not [p for p in Path("/proc").glob("[0-9]*") if _works_in(p, "springlab-submission-")]


def _works_in(process: Path, folder: str) -> bool:
    try:
        return folder in os.readlink(process / "cwd") and f"PPid:\t{os.getpid()}\n" in (process / "status").read_text()
    except OSError:
        return False


def test_a_layer_less_is_noticed(monkeypatch: pytest.MonkeyPatch, layers: set[str]) -> None:
    """Shown to fail: with their folder readable the model solution is read; with all that is, nothing is graded."""
    if "landlock" not in layers:
        pytest.skip("this machine has no landlock")
    thief = f"exec(open({str(MODELS / 'e01_euler.py')!r}).read())\n"
    assert judge(find("1"), thief).name == "reaches_out"
    readable = sandbox._readable()
    with monkeypatch.context() as leak:
        leak.setattr(sandbox, "_readable", lambda: (*readable, str(MODELS)))
        assert judge(find("1"), thief).name == "right"
    monkeypatch.setattr(sandbox, "_readable", lambda: ("/",))
    with pytest.raises(NotGradedError, match="landlock"):  # which is tried out
        judge(find("1"), thief)


def test_a_machine_that_stands_still_costs_nobody_a_grade(monkeypatch: pytest.MonkeyPatch) -> None:
    """An hour passes between any two looks at a process, as when a machine sleeps: it has its time all the same.

    Shown to fail: where each of these hours counts, a right program has not even been read in its time, which is no
    fault of its own.
    """
    clock = count(step=3600.0)
    monkeypatch.setattr(sandbox.time, "monotonic", lambda: next(clock))
    limits = sandbox.Limits(wall_clock=600.0)
    assert judge(find("1"), RIGHT, limits=limits).name == "right"
    monkeypatch.setattr(sandbox, "STALL", 3600.0)
    with pytest.raises(NotGradedError, match="600 s"):
        judge(find("1"), RIGHT, limits=limits)


@pytest.mark.rotating(2)
@pytest.mark.parametrize("layer", ["landlock", "seccomp"])
def test_without_a_layer_nothing_is_graded(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, layer: str) -> None:
    """As on weaker kernels: by every route one line that says so, with the way out; and by that way it is graded."""
    weaker = tmp_path / "weaker"
    process = weaker / "experiments" / "exercises" / "process"
    shutil.copytree(Path(sandbox.child.__file__).parent, process, ignore=shutil.ignore_patterns("__pycache__"))
    script = process / "sandbox_layers.py"
    broken = {
        "landlock": ("libc.syscall(CREATE_RULESET, None", "-1 or (None"),
        "seccomp": ("calls is not None", "False"),
    }
    text, (here, there) = script.read_text(), broken[layer]
    assert here in text
    script.write_text(text.replace(here, there))
    monkeypatch.setattr(sandbox.child, "__file__", str(process / "child.py"))
    assert sandbox.missing() == [layer]
    with pytest.raises(NotGradedError, match=f"no {layer} .*--let-submissions-reach-my-files"):
        judge(find("1"), RIGHT)
    assert judge(find("1"), RIGHT, limits=sandbox.Limits(exposed=True)).right
    own = tmp_path / "euler.py"
    own.write_text("EXERCISE = 1\n" + RIGHT)
    (row,) = grade_class([(own, "euler.py")], tmp_path / "grades.csv")
    assert (row["outcome"], row["score"]) == ("not graded", "")
    document = grade_folder(tmp_path, {"exercise": "euler", "key": "k"})
    assert "score" not in document
    assert layer in document["output"]


def test_a_full_disk_costs_nobody_a_grade(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """No folder can be made: it is tried twice, the row has no score; the same command grades it once there is room."""
    own = tmp_path / "euler.py"
    own.write_text("EXERCISE = 1\n" + RIGHT)
    tried = []

    def full(**_: object) -> str:
        tried.append(1)
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as disk:
        disk.setattr(sandbox.tempfile, "mkdtemp", full)
        (row,) = grade_class([(own, "euler.py")], tmp_path / "grades.csv")
    assert (row["outcome"], row["score"], len(tried)) == ("not graded", "", 2)
    assert "No space left on device" in row["words"]
    (row,) = grade_class([(own, "euler.py")], tmp_path / "grades.csv")
    assert row["score"] == "100.0"


def test_a_process_that_is_ended_from_outside_is_not_graded(monkeypatch: pytest.MonkeyPatch) -> None:
    """As where the machine runs out of memory: it can be tried again."""
    if platform.machine() != "x86_64":
        pytest.skip("by the number of a call of x86-64")
    wait = sandbox.subprocess.Popen.wait

    def killed(process: subprocess.Popen[bytes], timeout: float | None = None) -> int:
        asleep = "230 "  # the call clock_nanosleep
        while timeout is not None and not Path(f"/proc/{process.pid}/syscall").read_text().startswith(asleep):
            sleep(0.01)
        if timeout is not None:
            os.kill(process.pid, signal.SIGKILL)
        return wait(process)

    monkeypatch.setattr(sandbox.subprocess.Popen, "wait", killed)
    with pytest.raises(NotGradedError, match="from outside"):
        judge(find("1"), "import time\ntime.sleep(1000)\n")


@pytest.mark.rotating(3, in_turn=True)
def test_nothing_is_written_through_a_link(tmp_path: Path) -> None:
    """The plot beside a submission takes the place of a link of its name; so does the table of grades."""
    precious = tmp_path / "precious.txt"
    precious.write_text("kept")
    for name in ("euler.check.png", "grades.csv.new"):
        (tmp_path / name).symlink_to(precious)
    own = tmp_path / "euler.py"
    own.write_text("EXERCISE = 1\ndef step(y, v, dt, spring):\n    return y + v * dt, v + dt\n")
    said = springlab("exercise", "check", str(own))
    assert said.code == 1
    assert (tmp_path / "euler.check.png").read_bytes().startswith(b"\x89PNG")
    grade_class([(own, "euler.py")], tmp_path / "grades.csv")
    assert precious.read_text() == "kept"


def test_a_key_on_the_command_line_is_refused(tmp_path: Path) -> None:
    """Everybody on the machine could read it; it is asked for in a file, or in the environment."""
    said = springlab("exercise", "check", str(tmp_path / "x.py"), "--key", "sesame")
    assert said.code == 2
    assert "--key-file FILE" in said.err
    assert "sesame" not in said.err
    said = springlab("exercise", "check", "x.py", "--key-file", "/dev/zero")
    assert (said.code, "at most 65536 bytes" in said.err) == (2, True)
    (tmp_path / "empty").write_text("\n")
    assert springlab("exercise", "check", "x.py", "--key-file", str(tmp_path / "empty")).code == 2
    assert "nowhere: No such file" in springlab("exercise", "check", "x.py", "--key-file", "nowhere").err


@pytest.mark.rotating(3, in_turn=True)
def test_a_submission_ends_with_its_checker(tmp_path: Path) -> None:
    """The checker is killed while a submission sleeps: the kernel ends the submission, which cannot undo that."""
    marker = "import time, ctypes\nctypes.CDLL(None).prctl(1, 0, 0, 0, 0)\ntime.sleep(1000)\n"
    script = f"""
import sys
sys.path.insert(0, {str(Path(__file__).parents[4])!r})
from experiments.exercises.process import sandbox
sandbox.run({marker!r}, [], sandbox.Limits(wall_clock=3600.0))
"""
    with subprocess.Popen([sys.executable, "-c", script]) as checker:
        while not (asleep := _children_asleep(checker.pid)):
            sleep(0.02)
        checker.kill()
        checker.wait()
    while any(Path(f"/proc/{pid}").exists() for pid in asleep):
        sleep(0.02)


def _children_asleep(parent: int) -> list[int]:
    """The processes that a process has started, and that sleep by the clock."""
    found = []
    for pid in Path(f"/proc/{parent}/task/{parent}/children").read_text().split():
        with contextlib.suppress(OSError):
            if Path(f"/proc/{pid}/syscall").read_text().startswith("230 "):
                found.append(int(pid))
    return found


def test_pythons_own_modules_are_found_through_an_open_folder(tmp_path: Path) -> None:
    """As where the way to them is closed to a submission's user: modules, packages and those within; nothing else."""
    library = tmp_path / "library"
    (library / "animals" / "birds").mkdir(parents=True)
    (library / "single.py").write_text("VALUE = 1\n")
    (library / "animals" / "__init__.py").write_text("")
    (library / "animals" / "birds" / "__init__.py").write_text("from animals.birds.owl import NAME\n")
    (library / "animals" / "birds" / "owl.py").write_text("NAME = 'owl'\n")
    handle = os.open(library, os.O_RDONLY)
    finder = LibraryFinder(handle, str(library))
    with mock.patch.object(sys, "meta_path", [*sys.meta_path, finder]), mock.patch.dict(sys.modules):
        assert importlib.import_module("single").VALUE == 1
        assert importlib.import_module("animals.birds").NAME == "owl"
        with pytest.raises(ModuleNotFoundError):
            importlib.import_module("animals.fish")
    os.close(handle)
