"""Names as they may be shown."""

from __future__ import annotations

import pytest

from reference.printable import printable


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("string", "string"),
        ("Pfähle 1 µm 弦", "Pfähle 1 µm 弦"),
        ("a\nb\tc", r"a\nb\tc"),
        ("scene \x1b]0;title\x07", r"scene \x1b]0;title\x07"),
        ("\u202eevil", r"\u202eevil"),
    ],
)
def test_what_a_terminal_would_obey_is_escaped_and_nothing_else(text: str, shown: str) -> None:
    """Control characters, and those that turn the direction of writing; not letters of any language."""
    assert printable(text) == shown
