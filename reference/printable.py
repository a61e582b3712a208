"""Names as they may be shown: they come from files, and terminals and tables obey what is in them."""

from __future__ import annotations


def printable(text: str) -> str:
    r"""A text with control characters escaped: names come from files, and a terminal obeys what is in them.

    >>> print(printable("scene \x1b]0;title\x07.toml"))
    scene \x1b]0;title\x07.toml
    """
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
