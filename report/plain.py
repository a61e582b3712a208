"""Values as people read them, in the terminal and on pages."""

from __future__ import annotations

from typing import Any

from reference.printable import printable

#: The most characters of a text that is said in a line, not all of which is news.
IN_A_LINE = 60


def plain(value: Any) -> str:
    """A value as people read it: numbers to three figures, nothing as a dash, control characters escaped."""
    if value is None:
        return "-"
    if isinstance(value, float):
        return f"{value:.3g}"
    return printable(str(value))


def shortened(text: str, most: int = IN_A_LINE) -> str:
    """A text, what is too much left out of its middle.

    >>> shortened("a rather long name", most=10)
    'a r ... me'
    """
    if len(text) <= most:
        return text
    before = (most - 4) // 2
    return f"{text[:before]} ... {text[len(text) - (most - 5 - before) :]}"
