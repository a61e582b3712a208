"""Which checks make a grade, and what stands in its row: verdicts are made up here, nothing is run."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event
from typing import Any

import pytest

from experiments.exercises import grading
from experiments.exercises.closer_look import CloserLook
from experiments.exercises.exercise import find
from experiments.exercises.grading import Grade, grade, grade_class, places, row_of
from experiments.exercises.handed_in.submission import Submission
from experiments.exercises.process.sandbox import Limits
from experiments.exercises.process.sandbox_errors import NotGradedError
from experiments.exercises.repair.repaired import Repair
from experiments.exercises.teaching.table_file import read_table
from experiments.exercises.verdict.findings import Finding
from experiments.exercises.verdict.first_difference import FirstDifference
from experiments.exercises.verdict.judge import Outcome, Verdict
from reference.errors import InputError

RIGHT = Verdict("right", (), (True, True))
WRONG = Verdict("mistake", (Finding("sign", "It has another sign."),), (True, False))
ENDS = Verdict("timed out", (), (False, False))


class Stage:
    """What the checks say, and what was asked of them."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, public: Any, hidden: Any = RIGHT) -> None:
        self.asked: list[str | None] = []
        self.given: list[tuple[Any, ...]] = []
        self.looked: list[Any] = []
        self._says = {"public": public, "hidden": hidden}
        monkeypatch.setattr(grading, "judge", self._judge)
        monkeypatch.setattr(grading, "look_closer", self._look)

    def _judge(self, *given: Any) -> Verdict:
        self.given.append(given)
        key = given[3]
        self.asked.append(key)
        says = self._says["public" if key is None else "hidden"]
        found = says.pop(0) if isinstance(says, list) else says
        if isinstance(found, Exception):
            raise found
        verdict: Verdict = found
        return verdict

    def _look(self, *given: Any) -> CloserLook:
        self.looked.append(given)
        return CloserLook(tried=3)


def own(number: int = 1, **more: Any) -> Submission:
    """A submission of an exercise."""
    exercise = find(str(number))
    return Submission("own.py", "a = 1\n", exercise, "ada" if exercise.seeded else "", **more)


@pytest.mark.parametrize(
    ("number", "key", "public", "asked", "hidden", "looked"),
    [
        (1, None, RIGHT, [None], None, False),
        (1, "k", RIGHT, [None, "k"], WRONG, True),
        (1, "k", WRONG, [None, "k"], WRONG, True),
        (1, None, WRONG, [None], None, True),
        (5, None, RIGHT, [None], None, False),
        (5, "k", RIGHT, [None], RIGHT, False),
        (5, "k", WRONG, [None], WRONG, True),
    ],
)
def test_which_checks_are_run(
    monkeypatch: pytest.MonkeyPatch,
    number: int,
    key: str | None,
    public: Verdict,
    asked: list[str | None],
    hidden: Verdict | None,
    looked: bool,
) -> None:
    """With a key the hidden one too; where everybody has numbers of their own the two are the same.

    Wrong ones are looked at more closely.
    """
    stage = Stage(monkeypatch, public, WRONG)
    given = grade(own(number), key)
    assert (stage.asked, given.public, given.hidden) == (asked, public, hidden)
    assert len(stage.looked) == looked
    assert given.closer.tried == 3 * looked
    assert given.seconds >= 0
    assert grade(own(number), key, effort=None).closer == CloserLook()
    assert len(stage.looked) == looked


@pytest.mark.parametrize("outcome", ["timed out", "crashed"])
def test_after_a_bad_end_nothing_more_is_run(monkeypatch: pytest.MonkeyPatch, outcome: Outcome) -> None:
    """The hidden questions are not passed then."""
    stage = Stage(monkeypatch, Verdict(outcome, (), (False,)))
    given = grade(own(), "k")
    assert stage.asked == [None]
    assert given.hidden is not None
    assert (given.hidden.outcome, any(given.hidden.passed), len(given.hidden.passed) > 1) == (outcome, False, True)


def test_what_was_not_the_submissions_fault_is_tried_once_more(monkeypatch: pytest.MonkeyPatch) -> None:
    """Twice over it is told."""
    stage = Stage(monkeypatch, [NotGradedError("busy"), RIGHT])
    assert grade(own()).public == RIGHT
    assert stage.asked == [None, None]
    Stage(monkeypatch, [NotGradedError("busy"), NotGradedError("still busy"), RIGHT])
    with pytest.raises(NotGradedError, match="still busy"):
        grade(own())


