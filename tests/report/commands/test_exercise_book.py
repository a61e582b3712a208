"""`springlab exercise book`: what it asks for, what it prints and writes. Grades are made up: nothing is run."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import pytest

from experiments.exercises import grading
from experiments.exercises.exercise import find
from report.commands.exercise_book import _key_does_not_fit
from tests.report.commands.terminal import Said, springlab

#: Of each file its exercise, score, outcome and finding.
GRADES = {
    "ada.py": ("1", "100.0", "right", ""),
    "bob.py": ("1", "0.0", "mistake", "gravity_sign"),
    "eve.py": ("8", "50.0", "mistake", ""),
    "max.py": ("", "0.0", "error", "not_a_submission"),
}


@pytest.fixture
def asked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[tuple[Any, ...]]:
    """What was asked of the grader, and a folder `in` of four files that were handed in."""
    asked: list[tuple[Any, ...]] = []

    def grade_class(files: Any, table: Path, exercise: Any, key: Any, jobs: Any, tell: Any, *how: Any) -> Any:
        asked.append((table, exercise and exercise.name, key, jobs, how[0].exposed, how[1]))
        columns = dict.fromkeys(grading.COLUMNS, "")
        return [
            {
                **columns,
                **dict(zip(("file", "exercise", "score", "outcome", "finding"), (name, *GRADES[name]), strict=True)),
            }
            for _, name in sorted(files, key=lambda file: file[1])
        ]

    monkeypatch.setattr(grading, "grade_class", grade_class)
    monkeypatch.setenv("COLUMNS", "200")
    (tmp_path / "in").mkdir()
    for name in GRADES:
        (tmp_path / "in" / name).write_text(f"NAME = {name!r}\n", encoding="utf-8")
    return asked


def booked(folder: Path, *words: str) -> Said:
    """The command, for the folder `in`, with the book beside it."""
    return springlab("exercise", "book", str(folder / "in"), "--out", str(folder / "book.csv"), *words)


def read(file: Path) -> list[dict[str, str]]:
    """The rows of a table."""
    with file.open(encoding="utf-8-sig", newline="") as opened:
        return list(csv.DictReader(opened))


def test_each_student_is_a_row_in_the_terminal_and_in_the_book(asked: list[Any], tmp_path: Path) -> None:
    """Grades are kept beside the book; nothing else is written, and without a key nothing is said of one."""
    said = booked(tmp_path)
    assert (said.code, said.err) == (0, "")
    assert asked == [(tmp_path / "book.grades.csv", None, None, None, False, True)]
    heading, *rows = [line.split() for line in said.out.splitlines() if line.strip() and "─" not in line]
    shown = "student exercise mark outcome finding look_at days_late same_program_as same_seed_as"
    assert " ".join(heading) == shown
    assert rows[:2] == [["ada", "1", "100.0", "right"], ["bob", "1", "0.0", "mistake", "gravity_sign"]]
    assert rows[-1] == ["written:", str(tmp_path / "book.csv")]
    book = read(tmp_path / "book.csv")
    assert [(r["student"], r["exercise"], r["mark"]) for r in book] == [
        (Path(name).stem, exercise, score) for name, (exercise, score, *_) in GRADES.items()
    ]
    assert {file.name for file in tmp_path.iterdir()} == {"in", "book.csv"}


def test_options_reach_the_grader_and_the_book(asked: list[Any], tmp_path: Path) -> None:
    """Of which exercise, where grades are, how many at once; who is missing, who is late; what was put in by hand."""
    (tmp_path / "class.txt").write_text("ada\nzoe\n", encoding="utf-8")
    (tmp_path / "key").write_text("sesame", encoding="utf-8")
    words = ["--exercise", "8", "--grades", str(tmp_path / "g.csv"), "--jobs", "3", "--due", "2000-01-01"]
    words += ["--students", str(tmp_path / "class.txt"), "--key-file", str(tmp_path / "key"), "--started-without-key"]
    assert booked(tmp_path, *words, "--let-submissions-reach-my-files").code == 0
    assert asked == [(tmp_path / "g.csv", find("8").name, "sesame", 3, True, False)]
    book = {row["student"]: row for row in read(tmp_path / "book.csv")}
    assert [*book] == ["ada", "bob", "eve", "max", "zoe"]
    assert book["zoe"]["outcome"] == "missing"
    assert int(book["ada"]["days_late"]) > 9000

    text = (tmp_path / "book.csv").read_text(encoding="utf-8-sig")
    (tmp_path / "book.csv").write_text(text.replace("bob,1,0.0,,0.0", "bob,1,0.0,good,0.0"), encoding="utf-8")
    said = booked(tmp_path)
    assert {row["student"]: row["mark"] for row in read(tmp_path / "book.csv")}["bob"] == "good"
    file, odd = tmp_path / "book.csv", "by_hand of bob, exercise 1: 'good': expected a number from 0 to 100"
    assert said.err == f"springlab: {file}: {odd}; it counts as it is\n"


def test_a_platform_gets_a_table_of_each_exercise_and_students_their_findings(asked: list[Any], tmp_path: Path) -> None:
    """Each student of the exercise in it, and who handed in what is of none; two files of each who handed one in."""
    said = booked(tmp_path, "--platform", "moodle", "--feedback", str(tmp_path / "back"))
    tables = {number: tmp_path / f"book.moodle.{number}.csv" for number in ("1", "8")}
    assert said.out.splitlines()[-4:] == [
        f"written: {tmp_path / 'book.csv'}",
        *(f"written: {file}" for file in tables.values()),
        f"written: 8 files in {tmp_path / 'back'}",
    ]
    assert [row["Full name"] for row in read(tables["1"])] == ["ada", "bob", "max"]
    assert [row["Full name"] for row in read(tables["8"])] == ["eve", "max"]
    assert {folder.name for folder in (tmp_path / "back").iterdir()} == {"ada", "bob", "eve", "max"}
    booked(tmp_path, "--platform", "canvas")
    assert find("8").title in read(tmp_path / "book.canvas.8.csv")[0]


def test_a_key_that_may_not_be_the_classes_is_told(
    asked: list[Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In one line: of exercise 8, whose numbers hang on the key, nobody is right."""
    monkeypatch.setitem(GRADES, "bob.py", ("8", "0.0", "mistake", ""))
    monkeypatch.setenv("SPRINGLAB_EXERCISE_KEY", "sesame")
    told = "no file of exercise 8 is right; if it was handed out without a key: --started-without-key"
    assert booked(tmp_path).err == f"springlab: {told}\n"
    assert asked[-1][2] == "sesame"


@pytest.mark.parametrize(
    ("outcomes", "key", "without", "fits"),
    [
        ("mistake mistake", "k", False, False),
        ("mistake,not in the catalogue", "k", False, False),
        ("mistake right", "k", False, True),
        ("right mistake", "k", False, True),
        ("mistake", "k", False, True),  # of one file nothing follows
        ("mistake error", "k", False, True),  # one that does not run says nothing of a key
        ("mistake mistake", None, False, True),
        ("mistake mistake", "k", True, True),
    ],
)
def test_a_key_does_not_fit_where_of_several_nobody_is_right(
    outcomes: str, key: str | None, without: bool, fits: bool
) -> None:
    """Of exercises without keys nothing is asked."""
    several = outcomes.split("," if "," in outcomes else " ")
    rows = [{"exercise": "8", "outcome": outcome} for outcome in several]
    others = [{"exercise": "1", "outcome": "right"}]
    assert _key_does_not_fit([*rows, *others], key, without) is not fits
    assert not _key_does_not_fit([{**row, "exercise": "1"} for row in rows], key, without)
