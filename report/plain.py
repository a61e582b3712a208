"""Values as people read them, in the terminal and on pages."""

from __future__ import annotations

from typing import Any


def plain(value: Any) -> str:
    """A value as people read it: numbers to three figures, nothing as a dash."""
    if value is None:
        return "-"
    if isinstance(value, float):
        return f"{value:.3g}"
    return str(value)