def test_each_column_of_a_row_has_its_own() -> None:
    """The verdict that says most; what was seen; the change for teachers only, who have a key."""
    difference = FirstDifference("spring 1", 2, "y", "mass", (), 0.1, 0.2)
    public = Verdict(
        "mistakes", (Finding("a", "One."), Finding("b", "Two.")), (True, False), first_difference=difference
    )
    repairs = (
        Repair("step", ((4, "sign"), (7, "name")), "a -> b", 1.0),
        Repair("step", ((9, "index"),), "c -> d", 1.2),
    )
    closer = CloserLook((Finding("c", "Three."),), repairs)
    submission = own(5)
    row = row_of(submission, Grade(public, RIGHT, 1.234, closer), "k")
    assert row == {
        "file": "own.py",
        "exercise": "5",
        "seed": "ada",
        "public": "failed",
        "hidden": "passed",
        "score": "75.0",
        "outcome": "mistakes",
        "finding": "a + b",
        "words": "One. Two.",
        "departs": "spring 1, step 2: y is 0.2, expected 0.1",
        "seen": "Three.",
        "look_at": "line 4: sign and line 7: name; or line 9: index",
        "change": "a -> b; or: c -> d",
        "seconds": "1.23",
        "digest": submission.digest("k"),
    }
    alone = row_of(submission, Grade(RIGHT, None, 0.0), None)
    assert (alone["public"], alone["hidden"], alone["score"], alone["change"]) == ("passed", "", "100.0", "")
    assert row_of(submission, Grade(public, RIGHT, 1.0, closer), None)["change"] == ""
    remarked = Verdict("right", (), (True,), remarks=(Finding("r", "Look."),))
    assert row_of(submission, Grade(remarked, None, 1.0, closer), None)["seen"] == "Three. Look."
    assert places(CloserLook(repairs=(repairs[1], repairs[1]))) == "line 9: index"
    long = row_of(submission, Grade(Verdict("mistake", (Finding("a", "x" * 300),), (False,)), None, 0.0), None)
    assert long["words"] == "x" * 200 + " ..."


def test_a_check_is_given_all_that_it_depends_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """Exercise, text, seed, key, limits, language, in this order; also where it is tried again."""
    limits = Limits(seconds=3)
    stage = Stage(monkeypatch, [NotGradedError("busy"), WRONG], WRONG)
    submission = own(language="c")
    grade(submission, "k", limits)
    one = (submission.exercise, "a = 1\n", "")
    assert stage.given == [(*one, None, limits, "c"), (*one, None, limits, "c"), (*one, "k", limits, "c")]
    ((exercise, source, seed, verdict, *rest),) = stage.looked
    assert (exercise, source, seed, verdict) == (*one, WRONG)
    assert rest == [limits, grading.EFFORT, "c"]


def test_in_a_class_less_is_searched() -> None:
    """Of everything, as many wait; of a mistake with a name the least."""
    alone, many = grading.EFFORT, grading.EFFORT_IN_CLASS
    for name in ("singles", "pairs", "named", "compiled"):
        assert 0 < getattr(many, name) < getattr(alone, name)
    assert alone.named <= 1.0
    assert alone.singles + alone.pairs < 3.0


