"""Cells of CSV files: what a spreadsheet would run is marked as a text, in every table that is written."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Any

import pytest

from experiments.experiment import Result, Table, write_tables
from experiments.runs.results import write_csv
from reference.files.csv_cell import cell

FORMULAS = (
    "=1+1",
    "+1",
    "-1",
    "@SUM(A1)",
    "\t=1",
    "\r=1",
    "\uff1d1",
    "\uff0b1",
    "\uff0d1",
    "\uff201",
    ";=1",
    " =1",
    '";=1',
)


@pytest.mark.parametrize("text", FORMULAS)
def test_a_text_that_is_a_formula_gets_an_apostrophe(text: str) -> None:
    """Full-width signs, separators and tabs before it included."""
    assert cell(text) == f"'{text}"


@pytest.mark.parametrize("value", ["string", "", " ", "a=1", "1e-3", "0,5", -1.5, 3, None, True])
def test_everything_else_stays_as_it_is(value: Any) -> None:
    """Numbers too, that begin with a sign."""
    assert cell(value) is value


def test_tables_of_experiments_and_of_the_store_have_no_formula(tmp_path: Path) -> None:
    """Neither in cells nor in headings; a number below zero is no formula."""
    (file,) = write_tables(Result([], [Table("t", ["=a", "b"], [["\uff1d1", -1.5]])]), tmp_path)
    assert list(csv.reader(io.StringIO(file.read_text(encoding="utf-8")))) == [["'=a", "b"], ["'\uff1d1", "-1.5"]]
    written = io.StringIO()
    write_csv([{"task": ";=1", "outcome": "done", "reason": None, "=x": -2.0}], written)
    assert list(csv.reader(written.getvalue().splitlines())) == [
        ["task", "outcome", "reason", "'=x"],
        ["';=1", "done", "", "-2.0"],
    ]
