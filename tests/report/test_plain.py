"""Values in words: how many figures, what is escaped, and what is left out of a text that is too long."""

from __future__ import annotations

from typing import Any

import pytest

from report.plain import plain, shortened


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (None, "-"),
        (0.0, "0"),
        (1234.5, "1.23e+03"),
        (0.012345, "0.0123"),
        (12345, "12345"),
        ("", ""),
        ("a\x1bb", "a\\x1bb"),
    ],
)
def test_numbers_have_three_figures_and_nothing_is_a_dash(value: Any, words: str) -> None:
    """Whole numbers are whole; what a terminal would obey is escaped."""
    assert plain(value) == words


def test_a_text_of_a_line_is_whole_and_a_longer_one_has_its_ends() -> None:
    """As long as a line may be, and as much of its end as of its beginning, or one more."""
    text = "abcdefghijklmnopqrstuvwxyz"
    assert shortened(text, 26) == text
    assert shortened(text, 25) == "abcdefghij ... qrstuvwxyz"
    assert shortened(text, 24) == "abcdefghij ... rstuvwxyz"
    assert len(shortened(text, 12)) == 12
    assert shortened("x" * 60) == "x" * 60
    assert len(shortened("x" * 61)) == 60
