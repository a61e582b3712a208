"""`import springlab` where people do it: plain scripts, standard input, folders with files named as ours."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest
import springlab

ROOT = Path(__file__).parents[3]

#: Without a guard; an engine runs in it.
PROGRAM = """
import springlab as lab
print("begun")
run = lab.compare("string", "mujoco_tendons", masses=3, duration=0.01)[0]
print(run.outcome, run.identified_as)
"""


def python(folder: Path, *words: str, program: str = "") -> subprocess.CompletedProcess[str]:
    """A Python called in a folder, which finds the lab as an installed one is found."""
    path = os.pathsep.join([str(ROOT), str(ROOT / "report" / "python")])
    environment = {**os.environ, "PYTHONPATH": path}
    words = (sys.executable, *words)
    return subprocess.run(words, input=program, capture_output=True, text=True, env=environment, cwd=folder)


@pytest.mark.rotating(4)
@pytest.mark.parametrize("words", [["own.py"], ["-"]], ids=["script", "standard input"])
def test_a_program_without_a_guard_runs_once_engines_included(words: list[str], tmp_path: Path) -> None:
    """What it prints is printed once, and nothing is complained of."""
    (tmp_path / "own.py").write_text(PROGRAM, encoding="utf-8")
    done = python(tmp_path, *words, program=PROGRAM)
    assert done.stdout.splitlines() == ["begun", "done kick_drift"]
    assert done.stderr == ""


@pytest.mark.rotating(2)
@pytest.mark.parametrize("own", ["report.py", "reference.py", "engines/__init__.py", "experiments/own.py"])
def test_a_file_that_hides_one_of_ours_is_named_with_a_way_out(own: str, tmp_path: Path) -> None:
    """In the last line; `python -P` is a way out, and a folder without an __init__.py hides nothing."""
    file = tmp_path / own
    file.parent.mkdir(exist_ok=True)
    file.write_text("raise SystemExit('of the user')", encoding="utf-8")
    (tmp_path / "script.py").write_text("import springlab\nprint(springlab.__version__)", encoding="utf-8")
    done = python(tmp_path, "script.py")
    if own == "experiments/own.py":
        assert done.stdout.strip() == springlab.__version__
        return
    last = done.stderr.splitlines()[-1]
    assert last.startswith("ImportError: springlab needs its own module")
    assert str(file) in last or str(file.parent) in last
    assert "python -P" in last
    assert python(tmp_path, "-P", "script.py").stdout.strip() == springlab.__version__


def test_it_has_a_version_and_types() -> None:
    """Those of the package; type checkers look for py.typed."""
    assert springlab.__version__ == metadata.version("springlab")
    assert (Path(springlab.__file__).parent / "py.typed").exists()


def test_importing_it_imports_nothing_that_takes_long(tmp_path: Path) -> None:
    """Neither engines nor plotting nor pandas nor Numba."""
    program = (
        "import sys, springlab; print(sorted({'mujoco', 'matplotlib', 'pandas', 'numba', 'scipy'} & {*sys.modules}))"
    )
    assert python(tmp_path, "-c", program).stdout.strip() == "[]"
