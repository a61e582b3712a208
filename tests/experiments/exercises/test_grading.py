"""Teachers: a class with bad files, interrupted and gone on with; Gradescope; the commands."""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

from experiments.exercises import grading
from experiments.exercises.exercise import find
from experiments.exercises.gradescope import write_zip
from experiments.exercises.grading import COLUMNS, grade_class
from experiments.exercises.submission import files_of
from tests.experiments.exercises.corpus import solution, wrong
from tests.report.commands.terminal import springlab

MODELS = Path(__file__).parent / "models"


@pytest.fixture
def a_class(tmp_path: Path) -> Path:
    """Five submissions, three of which are none."""
    folder = tmp_path / "class"
    (folder / "anna").mkdir(parents=True)
    (folder / "anna" / "whole_state.py").write_text(solution("arrays"))
    (folder / "bert.py").write_text(wrong("loops", "heun_link_by_link"))
    (folder / "picture.py").write_bytes(b"\x89PNG\xff\xfe")
    (folder / "empty.py").write_text("")
    (folder / "=cmd.py").write_text("EXERCISE = 77\n")
    return folder


def test_a_bad_file_costs_one_row(a_class: Path, tmp_path: Path) -> None:
    """Each with its reason; names that spreadsheets take for formulas are quoted; and the table says so too."""
    table = tmp_path / "grades.csv"
    rows = {row["file"]: row for row in grade_class(files_of([a_class]), table)}
    assert {name: row["finding"] for name, row in rows.items()} == {
        "anna/whole_state.py": "right",
        "bert.py": "heun_link_by_link",
        "picture.py": "not_a_submission",
        "empty.py": "not_a_submission",
        "'=cmd.py": "not_a_submission",
    }
    assert "UTF-8" in rows["picture.py"]["words"]
    assert "exercise 77: expected a number from 1 to" in rows["'=cmd.py"]["words"]
    with table.open(newline="") as file:
        assert list(csv.DictReader(file)) == sorted(rows.values(), key=lambda row: row["file"])


