"""What a lane counts as changed where it looks for a blow-up."""

from __future__ import annotations

import numpy as np

from reference.changes import Change
from reference.system import MassSpringSystem
from report.live.lane import Lane


def test_the_largest_mass_and_stiffness_there_are_now_count() -> None:
    """Of unequal ones, and gravity as it is: each may give a system more energy than it began with."""
    lane = object.__new__(Lane)
    lane._stepped = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array([0.5, 2.0, 1.0]),
        rest_lengths=np.array([1.0, 2.0]),
        stiffness=np.array([400.0, 100.0]),
        gravity=np.array([0.5, -3.0]),
    )
    assert lane._changed() == [
        Change(0.0, "mass", 2.0),
        Change(0.0, "stiffness", 400.0),
        Change(0.0, "gravity", (0.5, -3.0)),
    ]
