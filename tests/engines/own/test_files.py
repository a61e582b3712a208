"""Files of one's own as they run: at what times they are asked, what they may import, where they go wrong."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from engines.own.stepper import OwnStepper, own_stepper, stepper_of
from engines.process.isolation import in_this_process
from reference.state import Array
from tests.reference.systems import moving_string

STRING = moving_string(3)


def test_a_step_is_told_the_time_it_begins_at() -> None:
    """0, dt, 2 dt."""
    told: list[tuple[float, float]] = []

    def step(f: Any, y: Array, t: float, dt: float) -> Array:
        told.append((t, dt))
        return y + dt * f(y, t)

    assert stepper_of(step).run(STRING, 0.25, 3).trajectory is not None
    assert told == [(0.0, 0.25), (0.25, 0.25), (0.5, 0.25)]


def test_a_file_imports_what_stands_beside_it_first(tmp_path: Path) -> None:
    """Also where Python has a module of that name; as it does where it is run by itself."""
    (tmp_path / "colorsys.py").write_text("HALF = 0.5\n")
    file = tmp_path / "mine.py"
    file.write_text("from colorsys import HALF\ndef step(f, y, t, dt):\n    return y + 2 * HALF * dt * f(y, t)\n")
    outcome = own_stepper(str(file)).run(STRING, 1e-3, 2)
    assert outcome.ending == "done", outcome.reason


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("import math\nN = 3\nROOT = math.sqrt(-N)\n", "mine.py, line 3: ValueError: math domain error"),
        ("import json\n\nDATA = json.loads('{')\n", "mine.py, line 3: JSONDecodeError: "),
    ],
)
def test_a_file_that_cannot_be_loaded_is_told_by_its_own_line(text: str, said: str, tmp_path: Path) -> None:
    """And not by that of a module which it calls."""
    file = tmp_path / "mine.py"
    file.write_text(f"{text}def step(f, y, t, dt):\n    return y\n")
    outcome = OwnStepper(own_stepper(str(file)).engine, isolate=in_this_process).run(STRING, 1e-3, 1)
    assert outcome.ending == "crashed"
    assert outcome.reason.startswith(said)
