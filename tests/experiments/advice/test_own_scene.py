"""What a scene is made of, in a table, by hand."""

from __future__ import annotations

import numpy as np

from experiments.advice.own_scene import made_of
from reference.scenes import Setup
from reference.system import MassSpringSystem


def test_what_a_scene_is_made_of() -> None:
    """Each number with its unit; a range where they differ, and one where they do not."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.5, 0.0], [1.5, 0.0]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array([1.0, 0.25, 0.5]),
        rest_lengths=np.array([0.5, 1.0]),
        stiffness=np.array([100.0, 100.0]),
        damping=np.array([0.0, 0.125]),
        drag=0.75,
        gravity=np.array([0.0, -2.0]),
        fixed=np.array([True, False, False]),
    )
    (table,) = made_of(Setup("by-hand", system, 0.001, 0.004, ())).tables
    assert table.columns == ["what", "value", "unit"]
    assert table.rows[:12] == [
        ["masses", 3, ""],
        ["of them fixed", 1, ""],
        ["springs", 2, ""],
        ["mass of one", "0.25 to 1", "kg"],
        ["rest length", "0.5 to 1", "m"],
        ["stiffness", "100", "N/m"],
        ["damping along springs", "0 to 0.125", "N s/m"],
        ["drag on every mass", "0.75", "N s/m"],
        ["gravity", "0, -2", "m/s^2"],
        ["obstacles", "none", ""],
        ["dt", "0.001", "s"],
        ["duration", "0.004", "s"],
    ]
