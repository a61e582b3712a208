"""A class's book: whose a file is, what counts, who is missing, late, equal; tables read back; what platforms take."""

from __future__ import annotations

import csv
import doctest
import json
import os
import shutil
import zipfile
from dataclasses import replace
from datetime import datetime
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

from experiments.exercises import grading
from experiments.exercises.grading import Grade, grade_class
from experiments.exercises.handed_in import collected, notebook
from experiments.exercises.handed_in.collected import collect, files_in
from experiments.exercises.handed_in.submission import Submission, read
from experiments.exercises.teaching import class_book
from experiments.exercises.teaching.class_book import COLUMNS, book, students_in, write_book
from experiments.exercises.teaching.feedback import write_feedback
from experiments.exercises.teaching.platforms import PLATFORMS, table
from experiments.exercises.teaching.table_file import read_table
from reference.errors import InputError
from reference.files.csv_cell import cell
from tests.experiments.exercises.corpus import solution, wrong
from tests.report.commands.terminal import springlab

RIGHT, WRONG = solution("loops", 1), wrong("loops", "gravity_sign", 1)


@pytest.fixture(autouse=True)
def graded_once(trusted: None, monkeypatch: pytest.MonkeyPatch, known: dict[str, Grade]) -> None:
    """Programs run in this process, each once: what is asked here is what the book makes of their grades."""
    grade = grading.grade

    def once(submission: Submission, *others: Any) -> Grade:
        asked = repr((replace(submission, name=""), others))
        if asked not in known:
            known[asked] = grade(submission, *others)
        return known[asked]

    monkeypatch.setattr(grading, "grade", once)


@pytest.fixture(scope="module")
def known() -> dict[str, Grade]:
    """Grades, by all that they were given for."""
    return {}


def as_notebook(text: str) -> str:
    """A program as a notebook: one cell for each paragraph, one magic."""
    cells: list[dict[str, Any]] = [{"cell_type": "markdown", "source": ["# Exercise"]}]
    parts = ["%matplotlib inline", *text.split("\n\n\n")]
    cells += [{"cell_type": "code", "source": part.splitlines(keepends=True)} for part in parts]
    return json.dumps({"nbformat": 4, "cells": cells})


@pytest.fixture
def a_class(tmp_path: Path) -> Path:
    """A class as platforms export it: two of Moodle's folders, a notebook, a zip of a student's, a file of Canvas'."""
    folder = tmp_path / "class"
    for name, text in (
        ("Ada Lovelace_1_assignsubmission_file_/euler.py", WRONG),
        ("Ada Lovelace_1_assignsubmission_file_/euler_new.py", RIGHT),
        ("Bob Noyce_2_assignsubmission_file_/euler.ipynb", as_notebook(RIGHT)),
        ("hopper_3_4_euler.py", "# mine\n" + WRONG),
        ("empty/report.pdf", "%PDF"),
        ("students.csv", "name"),
    ):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    old, new = datetime(2026, 11, 1).timestamp(), datetime(2026, 11, 4, 12).timestamp()
    os.utime(folder / "Ada Lovelace_1_assignsubmission_file_/euler.py", (old, old))
    os.utime(folder / "Ada Lovelace_1_assignsubmission_file_/euler_new.py", (new, new))
    with zipfile.ZipFile(folder / "eve.zip", "w") as archive:
        archive.writestr(zipfile.ZipInfo("mine/euler.py", (2026, 11, 2, 0, 0, 0)), WRONG)
        archive.writestr("../../out.py", WRONG)
    return folder


def booked(folder: Path, tmp_path: Path, **options: Any) -> dict[str, dict[str, str]]:
    """The book of a folder, by student."""
    files = collect(folder, tmp_path / "unpacked")
    rows = grade_class([(f.path, f.name) for f in files], tmp_path / "grades.csv", workers=1)
    return {row["student"]: row for row in book(rows, files, **options)}


