"""Teachers: a class with bad files, interrupted and gone on with; Gradescope; the commands."""

from __future__ import annotations

import csv
import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

from experiments.exercises import grading
from experiments.exercises.exercise import find
from experiments.exercises.grading import COLUMNS, grade_class
from experiments.exercises.handed_in.submission import files_of
from experiments.exercises.teaching import handout, plot
from experiments.exercises.teaching.gradescope import grade_folder, write_zip
from experiments.exercises.teaching.plot import in_terminal
from experiments.exercises.teaching.words import UNSEEN
from experiments.exercises.verdict.judge import judge
from reference.cache import cache_folder
from reference.errors import InputError
from tests.experiments.exercises.corpus import solution, wrong
from tests.report.commands.terminal import springlab

MODELS = Path(__file__).parent / "models"

#: A program with a mistake, which gives a plot.
WRONG = wrong("loops", "heun_link_by_link")


@pytest.fixture(scope="module")
def graded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a class of five submissions, of which three are not, in `class`; and its table, `grades.csv`."""
    top = tmp_path_factory.mktemp("graded")
    folder = top / "class"
    (folder / "anna").mkdir(parents=True)
    (folder / "anna" / "whole_state.py").write_text(solution("arrays"))
    (folder / "bert.py").write_text(WRONG)
    (folder / "picture.py").write_bytes(b"\x89PNG\xff\xfe")
    (folder / "empty.py").write_text("")
    (folder / "=cmd.py").write_text("EXERCISE = 77\n")
    grade_class(files_of([folder]), top / "grades.csv")
    return top


@pytest.fixture
def a_class(graded: Path, tmp_path: Path) -> Path:
    """A copy of that folder."""
    return Path(shutil.copytree(graded, tmp_path / "copy"))


def rows_of(table: Path) -> dict[str, dict[str, str]]:
    """A table of grades, by file."""
    with table.open(newline="", encoding="utf-8") as file:
        return {row["file"]: row for row in csv.DictReader(file)}


@pytest.mark.rotating(4, in_turn=True)
def test_a_bad_file_costs_one_row(graded: Path) -> None:
    """Each with its reason, that names the file or its line; names that spreadsheets take for formulas are quoted."""
    rows = rows_of(graded / "grades.csv")
    assert {name: (row["finding"], row["score"]) for name, row in rows.items()} == {
        "anna/whole_state.py": ("right", "100.0"),
        "bert.py": ("heun_link_by_link", "14.3"),  # with one mass it is right
        "picture.py": ("not_a_submission", "0.0"),
        "empty.py": ("not_a_submission", "0.0"),
        "'=cmd.py": ("not_a_submission", "0.0"),
    }
    assert list(rows) == sorted(rows)
    for name, told in (("picture.py", "picture.py"), ("empty.py", "empty.py"), ("'=cmd.py", "77")):
        assert told in rows[name]["words"]


@pytest.mark.rotating(4, in_turn=True)
def test_a_class_goes_on_where_it_was_interrupted(a_class: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is in the table is not done again, though its last line was cut off; a changed file is, and a new key."""
    table, files, done = a_class / "grades.csv", files_of([a_class / "class"]), []
    first = rows_of(table)
    lines = table.read_text().splitlines(keepends=True)
    table.write_text("".join(line for line in lines if not line.startswith("bert.py")) + "bert.py,4,,fai")
    judged = grading.grade
    monkeypatch.setattr(grading, "grade", lambda s, *rest: done.append(s.name) or judged(s, *rest))
    again = {row["file"]: row for row in grade_class(files, table)}
    assert done == ["bert.py"]
    assert rows_of(table) == again
    assert {n: r | {"seconds": ""} for n, r in again.items()} == {n: r | {"seconds": ""} for n, r in first.items()}
    (a_class / "class" / "bert.py").write_text(solution("loops"))
    assert {r["file"]: r["finding"] for r in grade_class(files, table)}["bert.py"] == "right"
    assert done == ["bert.py", "bert.py"]
    grade_class(files, table, key="sesame")
    assert len(done) == 4


