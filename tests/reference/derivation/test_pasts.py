"""Whether a step remembers, told of runs that are made by hand."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from reference.derivation.oscillators import ASIDE, DT, Run, Runs
from reference.derivation.pasts import pasts
from reference.outcome import Outcome
from reference.state import Trajectory


def counting(position: float, velocity: float) -> Runs:
    """A stepper that counts: it moves its mass on by so much [m, m/s] at every step of a run but the first."""

    def runs(asked: Sequence[Run]) -> list[Outcome]:
        found = []
        for system, dt, steps in asked:
            times = dt * np.arange(steps + 1.0)
            later = np.maximum(np.arange(steps + 1.0) - 1, 0.0)[:, None, None] * np.array([[0.0], [1.0]])
            x = system.positions + position * later
            v = system.start.velocities + velocity * later
            found.append(Outcome("done", "", Trajectory(times, x, v)))
        return found

    return runs


@pytest.mark.parametrize(("position", "velocity"), [(0.0, 0.0), (1e-3, 0.0), (0.0, 1e-3), (1e-3, 1e-3)])
def test_a_step_that_is_another_one_after_others_remembers(position: float, velocity: float) -> None:
    """In its positions or in its velocities alone, by as much as it counts: the velocity's, over a step."""
    found = pasts(counting(position, velocity), "double", damped=False, dragged=False)
    assert found.deterministic
    assert found.one_step == (position == velocity == 0)
    assert found.apart == pytest.approx(max(position, DT * velocity) / ASIDE)
