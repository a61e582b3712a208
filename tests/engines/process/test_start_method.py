"""Processes begin with nothing of the program that asks for them, wherever that stands, and of the folder it is in."""

from __future__ import annotations

import os
import subprocess
import sys
from multiprocessing import forkserver
from pathlib import Path

import pytest

from engines.process.isolation import isolated
from engines.process.stopped import server_pid
from tests.engines.process import used

ROOT = Path(__file__).parents[3]

#: Without a guard, as people write it: it says so each time it is run.
PROGRAM = """
from engines.process.isolation import isolated
from tests.engines.process import misbehaving

def own():
    return "never"

print("begun")
print(isolated(misbehaving.fine).ending)
own_outcome = isolated(own)
print(own_outcome.ending, own_outcome.reason)
"""


def run(program: str, folder: Path, *words: str) -> list[str]:
    """What a program prints that is run in a folder, by its file or from standard input; nothing else is said."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, *words], input=program, capture_output=True, text=True, env=environment, cwd=folder
    )
    assert done.stderr == ""
    assert done.returncode == 0
    return done.stdout.splitlines()


@pytest.mark.rotating(2)
@pytest.mark.parametrize("by", ["file", "input"])
def test_a_program_without_a_guard_is_run_once(by: str, tmp_path: Path) -> None:
    """Its processes do not run it again; a function that stands in it is refused by name, and no engine is blamed."""
    file = tmp_path / "own_program.py"
    file.write_text(PROGRAM, encoding="utf-8")
    said = run(PROGRAM, tmp_path, *(["own_program.py"] if by == "file" else ["-"]))
    assert said[:2] == ["begun", "done"]
    assert said[2].startswith("unsupported own stands in the program itself")
    assert len(said) == 3


def test_the_server_imports_nothing_of_the_folder_it_is_called_in(tmp_path: Path) -> None:
    """A folder may have an `engines` and a `reference` of its own, as long as the program does not look there."""
    (tmp_path / "engines").mkdir()
    (tmp_path / "engines" / "__init__.py").write_text("raise SystemExit('of the folder')", encoding="utf-8")
    (tmp_path / "reference.py").write_text("print('of the folder')", encoding="utf-8")
    program = f"import sys; sys.path.remove(''); exec({PROGRAM!r})"
    assert run("", tmp_path, "-c", program)[:2] == ["begun", "done"]


def test_a_process_asks_the_server_that_forked_it_for_its_own() -> None:
    """Which has imported all that runs need; where that server is no more, one of its own is started."""
    if getattr(forkserver._forkserver, "_forkserver_authkey", None) is not None:
        pytest.skip("CPython 3.14 keeps a server's key from what it forks")
    theirs, ours = isolated(used.parents, False)
    assert theirs == ours == server_pid()
    theirs, ours = isolated(used.parents, True)
    assert ours == server_pid()
    assert theirs not in (ours, server_pid())
