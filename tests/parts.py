"""A long list, checked in parts: another one every day."""

from __future__ import annotations

from datetime import date

#: All parts come round in less than two weeks. No multiple of 3, as students' mistakes are there in three styles.
PARTS = 13


def todays() -> int:
    """The number of today's part."""
    return date.today().toordinal() % PARTS


def kept(index: int, every: int, number: int) -> bool:
    """Whether a case of a test that runs every n-th of its cases is in a part; one after the other comes round."""
    return index % every == number % every


def part(number: int) -> slice:
    """A part of a list, by its number."""
    return slice(number, None, PARTS)
