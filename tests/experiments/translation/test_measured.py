"""What is read off an engine's elongations: from oscillations made by hand, rounded, spoilt, and gone."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from engines.translation.translation import Spring, Stepping, find, translations
from experiments.translation import measured, rows
from experiments.translation.measured import SEEN, measured_spring, spring_of_elongations
from experiments.translation.oscillation import STRETCH
from experiments.translation.rows import Row
from reference.outcome import Outcome
from reference.state import Array

#: 2 kg on k = 2 (9^2 + 1.5^2) N/m with c = 6 N s/m swing as exp(-1.5 t) cos(9 t).
SPRING = Spring(2 * (81 + 1.5**2), 6.0, 2.0)


def swing(dt: float, count: int) -> Array:
    """Elongations at so many steps [m]."""
    t = dt * np.arange(count)
    return np.asarray(STRETCH * np.exp(-1.5 * t) * np.cos(9 * t))


def close(found: tuple[float, float] | None, rel: float) -> bool:
    """To the spring that was meant, its damping as a part of what makes it creep."""
    assert found is not None
    return found == (
        pytest.approx(SPRING.stiffness, rel=rel),
        pytest.approx(SPRING.damping, abs=rel * 4 * SPRING.omega),
    )


@pytest.mark.parametrize("place", [0, 100, -1])
@pytest.mark.parametrize("value", [np.nan, np.inf, -11 * STRETCH, 11 * STRETCH])
def test_one_elongation_that_is_none_is_enough(place: int, value: float) -> None:
    """Of a run that blew up, wherever it did."""
    spoilt = swing(0.01, 300)
    assert close(spring_of_elongations(spoilt, SPRING, 0.01), 1e-6)
    spoilt[place] = value
    assert spring_of_elongations(spoilt, SPRING, 0.01) is None


def test_single_precision_is_enough_in_short_steps() -> None:
    """A radian apart its rounding of 1e-7 leaves 1e-9; from one step to the next, a thousandth of that, 1e-4."""
    rounded = swing(1e-4, 20_000).astype(np.float32).astype(float)
    assert close(spring_of_elongations(rounded, SPRING, 1e-4), 1e-8)


def test_what_is_left_in_the_end_is_left_out() -> None:
    """Below SEEN of the first elongation an engine's spring may stick: here at half of that."""
    stuck = swing(0.01, 2000)
    last = np.flatnonzero(np.abs(stuck) > SEEN * STRETCH)[-1]
    stuck[last + 1 :] = 0.5 * SEEN * STRETCH
    assert close(spring_of_elongations(stuck, SPRING, 0.01), 1e-6)


@pytest.mark.parametrize("python", [None, Path("asked/for")])
def test_a_snippet_is_run_by_the_python_that_is_asked_for(python: Path | None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Else by that of the package's environment, where it has a package; and why it failed is told."""
    asked: list[Any] = []

    def isolated(*_: object, python: Path | None, time_limit: float) -> Outcome:
        asked.append(python)
        return Outcome("crashed", "killed")

    monkeypatch.setattr(measured, "isolated", isolated)
    monkeypatch.setattr(measured, "interpreter", lambda package: Path("kept") / package)
    for name in ("mujoco", "godot"):
        assert measured_spring(find(name), "a snippet", SPRING, 0.01, python) == "the snippet crashed: killed"
    assert asked == ([python] * 2 if python else [Path("kept/mujoco"), None])


def test_a_row_has_stiffness_and_damping_under_their_names() -> None:
    """Wanted, effective and measured; where there is none, nothing."""
    row = Row("a", "A", {}, None, (1.0, 2.0), (3.0, 4.0), (5.0, 6.0), 0.5, "")
    assert [row.document[f"{which}{what}"] for which in ("", "effective_", "measured_") for what in
            ("stiffness", "damping")] == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]  # fmt: skip
    none = Row("a", "A", {}, None, (1.0, 2.0), None, None, None, "")
    assert [none.document[f"{which}_damping"] for which in ("effective", "measured")] == [None, None]


def test_sub_steps_go_to_those_that_have_them(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where all engines are asked about; to one that is asked about alone they go as they are."""
    monkeypatch.setattr(rows, "row_of", lambda translation, typed, spring, stepping, measure: (stepping, measure))
    stepping = Stepping(0.01, substeps=3)
    found = dict(zip(translations(), rows.forward(SPRING, stepping, measure=False), strict=True))
    assert found["box2d"] == (stepping, False)
    assert found["mujoco"] == (Stepping(0.01), False)
    assert rows.forward(SPRING, stepping, [find("box2d")]) == [(stepping, True)]
