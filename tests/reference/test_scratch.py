"""Temporary folders say whose they are; what the dead have left is removed by the next, and nothing else is."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from reference.scratch import OWNED, owner_prefix, scratch_folder, sweep
from tests.report.commands.terminal import ROOT

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="elsewhere nobody is known to be dead")

#: Makes a folder, and is killed.
KILLED = """
import os, signal, sys, tempfile
tempfile.tempdir = sys.argv[1]
from reference.scratch import scratch_folder
folder = scratch_folder()
(folder / "deep" / "er").mkdir(parents=True)
os.kill(os.getpid(), signal.SIGKILL)
"""


def left_by_the_dead(folder: Path) -> Path:
    """What a process that was killed has left in a folder."""
    before = set(folder.iterdir())
    subprocess.run([sys.executable, "-c", KILLED, str(folder)], cwd=ROOT, env={**os.environ, "PYTHONPATH": str(ROOT)})
    (left,) = set(folder.iterdir()) - before
    return left


def test_what_a_killed_process_left_is_removed_by_the_next(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Before it makes one of its own, which stays."""
    left = left_by_the_dead(tmp_path)
    assert (left / "deep" / "er").is_dir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    own = scratch_folder()
    assert [*tmp_path.iterdir()] == [own]
    assert sweep(tmp_path) == []
    assert own.is_dir()


def test_a_number_that_somebody_else_has_now_keeps_nothing(tmp_path: Path) -> None:
    """This process's own, with another time of its start: whoever that was is dead."""
    space, number, started = map(int, OWNED.match(owner_prefix()).groups())  # type: ignore[union-attr]
    earlier = tmp_path / f"springlab-{space}-{number}-{started - 1}-x"
    now = tmp_path / f"springlab-{space}-{number}-{started}-x"
    for folder in (earlier, now):
        folder.mkdir()
    assert sweep(tmp_path) == [earlier]
    assert [*tmp_path.iterdir()] == [now]


def test_what_is_not_known_to_be_left_is_let_be(tmp_path: Path) -> None:
    """Of another container's processes, of other names, files and links; what a link leads to, too."""
    dead = OWNED.match(left_by_the_dead(tmp_path).name)
    assert dead is not None
    space = int(dead[1])
    (tmp_path / "kept").mkdir()
    (tmp_path / f"springlab-{space + 1}-{dead[2]}-{dead[3]}-x").mkdir()
    (tmp_path / f"other-springlab-{space}-{dead[2]}-{dead[3]}-x").mkdir()
    (tmp_path / f"springlab-{space}-{dead[2]}-{dead[3]}-file").touch()
    (tmp_path / f"springlab-{space}-{dead[2]}-{dead[3]}-link").symlink_to(tmp_path / "kept")
    before = {path.name for path in tmp_path.iterdir()}
    assert {path.name for path in sweep(tmp_path)} == {
        next(n for n in before if n.startswith(dead[0]) and len(n) > len(dead[0]) + 4)
    }
    assert len([*tmp_path.iterdir()]) == 5


#: A process number beyond all that Linux gives.
NOBODY = 99_999_999


def test_what_somebody_else_has_just_removed_is_not_counted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It was listed, and is no longer there."""
    space = int(OWNED.match(owner_prefix())[1])  # type: ignore[index]
    gone, there = (f"springlab-{space}-{NOBODY}-{started}-x" for started in (1, 2))
    (tmp_path / there).mkdir()
    monkeypatch.setattr("reference.scratch.os.listdir", lambda _: [gone, there])
    assert sweep(tmp_path) == [tmp_path / there]


def test_where_nobody_is_known_to_be_dead_all_is_let_be(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As on systems without /proc."""
    space = int(OWNED.match(owner_prefix())[1])  # type: ignore[index]
    (tmp_path / f"springlab-{space}-{NOBODY}-1-x").mkdir()
    with monkeypatch.context() as patch:
        patch.setattr(Path, "exists", lambda _: False)
        assert sweep(tmp_path) == []
    assert len(sweep(tmp_path)) == 1