@pytest.mark.rotating(4, in_turn=True)
def test_a_file_that_could_not_be_graded_is_tried_again(a_class: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A fault of the checker's own is in the row, not a grade of the student's; the next time it is gone."""
    table, files = a_class / "grades.csv", files_of([a_class / "class" / "bert.py"])
    (a_class / "class" / "bert.py").write_text(WRONG + "# changed\n")
    with monkeypatch.context() as broken:
        broken.setattr(grading, "grade", lambda *_: 1 / 0)
        (row,) = grade_class(files, table)
    assert (row["outcome"], row["finding"], row["score"]) == ("not graded", "not_graded", "")
    (row,) = grade_class(files, table)
    assert row["finding"] == "heun_link_by_link"
    assert rows_of(table)["bert.py"] == row


def test_every_file_has_a_row_of_its_own(tmp_path: Path) -> None:
    """However it is called: with an ending in capitals, with what cannot be printed, with a long name."""
    names = ("ADA.PY", "a b.py", "a\tb.py", "a\nb.py", f"{'x' * 230}1.py", f"{'x' * 230}2.py")
    for name in names:
        (tmp_path / name).write_text("EXERCISE = 77\n")
    rows = grade_class(files_of([tmp_path]), tmp_path / "grades.csv")
    assert {row["file"] for row in rows} == {name.replace("\t", "\\t").replace("\n", "\\n") for name in names}
    assert len(rows_of(tmp_path / "grades.csv")) == len(names)


@pytest.mark.rotating(3)
def test_a_wrong_program_where_no_picture_can_be_written_is_wrong(
    a_class: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The verdict is what it is, exit code 1; that there is no picture is said beside."""
    monkeypatch.setattr(plot, "write_anew", lambda *_: (_ for _ in ()).throw(OSError(30, "Read-only file system")))
    said = springlab("exercise", "check", str(a_class / "class" / "bert.py"))
    assert (said.code, "no picture, " in said.err) == (1, True)


def test_who_started_without_the_key_is_told_of_it(tmp_path: Path) -> None:
    """Where the answers do not fit and the file says nothing of a key: the teacher, not the student, may have erred."""
    (tmp_path / "key").write_text("sesame")
    own = tmp_path / "which_engine.py"
    own.write_text((MODELS / "e08_which_engine.py").read_text())
    said = springlab("exercise", "check", str(own), "--key-file", str(tmp_path / "key"), "--no-plot")
    assert "--started-without-key" in said.err
    again = ("exercise", "check", str(own), "--key-file", str(tmp_path / "key"), "--started-without-key", "--no-plot")
    assert springlab(*again).code == 0


def test_a_full_disk_leaves_no_half_of_a_handout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The student's own file comes last: as long as it is not there the same command begins again."""
    written, write = [], handout.write_anew

    def full(file: Path, content: bytes) -> None:
        if len(written) == 1:
            raise OSError(28, "No space left on device")
        written.append(file)
        write(file, content)

    with monkeypatch.context() as disk:
        disk.setattr(handout, "write_anew", full)
        assert springlab("exercise", "start", "4", str(tmp_path / "w")).code == 2
    assert not (tmp_path / "w" / "whole_state.py").exists()
    assert springlab("exercise", "start", "4", str(tmp_path / "w")).code == 0
    assert springlab("exercise", "start", "5", str(tmp_path / "v"), "--seed", "\udcff").code == 2


def test_another_table_is_not_written_over(tmp_path: Path) -> None:
    """One with other columns is refused by name, and stays as it was."""
    table = tmp_path / "budget.csv"
    table.write_text("month,cost\n1,2\n")
    with pytest.raises(InputError, match=r"budget\.csv"):
        grade_class([], table)
    assert table.read_text() == "month,cost\n1,2\n"


def test_no_cell_is_a_formula(tmp_path: Path) -> None:
    """Spreadsheets take what begins with any of four characters for one; a number stays a number."""
    for first in "=+-@":
        (tmp_path / f"{first}1.py").write_text("")
    rows = grade_class(files_of([tmp_path]), tmp_path / "grades.csv")
    assert {row["file"] for row in rows} == {f"'{first}1.py" for first in "=+-@"}
    assert {row["score"] for row in rows} == {"0.0"}


@pytest.mark.rotating(7, in_turn=True)
def test_the_command_checks_a_file(a_class: Path) -> None:
    """In words: the name, the hint, the first difference and the plot of the verdict; exit code 1."""
    verdict = judge(find("4"), WRONG)
    assert verdict.lines is not None
    said = springlab("exercise", "check", str(a_class / "class" / "bert.py"))
    assert said.code == 1
    for words in (verdict.name, verdict.findings[0].hint, str(verdict.first_difference), in_terminal(verdict.lines)):
        assert words in said.out
    assert (a_class / "class" / "bert.check.png").read_bytes().startswith(b"\x89PNG")
    said = springlab("exercise", "check", str(a_class / "class" / "anna"))
    assert said.code == 0
    assert UNSEEN in said.out
    (a_class / "key").write_text("k\n")
    key = str(a_class / "key")
    said = springlab(
        "exercise", "check", str(a_class / "class" / "anna" / "whole_state.py"), "--key-file", key, "--json"
    )
    row = json.loads(said.out)
    assert (row["public"], row["hidden"], row["score"]) == ("passed", "passed", "100.0")


def test_the_command_checks_a_class(a_class: Path) -> None:
    """It goes on from the table that is there; exit code 1, as not everybody is right."""
    table = a_class / "grades.csv"
    before = table.read_text()
    said = springlab("exercise", "check", str(a_class / "class"), "--csv", str(table))
    assert said.code == 1
    assert "heun_link_by_link" in said.out
    assert table.read_text() == before
    assert before.startswith(",".join(COLUMNS))


def test_bad_input_is_one_line() -> None:
    """Exit code 2: a file that is not there, an exercise nobody has."""
    for words in (("check", "nowhere.py"), ("start", "12"), ("gradescope", "brigde"), ("check", str(MODELS / "no.py"))):
        said = springlab("exercise", *words)
        assert (said.code, said.err.count("\n")) == (2, 1)


def test_start_writes_what_students_get_and_no_solution(tmp_path: Path) -> None:
    """Text, page, starter; numbers of one's own; and nothing is overwritten."""
    (tmp_path / "key").write_text("sesame")
    said = springlab(
        "exercise", "start", "8", str(tmp_path / "w"), "--seed", "ada", "--key-file", str(tmp_path / "key")
    )
    assert said.code == 0
    names = {f.name for f in (tmp_path / "w").iterdir()}
    assert names == {"which_engine.py", "text.md", "text.html", "string.json", *(f"{letter}.csv" for letter in "ABCDE")}
    starter = (tmp_path / "w" / "which_engine.py").read_text()
    assert 'SEED = "ada"\nKEYED = True' in starter
    assert "sesame" not in "".join(f.read_text() for f in (tmp_path / "w").iterdir())
    assert springlab("exercise", "start", "8", str(tmp_path / "w")).code == 2
    page = (tmp_path / "w" / "text.html").read_text()
    assert f"<h1>8 {find('8').title}</h1>" in page
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


@pytest.fixture(scope="module")
def autograder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The zip of exercise 4, unpacked."""
    top = tmp_path_factory.mktemp("autograder")
    write_zip(find("4"), "sesame", top / "autograder.zip")
    with zipfile.ZipFile(top / "autograder.zip") as archive:
        archive.extractall(top)
        for entry in archive.infolist():
            (top / entry.filename).chmod(entry.external_attr >> 16)
    return top


def test_the_zip_can_be_run_and_has_no_solution(autograder: Path) -> None:
    """The two scripts that Gradescope runs are executable; the model solutions and the tests are not there."""
    for script in ("setup.sh", "run_autograder"):
        assert os.access(autograder / script, os.X_OK)
    names = [path.relative_to(autograder).as_posix() for path in autograder.rglob("*.py")]
    assert "experiments/exercises/verdict/judge.py" in names
    assert not [name for name in names if "model" in name or "tests/" in name]


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.parametrize(
    ("text", "score", "finding"),
    [(solution("classes"), 100.0, "right"), (wrong("arrays", "spring_sign"), 0.0, "spring_sign")],
    ids=["right", "wrong"],
)
def test_the_zip_grades_as_gradescope_would(
    autograder: Path, tmp_path: Path, text: str, score: float, finding: str
) -> None:
    """In a fresh folder: source, submission, results, run_autograder beside them, and nothing of this environment.

    Only setup.sh is not run: it asks the package index. What it installs is here already; and so are the compiled
    kernels, each under the digest of all it is made from.
    """
    shutil.copytree(autograder, tmp_path / "source", ignore=shutil.ignore_patterns("*.zip"))
    shutil.copy(autograder / "run_autograder", tmp_path)
    (tmp_path / "submission").mkdir()
    (tmp_path / "submission" / "whole_state.py").write_text(text)
    patient(tmp_path / "source" / "experiments" / "exercises" / "process" / "sandbox.py")
    bare = {"PATH": os.environ["PATH"], "SPRINGLAB_PYTHON": sys.executable, "HOME": str(tmp_path)}
    bare["XDG_CACHE_HOME"] = str(cache_folder("kernels").parents[1])
    subprocess.run(["bash", tmp_path / "run_autograder"], env=bare, check=True, cwd=tmp_path)
    document = json.loads((tmp_path / "results" / "results.json").read_text())
    check_results(document)
    assert (document["score"], document["extra_data"]["finding"]) == (score, finding)
    assert set(document["extra_data"]["walls"]) >= {"limits"}
    assert [test["visibility"] for test in document["tests"]] == ["visible", "after_published"]
    # what is seen at once says nothing of the hidden check, which has run
    assert ("The hidden one is told later." in document["tests"][0]["output"]) == (score == 100.0)
    assert UNSEEN not in document["tests"][0]["output"]
    assert "sesame" not in json.dumps(document)


def patient(sandbox: Path) -> None:
    """Let a submission have an hour: this machine may be busy."""
    text, seconds = sandbox.read_text(encoding="utf-8"), "WALL_CLOCK = 20.0"
    assert seconds in text
    sandbox.write_text(text.replace(seconds, "WALL_CLOCK = 3600.0"), encoding="utf-8")


@pytest.mark.parametrize("files", [{}, {"a.py": "", "b.py": ""}, {"whole_state.py": "def ("}])
def test_what_cannot_be_graded_has_no_points(tmp_path: Path, files: dict[str, str]) -> None:
    """Nothing at all, two files of which neither has the name of the exercise, and one that Python cannot read."""
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    document = grade_folder(tmp_path, {"exercise": "whole_state", "key": "sesame"})
    check_results(document)
    assert document["score"] == 0.0
    assert {test["status"] for test in document["tests"]} == {"failed"}


def test_setup_asks_for_nothing_but_package_indexes(autograder: Path) -> None:
    """Apt and pip, of names and versions; no address."""
    text = (autograder / "setup.sh").read_text()
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
