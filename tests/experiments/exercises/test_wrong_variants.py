"""Wrong answers that take one thing for another do so, and nothing else."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from experiments.exercises.e07_barrier.exercise import push_out
from experiments.exercises.e10_bridge.exercise import heaviest
from experiments.exercises.solutions.bridges import some_bridge


@pytest.mark.parametrize(
    ("where", "pushed"),
    [
        ("inside", [True, False, False, False]),
        ("outside", [False, True, True, True]),
        ("everywhere", [True, True, True, True]),
        ("square", [True, True, False, False]),  # 0.6^2 < 0.5, and 0.75^2 is not
        ("first", [True, False, False, False]),
    ],
)
def test_who_is_taken_for_inside_a_circle(where: str, pushed: list[bool]) -> None:
    """Of masses 0.4, 0.6, 0.75 and 2 m from the centre of a circle of radius 0.5 m."""
    x = np.array([[0.4, 0.0], [0.6, 0.0], [0.75, 0.0], [2.0, 0.0]])
    circle = SimpleNamespace(centre=np.zeros(2), radius=0.5)
    out, _ = push_out(x, np.zeros((4, 2)), circle, where=where)
    assert out[:, 0] == pytest.approx(np.where(pushed, 0.5, x[:, 0]))


def test_loads_at_the_lower_joints_alone_are_those_without_the_upper_masses() -> None:
    """The lower ones lie at height 0; the right answer has all."""
    bridge = SimpleNamespace(**some_bridge(np.random.default_rng(3), 4, 9.81, 1))
    below = SimpleNamespace(**{**vars(bridge), "masses": np.where(bridge.joints[:, 1] == 0, bridge.masses, 0.0)})
    assert 0 < np.count_nonzero(below.masses) < len(bridge.masses)
    assert heaviest(bridge, joints="lower") == pytest.approx(heaviest(below))
    assert heaviest(bridge, joints="lower") != pytest.approx(heaviest(bridge))
