"""Notebooks of Otter and nbgrader, made by their own packages where these are installed, graded by `exercise book`.

Seen with otter-grader 7.0.0 and nbgrader 0.9.6, in an environment of their own; neither is needed by springlab.
"""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from experiments.exercises.grading import grade_class
from experiments.exercises.handed_in.collected import collect
from experiments.exercises.process import sandbox
from tests.experiments.exercises import here
from tests.experiments.exercises.corpus import solution

#: The model solution in the words of a teacher's notebook: its first line, and what stands in the function.
FIRST, BODY = "def step(y, v, dt, spring):", solution("loops", 1).split("def step(y, v, dt, spring):\n")[1]


@pytest.fixture(autouse=True)
def trusted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Programs run in this process."""
    monkeypatch.setattr(sandbox, "run", here.run)


def cell(kind: str, source: str, **metadata: Any) -> dict[str, Any]:
    """A cell of a notebook."""
    made: dict[str, Any] = {"cell_type": kind, "metadata": metadata, "source": source, "id": f"c{abs(hash(source))}"}
    return made | ({"outputs": [], "execution_count": None} if kind == "code" else {})


def written(file: Path, cells: Sequence[dict[str, Any]]) -> None:
    """A notebook of these cells."""
    file.parent.mkdir(parents=True, exist_ok=True)
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    notebook = {"nbformat": 4, "nbformat_minor": 5, "metadata": kernel, "cells": list(cells)}
    file.write_text(json.dumps(notebook), encoding="utf-8")


def of_nbgrader(folder: Path) -> Path:
    """What `nbgrader generate_assignment` makes of a teacher's notebook."""

    def own(source: str, name: str, **more: Any) -> dict[str, Any]:
        plain = {"schema_version": 3, "grade_id": name, "task": False, "grade": False, "solution": False}
        return cell("code", source, nbgrader={**plain, "locked": False, **more})

    begin, end = "    ### BEGIN SOLUTION\n", "\n    ### END SOLUTION"
    written(
        folder / "source" / "ps1" / "euler.ipynb",
        [
            own("EXERCISE = 1", "header", locked=True),
            own(f"{FIRST}\n{begin}{BODY}{end}", "step", solution=True),
            own("import pandas\nassert callable(step)", "test", grade=True, locked=True, points=1),
        ],
    )
    (folder / "nbgrader_config.py").write_text('get_config().CourseDirectory.course_id = "physics"\n', encoding="utf-8")
    subprocess.run([sys.executable, "-m", "nbgrader", "generate_assignment", "ps1"], cwd=folder, check=True)
    return folder / "release" / "ps1" / "euler.ipynb"


def of_otter(folder: Path) -> Path:
    """What `otter assign` makes of a teacher's notebook."""
    raw = ("# BEGIN SOLUTION", "# END SOLUTION", "# BEGIN TESTS", "callable(step)", "# END TESTS", "# END QUESTION")
    written(
        folder / "master.ipynb",
        [
            cell("raw", "# ASSIGNMENT CONFIG\nname: euler\nexport_cell: true\n"),
            cell("code", "EXERCISE = 1"),
            cell("raw", "# BEGIN QUESTION\nname: step\npoints: 1\n"),
            cell("markdown", "Euler's step"),
            cell("raw", raw[0]),
            cell("code", f"{FIRST}\n    # BEGIN SOLUTION\n{BODY}\n    # END SOLUTION"),
            cell("raw", raw[1]),
            cell("raw", raw[2]),
            cell("code", raw[3]),
            cell("raw", raw[4]),
            cell("raw", raw[5]),
        ],
    )
    subprocess.run(
        [sys.executable, "-m", "otter", "assign", "--no-run-tests", "master.ipynb", "dist"], cwd=folder, check=True
    )
    return folder / "dist" / "student" / "master.ipynb"


@pytest.mark.parametrize(("package", "make"), [("nbgrader", of_nbgrader), ("otter", of_otter)])
def test_what_students_get_from_the_packages_is_graded(package: str, make: Any, tmp_path: Path) -> None:
    """Handed in as it is it is not written yet; with the function written it is right, whatever tests stand around."""
    if importlib.util.find_spec(package) is None:
        pytest.skip(f"{package} is not installed")
    (tmp_path / "course").mkdir()
    notebook = json.loads(make(tmp_path / "course").read_text(encoding="utf-8"))
    (tmp_path / "in" / "bob").mkdir(parents=True)
    (tmp_path / "in" / "bob" / "euler.ipynb").write_text(json.dumps(notebook), encoding="utf-8")
    for own in notebook["cells"]:
        if FIRST in "".join(own["source"]):
            own["source"] = f"{FIRST}\n{BODY}"
    (tmp_path / "in" / "ada").mkdir()
    (tmp_path / "in" / "ada" / "euler.ipynb").write_text(json.dumps(notebook), encoding="utf-8")
    files = collect(tmp_path / "in", tmp_path / "unpacked")
    rows = grade_class([(f.path, f.name) for f in files], tmp_path / "grades.csv", workers=1)
    assert {row["file"].split("/")[0]: row["finding"] for row in rows} == {"ada": "right", "bob": "not_written_yet"}


def test_cells_of_graders_are_not_the_students() -> None:
    """Otter's cells that can neither be changed nor deleted, and nbgrader's that give points, are left out."""
    from experiments.exercises.handed_in.notebook import program_in

    locked = {"deletable": False, "editable": False}
    points = {"grade": True, "solution": False}
    cells = [
        cell("code", "import otter", **locked),
        cell("code", "assert step", nbgrader=points, **locked),
        cell("code", "EXERCISE = 1", nbgrader={"grade": False}, **locked),
        cell("code", "x = 2"),
        cell("code", "y = 3", deletable=False),
        cell("code", "z = 4", editable=False),
    ]
    lines = [line for line in program_in(json.dumps({"cells": cells})).splitlines() if line]
    assert lines == ["EXERCISE = 1", "x = 2", "y = 3", "z = 4"]
