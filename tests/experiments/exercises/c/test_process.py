"""The process of a compiler: what it restricts before it runs anything, and that it runs nothing where it cannot."""

from __future__ import annotations

import io
import json
import os
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from experiments.exercises.c import process


def ran(
    monkeypatch: pytest.MonkeyPatch,
    folder: Path,
    *programs: str,
    exposed: bool = False,
    root: bool = False,
    rules: int | None = 5,
    keeps: bool = True,
    nobody: bool = True,
) -> list[tuple[Any, ...]]:
    """What is done of programs in Python, with layers that are made up, which only note what they are asked for."""
    done: list[tuple[Any, ...]] = []

    def noting(name: str, answer: Any = None) -> Any:
        def note(*given: Any, **named: Any) -> Any:
            done.append((name, *("libc" if one is libc else one for one in given), *named.items()))
            return answer

        return note

    libc = SimpleNamespace(prctl=noting("prctl"))
    layers = SimpleNamespace(
        limit=noting("limit"),
        landlock_rules=noting("rules", rules),
        become_nobody=noting("nobody", nobody),
        drop_capabilities=noting("drop"),
        landlock=noting("landlock", keeps),
        NO_NEW_PRIVILEGES=38,
    )
    task = {
        "commands": [[sys.executable, "-c", program] for program in programs],
        "readable": ["/usr"],
        "writable": ["/tmp"],
        "exposed": exposed,
        "folder": str(folder),
    }
    monkeypatch.setattr(process.importlib, "import_module", lambda name: layers)
    monkeypatch.setattr(process.ctypes, "CDLL", lambda name: libc)
    monkeypatch.setattr(os, "geteuid", lambda: 0 if root else 1000)
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(sys, "path", list(sys.path))
    monkeypatch.setattr(sys, "stdin", io.StringIO(json.dumps(task)))
    process.main()
    return done


def test_all_layers_are_applied_before_anything_runs(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Programs may be run where they may be read; files are opened for the rules while that can be done."""
    done = ran(monkeypatch, tmp_path, root=True)
    assert done == [
        ("limit", process.SECONDS, process.MEMORY),
        ("rules", "libc", ["/usr"], ("programs", True), ("writable", ["/tmp"])),
        ("nobody",),
        ("drop", "libc"),
        ("prctl", 38, 1, 0, 0, 0),
        ("landlock", "libc", 5),
    ]
    assert ("nobody",) not in ran(monkeypatch, tmp_path)
    assert Path(sys.path[-1]) == Path(process.__file__).parents[3]


@pytest.mark.parametrize(
    "missing",
    [{"rules": None}, {"keeps": False}, {"root": True, "nobody": False}],
    ids=["no rules", "rules that do not hold", "still root"],
)
def test_without_a_layer_nothing_is_run(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, missing: dict[str, Any], capsys: pytest.CaptureFixture[str]
) -> None:
    """But where the teacher has said so."""
    program = "open('made', 'w').close()"
    with pytest.raises(SystemExit) as left:
        ran(monkeypatch, tmp_path, program, **missing)
    assert left.value.code == process.NO_SANDBOX
    assert list(tmp_path.iterdir()) == []
    ran(monkeypatch, tmp_path, program, exposed=True, **missing)
    assert [file.name for file in tmp_path.iterdir()] == ["made"]
    assert json.loads(capsys.readouterr().out) == [[0, "", ""]]


def test_commands_run_in_their_folder_up_to_the_first_that_fails(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """What they say is told, whatever its letters, and goes nowhere else."""
    first = "import os, sys; print(os.path.basename(os.getcwd())); sys.stderr.buffer.write(b'a\\xffb')"
    ran(monkeypatch, tmp_path, first, "print('no'); raise SystemExit(3)", "print('never')")
    out, err = capfd.readouterr()
    assert json.loads(out) == [[0, f"{tmp_path.name}\n", "a\ufffdb"], [3, "no\n", ""]]
    assert err == ""
