"""The stiff limit as it is run: with true motions and a cable made by hand."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from experiments import stiff_limit
from experiments.stiff_limit import CABLE_DT, DT, DURATION, STIFFNESSES
from reference.outcome import Outcome
from reference.pendulum import PendulumMotion
from reference.state import Trajectory
from reference.system import MassSpringSystem

STEPS = round(DURATION / DT)

#: How far the cable is from the pendulum at every time [m]: 1e-9 t.
OFF = 1e-9


def motion(times: np.ndarray, off: float) -> Trajectory:
    """Two masses in the plane, of which the second is so much [m] further along x with each second."""
    positions = np.zeros((len(times), 2, 2))
    positions[:, 1, 0] = off * times
    return Trajectory(times, positions, np.zeros_like(positions))


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """True motions go off by 1/k; the cable, in its shorter steps, by OFF. Who was asked for what."""
    found: list[Any] = []

    def exact(system: MassSpringSystem, dt: float, steps: int, equations: Any = None) -> Trajectory:
        found.append((float(system.stiffness[0]), dt, steps, equations))
        return motion(dt * np.arange(steps + 1), 0.0 if equations else 1 / float(system.stiffness[0]))

    def run(stepper: object, system: MassSpringSystem, dt: float, steps: int) -> Outcome:
        found.append(("cable", dt, steps))
        return Outcome("done", "", motion(dt * np.arange(steps + 1), OFF))

    monkeypatch.setattr(stiff_limit, "exact", exact)
    monkeypatch.setattr(
        stiff_limit, "EngineStepper", lambda engine, isolate: SimpleNamespace(run=lambda *a: run(0, *a))
    )
    return found


def test_each_string_is_held_against_the_pendulum_and_the_cable_at_the_same_times(asked: list[Any]) -> None:
    """The cable in four times as many steps: at their ends it is as far as it is at that time."""
    told: list[str] = []
    result = stiff_limit.run(told.append)
    for row, k in zip(result.data["rows"], STIFFNESSES, strict=True):
        assert row == [k, pytest.approx(DURATION / k), pytest.approx(DURATION * (1 / k - OFF))]
    assert result.data["cable_error"] == pytest.approx(DURATION * OFF)
    assert result.data["slope"] == pytest.approx(-1)
    assert result.failures == []
    pendulum, cable, *strings = asked
    assert pendulum[1:] == (DT, STEPS, PendulumMotion)
    assert cable == ("cable", CABLE_DT, round(DURATION / CABLE_DT))
    assert [string[:3] for string in strings] == [(k, DT, STEPS) for k in STIFFNESSES]
    assert told[-1] == "string of 2e+06 N/m"


@pytest.mark.parametrize("ending", ["unsupported", "diverged"])
def test_a_cable_that_does_not_come_to_its_end_is_a_failure(
    ending: Any, asked: list[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever it has left; the strings have their distances from the pendulum."""
    left = Outcome(ending, "no such package", motion(np.arange(3.0), 1.0) if ending == "diverged" else None)
    monkeypatch.setattr(stiff_limit, "EngineStepper", lambda engine, isolate: SimpleNamespace(run=lambda *_: left))
    result = stiff_limit.run(lambda _: None)
    assert [row[2] for row in result.data["rows"]] == [None] * len(STIFFNESSES)
    assert result.data["cable_error"] is None
    assert result.failures == [f"mujoco_cable_rk4: {ending}, no such package"]


def test_the_slope_is_of_the_stiff_ones() -> None:
    """From the third string on: what the soft ones do is another matter."""
    rows = [[10.0, 5.0, None], [1e2, 7.0, None], *([10.0**n, 3 * 10.0 ** (-0.5 * n), None] for n in (3, 4, 5))]
    assert stiff_limit.result_of(rows, None).data["slope"] == pytest.approx(-0.5)
