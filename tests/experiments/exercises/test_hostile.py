"""A class with submissions that are up to something: each is one row with a name, and nothing else is touched."""

from __future__ import annotations

import os
import re
import sys
import tempfile
from itertools import count
from pathlib import Path

import pytest

from experiments.exercises import child, sandbox
from experiments.exercises.exercise import find
from experiments.exercises.grading import grade_class
from experiments.exercises.judge import judge
from tests.experiments.exercises.hostile import HOSTILE, Hostile, text_of

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the sandbox's layers are those of Linux")

MODELS = Path(__file__).parent / "models"

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


def test_hostile_submissions_are_rows_with_a_name_and_touch_nothing(
    tmp_path: Path, layers: set[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Between right ones, which pass; all outside of their folders stays as it was, no process, no folder is left."""
    if {"landlock", "seccomp"} - layers:
        pytest.skip("this machine has no landlock or no seccomp")
    outside, folder, scratch = tmp_path / "outside", tmp_path / "class", tmp_path / "scratch"
    for new in (outside, folder, scratch):
        new.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(scratch))
    monkeypatch.setenv("SPRINGLAB_EXERCISE_KEY", "sesame")
    (outside / "kept.txt").write_text("kept")
    right = {f"right_{i}": Hostile(RIGHT.replace("{", "{{").replace("}", "}}"), "right", "right") for i in range(4)}
    chosen = {**HOSTILE, **right}
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
    """Shown to fail: with the whole machine readable, the model solution is read, and told to be right."""
    if "landlock" not in layers:
        pytest.skip("this machine has no landlock")
    thief = f"exec(open({str(MODELS / 'e01_euler.py')!r}).read())\n"
    assert judge(find("1"), thief).name == "reaches_out"
    monkeypatch.setattr(sandbox, "_readable", lambda: ("/",))
    assert judge(find("1"), thief).name == "right"


def test_a_machine_that_stands_still_costs_nobody_a_grade(monkeypatch: pytest.MonkeyPatch) -> None:
    """An hour passes between any two looks at a process, as when a machine sleeps: it has its time all the same.

    Shown to fail: where each of these hours counts, a right program is timed out.
    """
    clock = count(step=3600.0)
    monkeypatch.setattr(sandbox.time, "monotonic", lambda: next(clock))
    limits = sandbox.Limits(wall_clock=600.0)
    assert judge(find("1"), RIGHT, limits=limits).name == "right"
    monkeypatch.setattr(sandbox, "STALL", 3600.0)
    assert judge(find("1"), RIGHT, limits=limits).name == "timed_out"


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"short",
        b"\xff" * 64,
        b"\x02" + b"\0" * 7 + b"{}",
        b"\x04" + b"\0" * 7 + b"[[[[" + b"[" * 10000,
        child.pack({"answers": 1}) + b"rest",
        child.pack([1, 2, 3]),
        child.pack({"layers": [], "answers": [{"values": [[1]]}]}),
        re.sub(rb"3", b"9", child.pack({"x": __import__("numpy").arange(3.0)})),
    ],
)
def test_nonsense_in_place_of_an_answer_is_refused(data: bytes) -> None:
    """By one error that the caller knows, or as data that is no answer; nothing is run."""
    try:
        found = child.unpack(data)
    except ValueError:
        return
    assert isinstance(found, dict | list)
