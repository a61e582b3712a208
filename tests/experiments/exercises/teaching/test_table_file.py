"""Tables as spreadsheets save them, read and written; marks in the columns of learning platforms."""

from __future__ import annotations

from pathlib import Path

import pytest

from experiments.exercises.teaching.platforms import words
from experiments.exercises.teaching.table_file import as_meant, columns_of, read_table, written
from reference.errors import InputError


@pytest.mark.parametrize("between", [",", ";", "\t"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_whole_rows_are_read(between: str, encoding: str, tmp_path: Path) -> None:
    """Whatever stands between cells, in each encoding; not those with a cell too few or too many."""
    rows = [["name", "mark"], ["Zoë", "1"], ["eve"], ["max", "2", "3"], ["", ""]]
    file = tmp_path / "table.csv"
    file.write_bytes("".join(between.join(row) + "\r\n" for row in rows).encode(encoding))
    assert read_table(file) == [{"name": "Zoë", "mark": "1"}, {"name": "", "mark": ""}]


def test_the_first_line_says_what_stands_between_cells(tmp_path: Path) -> None:
    """However often it stands in those below; its names are known where there are no rows."""
    file = tmp_path / "table.csv"
    file.write_text("name;mark\n" + "a,b,c,d;1\n" * 3, encoding="utf-8")
    assert read_table(file) == [{"name": "a,b,c,d", "mark": "1"}] * 3
    assert columns_of(file) == ["name", "mark"]
    file.write_text("name\tmark\n", encoding="utf-8-sig")
    assert (columns_of(file), read_table(file)) == (["name", "mark"], [])
    file.write_text("", encoding="utf-8")
    assert columns_of(file) == []


def test_an_apostrophe_is_taken_off_where_it_guards() -> None:
    """A formula: not a name, nor what has none."""
    given = ["'=ada", "'t Hooft", "ada", "=ada", ""]
    assert list(map(as_meant, given)) == ["=ada", *given[1:]]


def test_what_is_no_text_is_refused(tmp_path: Path) -> None:
    """By name: a byte that no letter of any of these encodings has."""
    file = tmp_path / "table.csv"
    file.write_bytes(b"name,mark\n\x81,1\n")
    with pytest.raises(InputError, match=r"table\.csv: expected a table in UTF-8"):
        read_table(file)


def test_what_would_be_a_formula_is_guarded_once() -> None:
    """Rows of one's own are guarded; those that come from a table are as they were."""
    rows = [{"name": "=ada"}, {"mark": "1"}]
    assert written(["name", "mark"], rows) == "name,mark\r\n'=ada,\r\n,1\r\n"
    assert written(["name", "mark"], rows, guarded=True) == "name,mark\r\n=ada,\r\n,1\r\n"


@pytest.mark.parametrize(
    ("row", "told"),
    [
        (
            {"words": "It falls up.", "seen": "Right at rest.", "look_at": "line 3"},
            "It falls up. Right at rest. Look at line 3.",
        ),
        ({"words": "", "seen": "Right at rest.", "look_at": ""}, "Right at rest."),
        ({"words": "", "seen": "", "look_at": ""}, "right"),
    ],
)
def test_a_platform_is_told_what_a_student_is_told(row: dict[str, str], told: str) -> None:
    """What it is, what was seen, where to look, on one line; the outcome where there is none of these."""
    assert words({**row, "outcome": "right"}) == told
