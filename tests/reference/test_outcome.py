"""Outcomes: when a trajectory counts as blown up, and how that is said."""

from __future__ import annotations

import numpy as np
import pytest

from reference.outcome import Outcome, blow_up, first_diverged_frame, outcome_of
from reference.scenes import find as find_scene
from reference.state import Trajectory

STRING = find_scene("string").system({"masses": 2, "rest_length": 1.0})


def trajectory(*tips: float) -> Trajectory:
    """The string, its last mass at these places along it at 0, 0.1 s, 0.2 s, ..."""
    positions = np.repeat(STRING.positions[None], len(tips), axis=0)
    positions[:, 2, 0] = tips
    return Trajectory(np.linspace(0.0, 0.1 * (len(tips) - 1), len(tips)), positions, np.zeros_like(positions))


def test_a_run_within_bounds_is_done() -> None:
    """Springs of up to 100 times their length are far from broken by rounding."""
    run = trajectory(2.0, 50.0, 100.9)
    assert blow_up(STRING, run) is None
    assert outcome_of(STRING, run) == Outcome("done", "", run)


@pytest.mark.parametrize(
    ("tips", "reason"),
    [
        ((2.0, 3.0, 101.1), "spring 1 is over 100 times its length at t = 0.2 s"),
        ((2.0, 1e300, np.nan), "spring 1 is over 100 times its length at t = 0.1 s"),
        ((2.0, np.nan), "the position of mass 2 is not a number at t = 0.1 s"),
        ((2.0, 3.0, np.inf), "the position of mass 2 is not a number at t = 0.2 s"),
        ((2.0, 3.0, -np.inf), "the position of mass 2 is not a number at t = 0.2 s"),
    ],
)
def test_a_blow_up_is_told_with_its_first_time_and_place(tips: tuple[float, ...], reason: str) -> None:
    """The mass or the spring, and when it is first seen."""
    run = trajectory(*tips)
    assert outcome_of(STRING, run) == Outcome("diverged", reason, run)


def test_a_spring_is_measured_by_its_length_at_the_start_if_that_is_longer() -> None:
    """Whoever starts with a spring stretched 200 times has not diverged by that."""
    assert blow_up(STRING, trajectory(201.0, 250.0, 190.0)) is None


def test_the_first_diverged_frame_is_found_at_any_stretch_ratio() -> None:
    """At three times the length already, for identification; the number of frames if there is none."""
    run = trajectory(2.0, 3.9, 4.1, 500.0)
    assert first_diverged_frame(STRING, run, 3.0) == 2
    assert first_diverged_frame(STRING, run, 100.0) == 3
    assert first_diverged_frame(STRING, run, 1e6) == 4