def test_each_student_has_one_row_and_the_newest_file_counts(a_class: Path, tmp_path: Path) -> None:
    """Whoever is missing has one too; days late, and equal programs, are told; nothing is unpacked elsewhere."""
    students = {"Ada Lovelace": "", "Bob Noyce": "", "Max": ""}
    found = booked(a_class, tmp_path, students=students, due=datetime(2026, 11, 3))
    assert {name: (row["outcome"], row["mark"]) for name, row in found.items()} == {
        "Ada Lovelace": ("right", "100.0"),
        "Bob Noyce": ("right", "100.0"),
        "hopper": ("mistake", "0.0"),
        "eve": ("mistake", "0.0"),
        "Max": ("missing", "0.0"),
        "empty": ("error", "0.0"),
    }
    assert "report.pdf is no program: expected a Python or C file" in found["empty"]["words"]
    ada, eve = found["Ada Lovelace"], found["eve"]
    assert (ada["days_late"], ada["earlier_files"], eve["days_late"]) == ("2", "1", "0")
    assert (eve["same_program_as"], found["hopper"]["same_program_as"]) == ("hopper", "eve")
    assert ada["same_program_as"] == "Bob Noyce"
    assert not list(tmp_path.rglob("out.py"))


def test_a_mark_by_hand_stays_in_a_table_that_a_spreadsheet_has_saved(a_class: Path, tmp_path: Path) -> None:
    """With a byte order mark and semicolons; what was computed is computed again."""
    file = tmp_path / "book.csv"
    rows = list(booked(a_class, tmp_path).values())
    write_book([{**row, "by_hand": "50" if row["student"] == "eve" else ""} for row in rows], file)
    text = StringIO(newline="")
    writer = csv.DictWriter(text, [*COLUMNS, "remark"], delimiter=";")
    writer.writeheader()
    writer.writerows({**row, "remark": "ok"} for row in read_table(file))
    file.write_text(text.getvalue(), encoding="utf-8-sig")
    again = booked(a_class, tmp_path, before=read_table(file))
    assert (again["eve"]["mark"], again["eve"]["score"], again["hopper"]["mark"]) == ("50", "0.0", "0.0")


def test_a_table_of_grades_may_have_been_through_a_spreadsheet(a_class: Path, tmp_path: Path) -> None:
    """It goes on from there, and a column that somebody has added stays."""
    file, grades = a_class / "hopper_3_4_euler.py", tmp_path / "g.csv"
    (first,) = grade_class([(file, file.name)], grades, workers=1)
    rows = [{**row, "remark": "talk to her"} for row in read_table(grades)]
    text = StringIO(newline="")
    writer = csv.DictWriter(text, list(rows[0]), delimiter=";")
    writer.writeheader()
    writer.writerows(rows)
    grades.write_text(text.getvalue(), encoding="utf-8-sig")
    (again,) = grade_class([(file, file.name)], grades, workers=1)
    assert again == {**first, "remark": "talk to her"}
    assert read_table(grades) == [again]


def test_a_mark_by_hand_stays_whatever_the_name_begins_with(tmp_path: Path) -> None:
    """Names that a spreadsheet would take for formulas: they are guarded in the table, and found again."""
    (tmp_path / "handed").mkdir()
    for name in ("=ada", "@bob", "-cyd"):
        (tmp_path / "handed" / f"{name}.py").write_text(RIGHT, encoding="utf-8")
    files = collect(tmp_path / "handed", tmp_path)
    graded = [{"file": str(cell(f.name)), "exercise": "1", "score": "100.0", "outcome": "right"} for f in files]
    rows = book(graded, files)
    write_book([{**row, "by_hand": "50"} for row in rows], tmp_path / "book.csv")
    again = book(graded, files, before=read_table(tmp_path / "book.csv"))
    assert {row["student"]: row["mark"] for row in again} == {"=ada": "50", "@bob": "50", "-cyd": "50"}


def test_zips_and_notebooks_are_checked_too(a_class: Path, tmp_path: Path) -> None:
    """A folder, a zip in it, a zip by itself: what `springlab exercise check` grades."""
    (tmp_path / "own.ipynb").write_text("{}", encoding="utf-8")
    assert {name for _, name in files_in([tmp_path / "own.ipynb"], tmp_path)} == {"own.ipynb"}
    alone = {name for _, name in files_in([a_class / "eve.zip"], tmp_path / "one")}
    inside = {name for _, name in files_in([a_class], tmp_path / "two")}
    assert alone
    assert {f"eve/{name}" for name in alone} <= inside


