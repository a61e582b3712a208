"""Tables as spreadsheets save them: with a byte order mark, with semicolons or tabs, with columns of their own."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping, Sequence
from io import StringIO
from pathlib import Path

from reference.errors import InputError
from reference.files.csv_cell import cell

#: What may stand between two cells; that which the first line has most of does.
BETWEEN = ",;\t"


def read_table(file: Path) -> list[dict[str, str]]:
    """The rows of a table, by the names in its first line; rows that are cut short are left out.

    Raises:
        InputError: where it is no text.
    """
    return [row for row in _reader(file) if None not in row and all(isinstance(value, str) for value in row.values())]


def columns_of(file: Path) -> list[str]:
    """The names in the first line of a table. Raises InputError where it is no text."""
    return list(_reader(file).fieldnames or ())


def _reader(file: Path) -> csv.DictReader[str]:
    data = file.read_bytes()
    try:
        text = data.decode("utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    except UnicodeDecodeError:
        try:
            text = data.decode("cp1252")
        except UnicodeDecodeError:
            raise InputError(f"{file}: expected a table in UTF-8") from None
    first = text.partition("\n")[0]
    return csv.DictReader(StringIO(text, newline=""), delimiter=max(BETWEEN, key=first.count))


def written(columns: Sequence[str], rows: Iterable[Mapping[str, str]], guarded: bool = False) -> str:
    """Rows as CSV, in these columns; what a row has not is empty, and nothing is a formula.

    Args:
        guarded: whether the rows are from a table, so that what is a formula there is somebody's own.
    """
    text = StringIO(newline="")
    writer = csv.DictWriter(text, columns)
    writer.writeheader()
    writer.writerows(
        {name: row.get(name, "") if guarded else str(cell(row.get(name, ""))) for name in columns} for row in rows
    )
    return text.getvalue()


def as_meant(text: str) -> str:
    """A cell without the apostrophe that keeps it from being a formula.

    >>> as_meant("'=ada"), as_meant("'t Hooft"), as_meant("ada")
    ('=ada', "'t Hooft", 'ada')
    """
    return text[1:] if text[:1] == "'" and cell(text[1:]) == text else text
