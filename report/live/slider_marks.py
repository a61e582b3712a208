"""Marks beneath a slider, set anew: viser has no public way to, once a slider is made.

What is used of its own workings here is only a convenience: where another version of viser has them no more, a slider
keeps the marks it was made with.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


def set_marks(slider: Any, marks: Sequence[tuple[int, str]]) -> bool:
    """Put marks at places of a slider of viser's, in place of those it has; whether that could be done."""
    try:
        from viser._gui_api import _build_slider_marks
    except ImportError:
        return False
    if not hasattr(slider, "_marks"):
        return False
    slider._marks = _build_slider_marks(tuple(marks))
    return True
