"""Who is a class and who is one submission: what `springlab exercise check` does with what it is given."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from zipfile import ZipFile

import pytest
from click.testing import CliRunner

from experiments.exercises.exercise import exercises
from experiments.exercises.process.sandbox import Limits
from reference.errors import InputError
from report.commands import exercise
from report.commands.exercise import check_command, gradescope_command, list_command

PROGRAM = 'EXERCISE = "euler"\nSEED = "ada"\n\n\ndef step(y, v, dt, spring):\n    return y, v\n'


@pytest.fixture
def checked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Which of the two was done; nothing is run."""
    done: list[str] = []
    monkeypatch.setattr(exercise, "_check_class", lambda *given: done.append("class"))
    monkeypatch.setattr(exercise, "_check_one", lambda path, *given: done.append(f"one, drawn beside {path}"))
    return done


@pytest.mark.parametrize(
    ("files", "options", "expected"),
    [
        (("a.py",), (), "one, drawn beside a.py"),
        (("c.zip",), (), "one, drawn beside c.zip"),  # what is unpacked is gone after it
        (("a.py", "b.py"), (), "class"),
        (("a.py",), ("--csv", "grades.csv"), "class"),
        (("a.py", "b.py"), ("--csv", "grades.csv"), "class"),
        ((".",), (), "class"),
    ],
)
def test_several_files_or_a_table_are_a_class(
    files: tuple[str, ...],
    options: tuple[str, ...],
    expected: str,
    checked: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """One file is a student's own, who is shown a plot."""
    monkeypatch.chdir(tmp_path)
    for name in ("a.py", "b.py"):
        Path(name).write_text(PROGRAM, encoding="utf-8")
    with ZipFile("c.zip", "w") as packed:
        packed.writestr("mine.py", PROGRAM)
    ran = CliRunner().invoke(check_command, [*files, *options], catch_exceptions=False)
    assert ran.exit_code == 0
    assert checked == [expected]


@pytest.mark.parametrize(("columns", "width"), [(60, 60), (100, 100), (140, 100)])
def test_words_are_as_wide_as_the_terminal_and_not_too_wide(
    columns: int, width: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A word of that width is one line, a longer one is two; what no terminal reads is left as it is."""
    monkeypatch.setenv("COLUMNS", str(columns))
    assert exercise._wrapped("a" * 200) == "a" * 200
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    assert exercise._wrapped("a" * width) == "a" * width
    assert exercise._wrapped("a" * (width + 1)) == "a" * width + "\n  a"


def test_grades_are_no_folder(checked: list[str], tmp_path: Path) -> None:
    """Refused before anything is run."""
    (tmp_path / "a.py").write_text(PROGRAM, encoding="utf-8")
    said = CliRunner().invoke(check_command, [str(tmp_path / "a.py"), "--csv", str(tmp_path)])
    assert said.exit_code == 2
    assert "is a directory" in said.output
    assert checked == []


@pytest.mark.parametrize(("words", "key"), [([], None), (["--key-file", "key"], "sesame")])
def test_an_autograder_has_the_teachers_key_or_one_of_its_own(
    words: list[str], key: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nobody guesses that: it is another one every time."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("SPRINGLAB_EXERCISE_KEY", raising=False)
    (tmp_path / "key").write_text("sesame\n", encoding="utf-8")
    asked: list[tuple[object, ...]] = []
    monkeypatch.setattr(
        "experiments.exercises.teaching.gradescope.write_zip",
        lambda found, *given: asked.append((found.number, *given)),
    )
    runner = CliRunner()
    said = runner.invoke(gradescope_command, ["8", *words], catch_exceptions=False)
    more = ["--out", "o.zip", "--let-submissions-reach-my-files", "--started-without-key"]
    runner.invoke(gradescope_command, ["8", *words, *more], catch_exceptions=False)
    assert said.output == "written: autograder.zip\n"
    keys = [given[1] for given in asked]
    assert asked == [(8, keys[0], Path("autograder.zip"), False, True), (8, keys[1], Path("o.zip"), True, False)]
    if key is None:
        assert len({*keys}) == 2
        assert all(len(str(own)) == 32 for own in keys)
    else:
        assert keys == [key, key]


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b" sesame \n", None),
        (b"k" * 2**16, None),
        (b"k" * (2**16 + 1), "expected a key of at most 65536 bytes"),
        (b" \n", "expected the key, the file is empty"),
        (b"\xff", "expected text in UTF-8"),
        (None, "No such file or directory"),
    ],
)
def test_a_key_is_the_text_of_a_file(content: bytes | None, said: str | None, tmp_path: Path) -> None:
    """Without the space around it; what is none is refused in a line."""
    file = tmp_path / "key"
    if content is not None:
        file.write_bytes(content)
    none: Any = None
    if said is None:
        assert content is not None
        assert exercise._key(none, none, file) == content.decode().strip()
        return
    with pytest.raises(InputError) as refused:
        exercise._key(none, none, file)
    assert str(refused.value) == f"--key-file {file}: {said}"


@pytest.mark.parametrize(
    ("keyed", "submission", "key", "says", "right", "told"),
    [
        (True, True, "k", False, False, True),
        (False, True, "k", False, False, False),
        (True, False, "k", False, False, False),
        (True, True, None, False, False, False),
        (True, True, "k", True, False, False),
        (True, True, "k", False, True, False),
    ],
)
def test_a_key_that_was_not_there_in_the_beginning_is_thought_of(
    keyed: bool, submission: bool, key: str | None, says: bool, right: bool, told: bool
) -> None:
    """Of an exercise with keys, graded with one, whose file says nothing of it and is not right."""
    it: Any = SimpleNamespace(exercise=SimpleNamespace(keyed=keyed), keyed=submission, says_keyed=says)
    grade: Any = SimpleNamespace(public=SimpleNamespace(right=right))
    assert exercise._started_without(it, grade, key) is told


@pytest.mark.parametrize(
    ("missing", "exposed", "refused", "line"),
    [
        ([], False, False, ""),
        (["landlock", "a user"], True, False, "springlab: this machine has no landlock, a user to keep submissions in"),
        (["landlock"], False, True, "this machine has no landlock to keep submissions in"),
    ],
)
def test_a_sandbox_without_layers_is_told_or_grades_nothing(
    missing: list[str],
    exposed: bool,
    refused: bool,
    line: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Unless the teacher lets submissions reach the machine."""
    monkeypatch.setattr("experiments.exercises.process.sandbox.missing", lambda: missing)
    if refused:
        with pytest.raises(InputError, match=f"^{line} .*: expected one that has, or --let-submissions-reach-my-files"):
            exercise._require_layers(Limits(exposed=exposed))
        return
    exercise._require_layers(Limits(exposed=exposed))
    assert capsys.readouterr().err.partition(" (report")[0] == line


def test_of_a_class_equal_seeds_are_told_and_what_was_not_graded_is_the_code(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """Of the same exercise only. 0 where all is right, 1 where not, 3 where something was not graded."""
    rows = [
        {"file": f"{i}.py", "exercise": number, "seed": seed, "outcome": "right", "score": "1.0"}
        for i, (number, seed) in enumerate([("1", "a"), ("1", "a"), ("2", "a"), ("1", ""), ("1", ""), ("1", "b")])
    ]
    rows = [{**dict.fromkeys(("public", "hidden", "finding"), ""), **row} for row in rows]
    asked: list[tuple[Any, ...]] = []
    monkeypatch.setattr("experiments.exercises.process.sandbox.missing", list)
    monkeypatch.setattr(
        "experiments.exercises.grading.grade_class", lambda files, table, *others: asked.append((table, others)) or rows
    )

    def code(table: Path | None = None, as_json: bool = False) -> int:
        return exercise._check_class([], None, "k", table, 2, Limits(), False, as_json)

    assert code() == 0
    out, err = capsys.readouterr()
    assert [line for line in out.splitlines() if "seed" in line] == ["Exercise 1: 2 files have the seed a."]
    heading = next(line for line in out.splitlines() if "outcome" in line)
    assert heading.split() == ["file", "exercise", "public", "hidden", "score", "outcome", "finding"]
    assert err == ""
    assert asked[-1][0].name == "grades.csv"
    exercise_, key, jobs, _, limits, keyed = asked[-1][1]
    assert (exercise_, key, jobs, limits, keyed) == (None, "k", 2, Limits(), False)
    rows[0]["outcome"] = "mistake"
    assert code(tmp_path / "t.csv") == 1
    assert "written: " in capsys.readouterr().out
    rows[1]["outcome"] = rows[2]["outcome"] = "not graded"
    assert code(tmp_path / "t.csv", as_json=True) == 3
    out, err = capsys.readouterr()
    assert json.loads(out) == rows
    assert "Exercise 1: 2 files have the seed a." in err
    assert f"written: {tmp_path / 't.csv'}" in err
    assert "springlab: 2 not graded, which is not their fault: the same command tries them again" in err


def test_exercises_are_listed_in_words_and_as_json(monkeypatch: pytest.MonkeyPatch) -> None:
    """With their numbers, minutes and goals, and how many mistakes are known by different names."""
    monkeypatch.setenv("COLUMNS", "200")
    rows = json.loads(CliRunner().invoke(list_command, ["--json"], catch_exceptions=False).output)
    known = exercises()
    assert [(row["exercise"], row["name"], row["title"]) for row in rows] == [
        (number, one.name, one.title) for number, one in known.items()
    ]
    assert all(row["minutes"] > 0 and row["goals"] for row in rows)
    wrong = known[1].mistakes
    assert 1 < rows[0]["mistakes known"] == len({one.name for one in wrong}) <= len(wrong)
    said = CliRunner().invoke(list_command, [], catch_exceptions=False).output
    with pytest.raises(json.JSONDecodeError):
        json.loads(said)
    assert all(one.name in said for one in known.values())
