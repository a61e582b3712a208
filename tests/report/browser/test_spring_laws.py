"""Numbers that write themselves, as the law of springs asks of them; and of which rest a page tells."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from report.browser.spring_laws import Written
from report.browser.system_data import _about


def test_what_is_done_to_a_number_is_written() -> None:
    """Each side in its place; a fourth power is two squares, an array of one number is that."""
    a, b = Written("a"), Written("b")
    made = {
        "(a + b)": a + b,
        "(2.5 + a)": 2.5 + a,
        "(a - 1)": a - 1,
        "(a * b)": a * b,
        "(2 * a)": 2 * a,
        "(a / b)": a / b,
        "(a * a)": a**2,
        "((a * a) * (a * a))": a**4,
        "(a < 0.5)": a < 0.5,
        "(a > b)": a > b,
        "(a && b)": a & b,
        "(a || b)": a | b,
        "Math.abs(a)": np.abs(a),
        "(a || (b > 0))": np.bitwise_or(a, b > 0),
        "(a ? b : 0.0)": np.where(a, b, np.array(0.0)),
    }
    assert {text: getattr(found, "text", found) for text, found in made.items()} == {text: text for text in made}
    for unknown in (lambda: np.sqrt(a), lambda: np.dot(a, b)):
        with pytest.raises(TypeError):
            unknown()


@pytest.mark.parametrize(
    ("obstacles", "contacts", "word"),
    [((), None, "without_obstacles"), ((1,), None, "no_contact"), ((1,), [3], "on_obstacles")],
)
def test_about_which_rest_it_is_is_told(obstacles: Any, contacts: Any, word: str) -> None:
    """Of a scene with obstacles: one without them, one that touches none, or one on them."""
    found: Any = SimpleNamespace(system=SimpleNamespace(obstacles=obstacles), contacts=contacts)
    assert _about(found) == word
