"""Cells of CSV files: a text that a spreadsheet would take for a formula is marked as a text."""

from __future__ import annotations

from typing import Any

#: What a formula begins with: signs and their full-width forms, and what moves the cell's content to another one.
FORMULA = frozenset("=+-@\t\r\n\uff1d\uff0b\uff0d\uff20")

#: What may stand before it: spaces, and separators that some spreadsheets split cells at.
BEFORE = " ;,|'\"\u00a0\u3000"


def cell(value: Any) -> Any:
    r"""A value for a CSV file: a number stays one, a text that is a formula to spreadsheets gets an apostrophe first.

    (OWASP, "CSV Injection".)

    >>> cell("=1+1"), cell(";=1+1"), cell("\uff1d1") == "'\uff1d1", cell("string"), cell(-1.5)
    ("'=1+1", "';=1+1", True, 'string', -1.5)
    """
    if not isinstance(value, str):
        return value
    begins = value.lstrip(BEFORE)[:1]
    return f"'{value}" if begins in FORMULA and begins else value
