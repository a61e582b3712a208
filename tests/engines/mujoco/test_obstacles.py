"""What MuJoCo makes of contacts, by measurement: the facts that the adapter's settings rest on."""

from __future__ import annotations

import numpy as np
import pytest

from engines.engine import find, version
from engines.mujoco import obstacles as mujoco_obstacles
from engines.process.isolation import isolated
from reference.obstacles import Box
from reference.system import MassSpringSystem
from tests.conformance.test_obstacles import KINDS, STEPS, falling

pytestmark = pytest.mark.skipif(version(find("mujoco_tendons")) is None, reason="mujoco is not installed")


def rebound(damping: float) -> float:
    """The part of the speed it came with that a mass leaves a plane with, at a damping ratio."""
    mujoco_obstacles.DAMPING = damping
    case = falling(KINDS["plane"], 0.0)
    simulation = find("mujoco_tendons").start(case.system, case.dt)
    up = 0.0
    for _ in range(STEPS):
        simulation.step()
        up = max(up, float(simulation.state()[1][-1, 1]))
    return up / float(np.sqrt(2 * 9.81 * 0.2))


def test_a_mass_is_thrown_back_less_the_more_it_is_damped() -> None:
    """A mass comes at most v dt deep and is moved out at r/(4 z^2 dt): at most v/(4 z^2), z the damping ratio."""
    found = [float(isolated(rebound, z)) for z in (1.0, 2.0, 4.0)]  # type: ignore[arg-type]
    for back, z in zip(found, (1.0, 2.0, 4.0), strict=True):
        assert 0.1 / (4 * z**2) <= back <= 1.02 / (4 * z**2)
    assert mujoco_obstacles.DAMPING == 2.0


def depth_in_a_thin_box() -> float:
    """How deep a mass is in a table 2 m wide and 1 mm high, 0.2 s after it was let go 1 mm above it [m]."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0015]]),
        springs=np.zeros((0, 2), dtype=int),
        masses=1.0,
        rest_lengths=np.zeros(0),
        stiffness=np.zeros(0),
        obstacles=(Box((0.0, 0.0), (1.0, 0.0005)),),
    )
    simulation = find("mujoco_tendons").start(system, 1e-3)
    for _ in range(200):
        simulation.step()
    return 0.0005 - float(simulation.state()[0][0, 1])


def test_beads_are_small_beside_the_thinnest_side_of_a_box() -> None:
    """The box is smaller by their radius: it must be left. At rest a mass is less than a tenth of the height deep."""
    assert abs(float(isolated(depth_in_a_thin_box))) < 1e-4  # type: ignore[arg-type]
