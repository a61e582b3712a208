"""Rows of a class's book, from files and grades by hand: what counts, who is late, whose program or seed is equal."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

import pytest

from experiments.exercises.handed_in.collected import HandedIn
from experiments.exercises.teaching.class_book import _seeds, book, odd_marks


@pytest.mark.parametrize(
    ("when", "late"), [((3, 12), "0"), ((3, 11), "0"), ((3, 13), "1"), ((4, 12), "1"), ((4, 13), "2"), ((1, 12), "0")]
)
def test_a_day_that_has_begun_is_a_day_late(when: tuple[int, int], late: str) -> None:
    """By the hour it was due; without one nobody is late."""
    file = HandedIn(Path("none.py"), "none.py", "ada", datetime(2026, 11, *when))
    graded = [{"file": "none.py", "exercise": "1", "score": "1.0"}]
    (row,) = book(graded, [file], due=datetime(2026, 11, 3, 12))
    assert row["days_late"] == late
    assert book(graded, [file])[0]["days_late"] == ""


def test_the_newest_file_counts_and_marks_by_hand_stay_without_one() -> None:
    """Whichever is first in the list; of who is missing the mark by hand, else none."""
    files = [HandedIn(Path(f"{day}.py"), f"{day}.py", "ada", datetime(2026, 11, day)) for day in (4, 7, 5)]
    graded = [{"file": file.name, "exercise": "1", "score": f"{file.when.day}.0"} for file in files]
    before = [{"student": "eve", "exercise": "", "by_hand": "50"}, {"student": "ada", "exercise": "", "by_hand": "9"}]
    ada, eve, max_ = book(graded, files, {"eve": "", "ada": "", "max": ""}, before=before)
    assert (ada["file"], ada["mark"], ada["earlier_files"], ada["handed_in"]) == (
        "7.py",
        "7.0",
        "2",
        "2026-11-07 00:00",
    )
    assert [(row["student"], row["mark"], row["by_hand"], row["outcome"]) for row in (eve, max_)] == [
        ("eve", "50", "50", "missing"),
        ("max", "0.0", "", "missing"),
    ]


def test_a_file_of_no_exercise_has_a_row_where_its_student_has_no_other() -> None:
    """Ada has one of an exercise too, Bob has not; and what Eve has handed in says nothing of them."""
    named = {"a1.py": ("ada", "1"), "a2.py": ("ada", ""), "b.py": ("bob", ""), "e.py": ("eve", "3")}
    files = [HandedIn(Path(name), name, who, datetime(2026, 11, 3)) for name, (who, _) in named.items()]
    rows = book([{"file": name, "exercise": e, "score": "1.0"} for name, (_, e) in named.items()], files)
    assert [(row["student"], row["exercise"]) for row in rows] == [("ada", "1"), ("bob", ""), ("eve", "3")]


@pytest.mark.parametrize(
    ("name", "one", "other", "same"),
    [
        ("py", 'SEED = "a"\ndef f(x):\n    "Mine."\n    return 2 * x', 'SEED = "b"\ndef f(x): return 2*x  # so', True),
        ("py", 'SEED = OTHER = "a"\nx = 1', 'SEED = OTHER = "b"\nx = 1', True),
        ("py", "def f(x):\n    return 2 * x", "def f(x):\n    return 3 * x", False),
        ("py", "EXERCISE = 1\nRATE = 2", "EXERCISE = 1\nRATE = 3", False),
        ("py", "def f(:", "def f(:", False),
        ("c", "int f(void) { return 1; } // mine", "int f(void) {\n  return 1;\n}", True),
        ("c", "int f(void) { return 1; }", "int f(void) { return 2; }", False),
    ],
)
def test_programs_are_the_same_whatever_words_and_seeds_they_have(
    name: str, one: str, other: str, same: bool, tmp_path: Path
) -> None:
    """By their syntax, in C by their text without comments; of what cannot be read nothing is said."""
    files = []
    for who, text in (("ada", one), ("bob", other)):
        (tmp_path / f"{who}.{name}").write_text(text + "\n")
        files.append(HandedIn(tmp_path / f"{who}.{name}", f"{who}.{name}", who, datetime(2026, 11, 3)))
    rows = book([{"file": file.name, "exercise": "1", "score": "1.0"} for file in files], files)
    assert [row["same_program_as"] for row in rows] == (["bob", "ada"] if same else ["", ""])


def test_a_seed_is_anothers_where_another_has_it_too() -> None:
    """In the same exercise; by the class list in any; and of who has none nothing is said."""
    file = HandedIn(Path("a.py"), "a.py", "ada", datetime(2026, 11, 3))
    seeds = {("ada", "5"): "x", ("bob", "5"): "x", ("eve", "8"): "x", ("max", "5"): "", ("zoe", "5"): "y"}
    newest = {who: (file, {"seed": seed} if seed else {}) for who, seed in seeds.items()}
    alone: dict[tuple[str, str], list[str]] = {who: [] for who in seeds}
    assert _seeds(newest, {}) == {**alone, ("ada", "5"): ["bob"], ("bob", "5"): ["ada"]}
    listed = {"ada": "x", "max": "", "kim": "y"}
    assert _seeds(newest, listed) == {
        **alone,
        ("ada", "5"): ["bob"],
        ("bob", "5"): ["ada"],
        ("eve", "8"): ["ada"],
        ("zoe", "5"): ["kim"],
    }


@pytest.mark.parametrize(
    ("mark", "odd"),
    [("", False), ("0", False), ("100", False), ("87,5", False), ("-0.1", True), ("100,1", True), ("good", True)],
)
def test_marks_by_hand_are_numbers_from_0_to_100(mark: str, odd: bool) -> None:
    """Others count too, and are told; with their exercise, where they have one."""
    for exercise, place in (("1", "eve, exercise 1: "), ("", "eve: ")):
        told = odd_marks([{"student": "eve", "exercise": exercise, "by_hand": mark}])
        assert len(told) == odd
        assert all(line.startswith(f"by_hand of {place}{mark!r}: ") for line in told)
