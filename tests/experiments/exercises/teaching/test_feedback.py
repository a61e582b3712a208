"""What a student gets back: sentences of a row, and a text and a page of each exercise in one folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from experiments.exercises.exercise import find
from experiments.exercises.teaching.class_book import COLUMNS
from experiments.exercises.teaching.feedback import sentences, write_feedback

EMPTY = {**dict.fromkeys(COLUMNS, ""), "mark": "40"}


@pytest.mark.parametrize(
    ("column", "value", "sentence"),
    [
        ("outcome", "right", "Everything asked was answered rightly."),
        ("outcome", "mistake", None),
        ("words", "It falls up.", "It falls up."),
        ("seen", "Right at rest.", "Right at rest."),
        ("departs", "y of step 3", "First difference: y of step 3."),
        ("look_at", "line 4: sign", "A small change of your text would make it right. Look at line 4: sign."),
        ("days_late", "0", None),
        ("days_late", "2", "Days late: 2."),
    ],
)
def test_each_column_has_its_sentence(column: str, value: str, sentence: str | None) -> None:
    """Beside the mark; nothing of what is empty."""
    assert sentences({**EMPTY, column: value}) == ["Mark: 40 of 100.", *([sentence] if sentence else [])]


def test_two_exercises_of_a_student_stand_in_one_folder(tmp_path: Path) -> None:
    """A text and a page each, the page's words escaped; their titles have the student and the exercise."""
    rows = [
        {**EMPTY, "file": f"{n}.py", "student": "Ada <L.>", "exercise": str(n), "words": "k < c & m"} for n in (1, 3)
    ]
    files = write_feedback(rows, tmp_path / "back")
    names = [f"{n:02}_{find(str(n)).name}.{ending}" for n in (1, 3) for ending in ("txt", "html")]
    assert [file.relative_to(tmp_path / "back").as_posix() for file in files] == [f"Ada _L._/{name}" for name in names]
    text, page = (file.read_text(encoding="utf-8") for file in files[2:])
    assert text == f"Ada <L.>: exercise 3, {find('3').title}\n\nMark: 40 of 100.\nk < c & m\n"
    assert f"<h1>Ada &lt;L.&gt;: exercise 3, {find('3').title}</h1>\n<p>Mark: 40 of 100.</p>" in page
    assert "<p>k &lt; c &amp; m</p>" in page
    long, _ = write_feedback([{**rows[0], "student": "x" * 120}], tmp_path / "back")
    assert long.parent.name == "x" * 100
