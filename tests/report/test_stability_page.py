"""How far theory looks, as the page on stability says it: the numbers of the modules that it names."""

from __future__ import annotations

from pathlib import Path

import pytest

from reference.theory import rates, step_spectrum, windows

PAGE = Path(__file__).parents[2] / "report" / "docs" / "stability.md"


@pytest.mark.parametrize(
    "words",
    [
        f"on up to {step_spectrum.WHOLE_UP_TO} positions and velocities",
        f"Of systems of more than {rates.ALL_UP_TO // 2} coordinates with damping",
        f"schemes on more than {step_spectrum.WHOLE_UP_TO // 4} masses in the plane",
        f"on systems of up to {windows.MOST} coordinates, at {windows.LOOKS} steps each",
    ],
)
def test_limits_of_what_is_looked_at_are_those_of_the_modules(words: str) -> None:
    """A mass in the plane has two coordinates and two velocities."""
    assert words in " ".join(PAGE.read_text(encoding="utf-8").split())