def test_who_has_handed_in_no_program_is_checked_too(tmp_path: Path) -> None:
    """A report in place of a program has a row; beside one, and the picture that a check has drawn, have none."""
    for name in ("ada/own.py", "ada/report.pdf", "ada/own.check.png", "bob/report.pdf", "eve.py", "eve.check.png"):
        (tmp_path / "class" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "class" / name).write_text(RIGHT)
    found = files_in([tmp_path / "class"], tmp_path / "unpacked")
    assert {name for _, name in found} == {str(Path("ada/own.py")), "bob/report.pdf", "eve.py"}
    rows = grade_class([(p, name) for p, name in found if name == "bob/report.pdf"], tmp_path / "grades.csv")
    assert [(row["outcome"], row["finding"]) for row in rows] == [("error", "not_a_submission")]


def test_a_table_makes_no_folders(tmp_path: Path) -> None:
    """A slip in its path is refused before anything is graded, of the book too."""
    (tmp_path / "own.py").write_text(RIGHT)
    gone = tmp_path / "gone"
    for words in (("check", "--csv", str(gone / "g.csv")), ("book", "--out", str(gone / "b.csv"), "--grades", "g.csv")):
        said = springlab("exercise", *words, str(tmp_path))
        assert (said.code, len(said.err.splitlines())) == (2, 1)
        assert f"there is no folder {gone}: expected one that is there" in said.err
    assert not gone.exists()


@pytest.mark.rotating(3)
def test_seeds_are_tied_to_students(tmp_path: Path) -> None:
    """One who has another's, by the class list or beside another, is told to the teacher."""
    text = solution("loops", 5)
    for name, seed in (("ada", "a1"), ("bob", "a1"), ("eve", "m1")):
        (tmp_path / "c" / name).mkdir(parents=True)
        (tmp_path / "c" / name / "own.py").write_text(text.replace('SEED = "example"', f'SEED = "{seed}"'))
    (tmp_path / "students.csv").write_text("student;seed\nada;a1\nbob;b1\neve;e1\nmax;m1\n")
    students = students_in(tmp_path / "students.csv")
    assert students == {"ada": "a1", "bob": "b1", "eve": "e1", "max": "m1"}
    found = booked(tmp_path / "c", tmp_path, students=students)
    assert {name: row["same_seed_as"] for name, row in found.items()} == {
        "ada": "bob",
        "bob": "ada",
        "eve": "max",
        "max": "",
    }
    (tmp_path / "students.txt").write_text("ada\nbob\n\n")
    assert list(students_in(tmp_path / "students.txt")) == ["ada", "bob"]


def test_a_notebook_is_the_program_in_it(tmp_path: Path) -> None:
    """Its code cells; what is no notebook is refused by name."""
    file = tmp_path / "own.ipynb"
    file.write_text(as_notebook(RIGHT))
    assert read(file, "own.ipynb").exercise.number == 1
    for text in ("{}", "[]", "no", '{"cells": [1]}'):
        file.write_text(text)
        with pytest.raises(InputError, match=r"own\.ipynb"):
            read(file, "own.ipynb")


@pytest.mark.parametrize("platform", list(PLATFORMS))
def test_platforms_get_their_columns(platform: str, a_class: Path, tmp_path: Path) -> None:
    """Who has which mark is in each; no column holds the change that would mend a program."""
    rows = list(booked(a_class, tmp_path).values())
    read_back = list(csv.DictReader(StringIO(table(rows, platform, "Euler"), newline="")))
    name = {"moodle": "Full name", "canvas": "Student", "brightspace": "Username"}[platform]
    mark = {"moodle": "Grade", "canvas": "Euler", "brightspace": "Euler Points Grade"}[platform]
    assert {row[name]: row[mark] for row in read_back} == {row["student"]: row["mark"] for row in rows}


def test_students_get_their_findings_back_and_not_the_change(a_class: Path, tmp_path: Path) -> None:
    """A text and a page each; names that are paths stay in the folder."""
    rows = list(booked(a_class, tmp_path).values())
    rows = [{**row, "change": "THE CHANGE", "student": "../" + row["student"]} for row in rows]
    files = write_feedback(rows, tmp_path / "back")
    assert len(files) == 2 * len(rows)
    assert {file.parent.parent for file in files} == {tmp_path / "back"}
    told = {file.parent.name: file.read_text(encoding="utf-8") for file in files if file.suffix == ".txt"}
    assert not [text for text in told.values() if "THE CHANGE" in text]
    eve = next(row for row in rows if row["student"].endswith("eve"))
    assert any(eve["words"] in text for text in told.values())