@pytest.mark.parametrize("limits", [None, Limits(seconds=3)])
def test_a_class_is_graded_in_a_table(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, limits: Limits | None) -> None:
    """By names; what is there already is not done again, nor are columns lost that somebody has added.

    Rows of files that are no longer there stay.
    """
    files = []
    for name in ("eve", "ada", "bob"):
        (tmp_path / f"{name}.py").write_text(f"EXERCISE = 1\n# {name}\n", encoding="utf-8")
        files.append((tmp_path / f"{name}.py", f"{name}.py"))
    stage, table, told = Stage(monkeypatch, WRONG), tmp_path / "grades.csv", []
    rows = grade_class(files, table, workers=2, tell=told.append, limits=limits)
    assert [row["file"] for row in rows] == ["ada.py", "bob.py", "eve.py"]
    assert told == ["1 of 3", "2 of 3", "3 of 3"]
    assert all(given[4] is limits for given in stage.looked)
    text = table.read_text(encoding="utf-8").splitlines()
    text = [f"{text[0]},mine", *(f"{line},=1+{i}" for i, line in enumerate(text[1:]))]
    table.write_text("\n".join(text) + "\n", encoding="utf-8")
    (tmp_path / "bob.py").write_text("EXERCISE = 1\n# bob again\n", encoding="utf-8")
    del stage.asked[:], told[:]
    so_far: list[list[list[str]]] = []

    def tell(words: str) -> None:
        told.append(words)
        so_far.append([line.split(",") for line in table.read_text(encoding="utf-8").splitlines()])

    grade_class(files[1:], table, tell=tell, workers=1)
    assert (stage.asked, told) == ([None], ["1 of 2", "2 of 2"])
    # what is done is in the table already, once; what is new behind it, in as many columns
    assert [[row[0] for row in rows[1:]] for rows in so_far][-1] == ["ada.py", "bob.py", "eve.py", "bob.py"]
    assert {len(row) for row in so_far[-1]} == {len(grading.COLUMNS) + 1}
    found = {row["file"]: row for row in read_table(table)}
    assert list(found) == ["ada.py", "bob.py", "eve.py"]
    assert [row["mine"] for row in found.values()] == ["=1+0", "", "=1+2"]
    # another key is another grade
    grade_class(files, table, key="k")
    assert len(stage.asked) == 1 + 2 * 3


def test_what_is_no_table_of_grades_is_left_as_it_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With rows and without, also where it has files in it; one of grades is gone on with, whatever else it has."""
    table, own_file = tmp_path / "grades.csv", tmp_path / "own.py"
    own_file.write_text("EXERCISE = 1\n", encoding="utf-8")
    stage = Stage(monkeypatch, WRONG)
    for text in ("file,mark\n", "file,mark\na.py,1\n", "", ",".join(grading.COLUMNS[1:]) + "\n"):
        table.write_text(text, encoding="utf-8")
        with pytest.raises(InputError, match=r"grades\.csv is not a table of grades: expected the columns file, exer"):
            grade_class([(own_file, "own.py")], table)
        assert table.read_text(encoding="utf-8") == text
    assert stage.asked == []
    table.write_text(";".join([*reversed(grading.COLUMNS), "mine"]) + "\n", encoding="utf-8-sig")
    grade_class([(own_file, "own.py")], table)
    assert [row["file"] for row in read_table(table)] == ["own.py"]


@pytest.mark.parametrize("workers", [None, 3])
def test_submissions_that_wait_are_left_where_it_is_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, workers: int | None
) -> None:
    """As many are done at once as are asked for, or as there are cores."""
    pools: list[Pool] = []

    class Pool(ThreadPoolExecutor):
        """What it was told."""

        def __init__(self, workers: int) -> None:
            super().__init__(1)
            self.told: list[object] = [workers]
            pools.append(self)

        def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
            """Nothing more is begun; what is being done waits for this."""
            super().shutdown(False, cancel_futures=cancel_futures)
            ended.set()
            super().shutdown(True)

    ended, begun = Event(), []

    def once(path: Path, name: str, *_: object) -> dict[str, str]:
        begun.append(name)
        if len(begun) > 1:
            ended.wait()
        return {"file": name, "digest": ""}

    def end(_: str) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(grading, "ThreadPoolExecutor", Pool)
    monkeypatch.setattr(grading, "_graded", once)
    with pytest.raises(KeyboardInterrupt):
        grade_class([(tmp_path / str(i), str(i)) for i in range(5)], tmp_path / "g.csv", workers=workers, tell=end)
    assert pools[0].told == [workers or os.cpu_count()]
    assert len(begun) <= 2


def test_what_goes_wrong_with_a_file_is_in_its_row(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is no submission has no points; what could not be graded has none given, and is done again."""
    (tmp_path / "none.py").write_text("a = 1\n", encoding="utf-8")
    (tmp_path / "own.py").write_text("EXERCISE = 1\n", encoding="utf-8")
    files = [(tmp_path / name, name) for name in ("none.py", "own.py")]
    Stage(monkeypatch, [NotGradedError("busy")] * 2 + [KeyError("fault")])
    for words in ("busy", "KeyError: 'fault'"):
        none, own_row = grade_class(files, tmp_path / "grades.csv", workers=1)
        assert (none["outcome"], none["finding"], none["score"]) == ("error", "not_a_submission", "0.0")
        assert (own_row["outcome"], own_row["finding"], own_row["score"]) == ("not graded", "not_graded", "")
        assert own_row["words"] == words
        assert own_row["digest"] == ""
