"""What a result says, read back: tables by their columns, sentences by their numbers."""

from __future__ import annotations

import re
from typing import Any

from experiments.experiment import Result

#: A number in a text: not a part of a name, thousands perhaps apart by commas, perhaps with a power of ten.
NUMBER = re.compile(r"(?<![\w.])-?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:e[-+]?\d+)?(?!\w*\^)")


def numbers(text: str) -> list[float]:
    """The numbers in a text, in their order."""
    return [float(found.replace(",", "")) for found in NUMBER.findall(text)]


def records(result: Result, table: str | None = None) -> list[dict[str, Any]]:
    """The rows of a table, by default the first, each by its columns."""
    (found,) = [t for t in result.tables if t.name == table] if table else result.tables[:1]
    return [dict(zip(found.columns, row, strict=True)) for row in found.rows]


def finding(result: Result, *parts: str) -> str:
    """The one sentence with all of these words in it."""
    (found,) = [sentence for sentence in result.findings if all(part in sentence for part in parts)]
    return found


def in_order(text: str, *parts: str) -> bool:
    """Whether parts of a text stand in it one after another."""
    place = 0
    for part in parts:
        place = text.find(part, place)
        if place < 0:
            return False
        place += len(part)
    return True