def test_a_students_zip_that_cannot_be_read_is_a_row_of_the_student(a_class: Path, tmp_path: Path) -> None:
    """Damaged inside, with programs outside of it only, dated on no day: nobody else goes without a mark."""
    with zipfile.ZipFile(a_class / "damaged.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("euler.py", RIGHT)
    whole = bytearray((a_class / "damaged.zip").read_bytes())
    whole[40:50] = b"\xff" * 10
    (a_class / "damaged.zip").write_bytes(whole)
    with zipfile.ZipFile(a_class / "outside.zip", "w") as archive:
        archive.writestr("../euler.py", RIGHT)
    with zipfile.ZipFile(a_class / "undated.zip", "w") as archive:
        archive.writestr(zipfile.ZipInfo("euler.py", (1980, 0, 0, 0, 0, 0)), RIGHT)
    book = booked(a_class, tmp_path)
    for student in ("damaged", "outside", "undated"):
        assert book[student]["finding"] == "not_a_submission"
    assert book["Bob Noyce"]["outcome"] == "right"


def test_a_zip_in_a_zip_is_read(tmp_path: Path) -> None:
    """The class as one zip, in it a student's own: as in the folder. Read one level deep; what cannot be is a row."""
    moodle, files = "_assignsubmission_file_", tmp_path / "class"
    for number, student in enumerate(("Zoe Zip", "Bad Zip", "Deep Zip", "Ada")):
        (files / f"{student}_{number}{moodle}").mkdir(parents=True)
    (files / f"Ada_3{moodle}" / "own.py").write_text(RIGHT)
    (files / f"Bad Zip_1{moodle}" / "all.zip").write_bytes(b"no zip")
    with zipfile.ZipFile(files / f"Zoe Zip_0{moodle}" / "all.zip", "w") as archive:
        archive.writestr("mine/euler.py", RIGHT)
    with zipfile.ZipFile(files / f"Deep Zip_2{moodle}" / "all.zip", "w") as archive:
        archive.write(files / f"Zoe Zip_0{moodle}" / "all.zip", "inner.zip")
    shutil.make_archive(str(tmp_path / "export"), "zip", files)
    found = {f.name: (f.student, f.path.suffix) for f in collect(tmp_path / "export.zip", tmp_path / "zip")}
    assert found == {
        f"Ada_3{moodle}/own.py": ("Ada", ".py"),
        f"Bad Zip_1{moodle}/all.zip": ("Bad Zip", ".zip"),
        f"Deep Zip_2{moodle}/all.zip": ("Deep Zip", ".zip"),
        f"Zoe Zip_0{moodle}/all/mine/euler.py": ("Zoe Zip", ".py"),
    }
    assert sorted(f.student for f in collect(files, tmp_path / "folder")) == ["Ada", "Bad Zip", "Deep Zip", "Zoe Zip"]


def test_a_zip_of_too_much_is_not_unpacked(a_class: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither of too many files nor of too many bytes; of a class in one zip that is an error."""
    for name, limit in (("MOST_FILES", 1), ("MOST_BYTES", 10)):
        with monkeypatch.context() as patched:
            patched.setattr(collected, name, limit)
            with pytest.raises(InputError, match=r"eve\.zip"):
                collect(a_class / "eve.zip", tmp_path / name)


def test_what_cannot_be_opened_is_refused(tmp_path: Path) -> None:
    """Nothing there, nothing in it, no zip."""
    (tmp_path / "empty").mkdir()
    (tmp_path / "bad.zip").write_bytes(b"no zip")
    for name in ("nowhere", "empty", "bad.zip"):
        with pytest.raises(InputError, match=name):
            collect(tmp_path / name, tmp_path / "u")


def test_who_handed_in_no_submission_is_told_so(tmp_path: Path) -> None:
    """Two files with the reason; who handed in nothing has none."""
    empty = dict.fromkeys(COLUMNS, "")
    row = {**empty, "student": "eve", "mark": "0.0", "outcome": "error", "words": "own.py is none.", "file": "own.py"}
    text, _ = write_feedback([row, {**empty, "student": "max", "outcome": "missing"}], tmp_path)
    assert (text.parent.name, row["words"] in text.read_text()) == ("eve", True)


@pytest.mark.parametrize("module", [class_book, collected, notebook], ids=lambda m: m.__name__.split(".")[-1])
def test_the_worked_examples_are_true(module: Any) -> None:
    """What the docstrings show is what comes out."""
    assert doctest.testmod(module).failed == 0
