"""Tables as spreadsheets save them: with a byte order mark, with semicolons or tabs, with columns of their own."""

from __future__ import annotations

import csv
from io import StringIO
from pathlib import Path

from reference.errors import InputError

#: What may stand between two cells; that which the first line has most of does.
BETWEEN = ",;\t"


def read_table(file: Path) -> list[dict[str, str]]:
    """The rows of a table, by the names in its first line; rows that are cut short are left out.

    Raises:
        InputError: where it is no text.
    """
    data = file.read_bytes()
    try:
        text = data.decode("utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    except UnicodeDecodeError:
        try:
            text = data.decode("cp1252")
        except UnicodeDecodeError:
            raise InputError(f"{file}: expected a table in UTF-8") from None
    first = text.partition("\n")[0]
    reader = csv.DictReader(StringIO(text, newline=""), delimiter=max(BETWEEN, key=first.count))
    return [row for row in reader if None not in row and all(isinstance(value, str) for value in row.values())]
