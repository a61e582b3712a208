"""Masses that collide, in the engines that have it: as a scheme until they touch, and what comes of it, measured."""

from __future__ import annotations

import numpy as np
import pytest

from engines.engine import find, registry
from engines.process.isolation import run_engine
from reference.collisions.round_masses import Collisions
from reference.stepper import stepper_named
from reference.system import MassSpringSystem

ABLE = [engine for engine in registry().values() if "collisions" in engine.capabilities]

DT = 1e-3


def two(restitution: float) -> MassSpringSystem:
    """Two of 1 and 3 kg on soft springs to where each began, 1 m apart, that meet head on at 2 and 1 m/s."""
    return MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [2.0, 0.0]]),
        springs=np.array([[0, 2], [1, 3]]),
        masses=np.array([1.0, 3.0, 1.0, 1.0]),
        rest_lengths=np.array(1.0),
        stiffness=np.array(0.1),
        gravity=np.zeros(2),
        velocities=np.array([[2.0, 0.0], [-1.0, 0.0], [0.0, 0.0], [0.0, 0.0]]),
        fixed=np.array([False, False, True, True]),
        collisions=Collisions(np.array([0.1, 0.2, 0.1, 0.1]), restitution),
    )


@pytest.mark.parametrize("name", [engine.name for engine in ABLE])
@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_until_they_touch_they_step_as_the_scheme_and_then_part_alike(name: str, restitution: float) -> None:
    """To 1e-13 m before; afterwards the speeds at 0.4 s are those of the law of impact, within what was measured.

    Pymunk's impulses are exact, so to 1 % (its step is another); MuJoCo's soft contacts leave a twentieth of the speed.
    Momentum is that of the reference to as much.
    """
    engine = find(name)
    outcome = run_engine(engine, two(restitution), DT, 400)
    right = stepper_named(engine.identified_as["plain"]).run(two(restitution), DT, 400).trajectory
    if restitution and "restitution" not in engine.capabilities:
        assert (outcome.ending, "bounce" in outcome.reason) == ("unsupported", True)
        return
    run = outcome.trajectory
    assert run is not None
    assert right is not None
    met = int(np.argmax(np.abs(np.diff(right.velocities[:, 0, 0])) > 0.1))
    assert np.abs(run.positions - right.positions)[: met - 1].max() < 1e-13
    within = 0.01 if "restitution" in engine.capabilities else 0.15
    assert run.velocities[-1, :2, 0] == pytest.approx(right.velocities[-1, :2, 0], abs=within)
    assert two(0).masses @ run.velocities[-1, :, 0] == pytest.approx(
        two(0).masses @ right.velocities[-1, :, 0], abs=within
    )