def test_a_class_goes_on_where_it_was_interrupted(
    a_class: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is in the table is not done again, though its last line was cut off; a changed file is, and a new key."""
    table, files, done = tmp_path / "grades.csv", files_of([a_class]), []
    first = grade_class(files, table)
    lines = table.read_text().splitlines(keepends=True)
    table.write_text("".join(line for line in lines if not line.startswith("bert.py")) + "bert.py,4,,fai")
    judged = grading.grade
    monkeypatch.setattr(grading, "grade", lambda s, *rest: done.append(s.name) or judged(s, *rest))
    again = grade_class(files, table)
    assert done == ["bert.py"]
    assert [r | {"seconds": ""} for r in again] == [r | {"seconds": ""} for r in first]
    (a_class / "bert.py").write_text(solution("loops"))
    assert {r["file"]: r["finding"] for r in grade_class(files, table)}["bert.py"] == "right"
    assert done == ["bert.py", "bert.py"]
    grade_class(files, table, key="sesame")
    assert len(done) == 4


def test_the_command_checks_a_file_and_a_class(a_class: Path, tmp_path: Path) -> None:
    """In plain words, with the evidence and a plot; as JSON; exit code 1 where something is not right."""
    said = springlab("exercise", "check", str(a_class / "bert.py"))
    assert said.code == 1
    for words in (
        "heun_link_by_link",
        "Hint:",
        "Departs first: string of 5 masses, step 1, mass 1",
        "expected",
        "x yours",
    ):
        assert words in said.out
    assert (a_class / "bert.check.png").stat().st_size > 5000
    said = springlab("exercise", "check", str(a_class / "anna"))
    assert said.code == 0
    assert "Public check passed. The hidden one has not run." in said.out
    said = springlab("exercise", "check", str(a_class / "anna" / "whole_state.py"), "--key", "k", "--json")
    row = json.loads(said.out)
    assert (row["public"], row["hidden"], row["score"]) == ("passed", "passed", "100.0")
    said = springlab("exercise", "check", str(a_class), "--csv", str(tmp_path / "t.csv"))
    assert said.code == 1
    assert "heun_link_by_link" in said.out
    assert (tmp_path / "t.csv").read_text().startswith(",".join(COLUMNS))


def test_bad_input_is_one_line() -> None:
    """Exit code 2: a file that is not there, an exercise nobody has."""
    for words in (("check", "nowhere.py"), ("start", "12"), ("gradescope", "brigde"), ("check", str(MODELS / "no.py"))):
        said = springlab("exercise", *words)
        assert (said.code, said.err.count("\n")) == (2, 1)


def test_start_writes_what_students_get_and_no_solution(tmp_path: Path) -> None:
    """Text, page, starter; numbers of one's own; and nothing is overwritten."""
    said = springlab("exercise", "start", "8", str(tmp_path / "w"), "--seed", "ada", "--key", "sesame")
    assert said.code == 0
    names = {f.name for f in (tmp_path / "w").iterdir()}
    assert names == {"which_engine.py", "text.md", "text.html", "string.json", *(f"{letter}.csv" for letter in "ABCDE")}
    starter = (tmp_path / "w" / "which_engine.py").read_text()
    assert 'SEED = "ada"\nKEYED = True' in starter
    assert "sesame" not in "".join(f.read_text() for f in (tmp_path / "w").iterdir())
    assert springlab("exercise", "start", "8", str(tmp_path / "w")).code == 2
    page = (tmp_path / "w" / "text.html").read_text()
    assert "<h1>8 Which engine is it?</h1>" in page
    assert "@media print" in page
    assert "://" not in page


def check_results(document: dict[str, Any]) -> None:
    """Gradescope's documented format, as far as it is used here: names, types, and the words that are allowed."""
    kinds = {"score": (int, float), "execution_time": (int, float), "output": str, "output_format": str,
             "visibility": str, "stdout_visibility": str, "extra_data": dict, "tests": list}  # fmt: skip
    of_test = {"score": (int, float), "max_score": (int, float), "status": str, "name": str, "number": str,
               "output": str, "output_format": str, "visibility": str}  # fmt: skip
    seen = ("hidden", "after_due_date", "after_published", "visible")
    for part, known in [(document, kinds), *((test, of_test) for test in document["tests"])]:
        for name, value in part.items():
            assert isinstance(value, known[name]), name  # type: ignore[arg-type]
        assert part["visibility"] in seen
        assert part.get("output_format", "text") in ("text", "html", "simple_format", "md", "ansi")
    assert document["stdout_visibility"] in seen
    for test in document["tests"]:
        assert 0 <= test["score"] <= test["max_score"]
        assert test["status"] in ("passed", "failed")


@pytest.mark.parametrize(("submitted", "score"), [("right", 100.0), ("wrong", 0.0), ("none", 0.0), ("bad", 0.0)])
def test_the_zip_grades_as_gradescope_would(tmp_path: Path, submitted: str, score: float) -> None:
    """In a fresh folder: source, submission, results, run_autograder beside them, and nothing of this environment.

    Only setup.sh is not run: it asks the package index. What it installs is here already.
    """
    write_zip(find("4"), "sesame", tmp_path / "autograder.zip")
    with zipfile.ZipFile(tmp_path / "autograder.zip") as archive:
        names = archive.namelist()
        archive.extractall(tmp_path / "source")
        modes = {entry.filename: entry.external_attr >> 16 for entry in archive.infolist()}
    assert {"setup.sh", "run_autograder"} <= set(names)
    assert modes["setup.sh"] & modes["run_autograder"] & 0o111 == 0o111
    assert not [name for name in names if "model" in name or "tests/" in name]
    (tmp_path / "run_autograder").write_bytes((tmp_path / "source" / "run_autograder").read_bytes())
    (tmp_path / "submission").mkdir()
    texts = {"right": solution("classes"), "wrong": wrong("arrays", "spring_sign"), "bad": "def ("}
    if submitted in texts:
        (tmp_path / "submission" / "whole_state.py").write_text(texts[submitted])
    bare = {"PATH": os.environ["PATH"], "SPRINGLAB_PYTHON": sys.executable, "HOME": str(tmp_path)}
    subprocess.run(["bash", tmp_path / "run_autograder"], env=bare, check=True, cwd=tmp_path)
    document = json.loads((tmp_path / "results" / "results.json").read_text())
    check_results(document)
    assert document["score"] == score
    assert "sesame" not in json.dumps(document)
    if submitted == "wrong":
        assert "spring_sign" in document["tests"][0]["output"]


def test_setup_asks_for_nothing_but_package_indexes(tmp_path: Path) -> None:
    """Apt and pip, of names and versions; no address."""
    write_zip(find("1"), "k", tmp_path / "a.zip")
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        text = archive.read("setup.sh").decode()
    assert "://" not in text
    assert "numpy==" in text
    subprocess.run(["bash", "-n"], input=text, text=True, check=True)


def test_wrong_results_are_refused() -> None:
    """Shown to fail: a word that Gradescope does not know, a score beyond the most, a field it has not."""
    right = {"score": 1.0, "visibility": "visible", "stdout_visibility": "hidden", "tests": []}
    check_results(right)
    test = {"score": 2.0, "max_score": 1.0, "status": "passed", "visibility": "visible"}
    for wrongly in ({"visibility": "public"}, {"points": 3}, {"tests": [test]}, {"score": "all"}):
        with pytest.raises((AssertionError, KeyError)):
            check_results({**right, **wrongly})
