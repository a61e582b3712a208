"""Answers as tables, by their columns, from answers that are made up."""

from __future__ import annotations

from math import nan, pi
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from report import shown

SETUP = SimpleNamespace(name="string", dt=0.001, run_duration=2.0, duration=2.0, steps=2000)


def columns(table: shown.Shown) -> dict[str, list[Any]]:
    """The cells under each heading."""
    return {name: [row[i] for row in table.rows] for i, name in enumerate(table.columns)}


def of_natural(**fields: Any) -> Any:
    """Two modes: 4 Hz, of which the damping is known, and one of what nothing holds."""
    natural = SimpleNamespace(frequencies=np.array([0.0, 4.0]), damping_ratios=np.array([nan, 0.25]), coupled=0.0)
    return SimpleNamespace(setup=SETUP, natural=natural, about="", **fields)


def test_modes_have_their_frequencies_periods_and_damping() -> None:
    """Angular frequency 2 pi f, period 1/f; what is not there is no number."""
    table = shown.of_modes(of_natural())
    assert columns(table) == {
        "mode": ["1", "2"],
        "frequency [Hz]": [0.0, 4.0],
        "angular [rad/s]": [0.0, 8 * pi],
        "period [s]": [None, 0.25],
        "damping ratio": [None, 0.25],
    }
    assert not table.notes


def test_modes_that_damping_couples_are_told() -> None:
    """And what rest they are about."""
    modes = of_natural()
    modes.natural.coupled, modes.about = 0.123, "modes on the ground"
    first, second = shown.of_modes(modes).notes
    assert "12.3%" in first
    assert "modes on the ground" in second


def test_springs_at_rest_pull_push_or_do_neither() -> None:
    """By the sign of their force."""
    system = SimpleNamespace(springs=np.array([[0, 1], [1, 2], [2, 5]]))
    setup = SimpleNamespace(system=system)
    table = shown.of_springs_at_rest(SimpleNamespace(setup=setup, forces=np.array([2.5, -1.5, 0.0])))  # type: ignore[arg-type]
    assert columns(table) == {
        "spring": ["0", "1", "2"],
        "masses": ["0 - 1", "1 - 2", "2 - 5"],
        "force [N]": [2.5, -1.5, 0.0],
        "": ["tension", "compression", "none"],
    }


def test_angular_springs_have_their_bend_and_torque() -> None:
    """One that is gone has none."""
    system: Any = SimpleNamespace(angular_springs=SimpleNamespace(masses=np.array([[0, 1, 2], [1, 2, 3]])))
    table = shown.of_bends(system, np.array([0.5, nan]), np.array([-2.0, 0.0]), "at rest")
    assert columns(table) == {
        "spring": ["0", "1"],
        "masses": ["0 - 1 - 2", "1 - 2 - 3"],
        "bend [rad]": [0.5, "gone"],
        "torque [N m]": [-2.0, 0.0],
    }
    straight: Any = SimpleNamespace(angular_springs=None)
    assert not shown.of_bends(straight, np.empty(0), np.empty(0), "at rest").rows


@pytest.mark.parametrize(("asked", "said"), [(2.0, False), (2.0004, True)])
def test_a_duration_that_is_no_whole_number_of_steps_is_told(asked: float, said: bool) -> None:
    """With how many steps it is."""
    title = shown.title_of(SimpleNamespace(**{**vars(SETUP), "duration": asked}))  # type: ignore[arg-type]
    assert title.startswith("string: dt = 0.001 s, 2 s")
    assert ("2000 whole steps" in title) == said


@pytest.mark.parametrize(("single_steps", "heading"), [(False, "deviation [m]"), (True, "deviation in a step [m]")])
def test_an_identification_lists_the_catalogue(single_steps: bool, heading: str) -> None:
    """Nearest first, as it comes; an error that is no number is none."""
    matches = [
        SimpleNamespace(scheme="heun", error=1e-16, steps=100),
        SimpleNamespace(scheme="rk4", error=nan, steps=7),
    ]
    found: Any = SimpleNamespace(ranking=matches, by_single_steps=single_steps, remark="a tie")
    table = shown.of_identification(found)
    assert columns(table) == {"scheme": ["heun", "rk4"], heading: [1e-16, None], "over [steps]": [100, 7]}
    assert list(table.notes) == ["a tie"]
