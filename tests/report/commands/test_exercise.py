"""Who is a class and who is one submission: what `springlab exercise check` does with what it is given."""

from __future__ import annotations

from pathlib import Path
from zipfile import ZipFile

import pytest
from click.testing import CliRunner

from report.commands import exercise
from report.commands.exercise import check_command

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
