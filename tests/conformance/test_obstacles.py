"""An engine that takes an obstacle holds masses out of it, without friction and without throwing them back."""

from __future__ import annotations

import numpy as np
import pytest

from engines.engine import Engine
from reference.obstacles import Box, Circle, Cylinder, Obstacle, Plane, Sphere
from reference.outcome import Outcome
from reference.system import MassSpringSystem
from tests.conformance import doctored
from tests.conformance.case import Case
from tests.conformance.checks import require
from tests.conformance.doctored import Doctored
from tests.conformance.runs import outcome_of

#: Each with its top at the origin; the cylinder lies along the first axis, in which the mass moves.
KINDS: dict[str, Obstacle] = {
    "circle": Circle((0.0, -0.5), 0.5),
    "sphere": Sphere((0.0, -0.5, 0.0), 0.5),
    "cylinder": Cylinder((0.0, -0.5, 0.0), (1.0, 0.0, 0.0), 0.5),
    "plane": Plane((0.0, 0.0), (0.0, 1.0)),
    "plane in space": Plane((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    "box": Box((0.0, -0.25), (0.5, 0.25)),
    "box in space": Box((0.0, -0.25, 0.0), (0.5, 0.25, 0.4)),
}

DT, HEIGHT, GRAVITY = 1e-3, 0.2, 9.81

#: It falls in 0.2 s, and is watched for as long again.
STEPS = 400


def falling(obstacle: Obstacle, along: float) -> Case:
    """A mass falls from HEIGHT on an obstacle, with a velocity along it [m/s], on springs without force from above.

    In the plane it is a string of one spring. In space it is a triangle, as some engines take no other mesh there.
    """
    d = obstacle.dimension
    positions, velocities = np.zeros((2, d, d))  # as many masses as axes, the last one free
    positions[:-1, 1], positions[-1, 1] = 4.0, HEIGHT
    positions[:-1, 2:] = np.array([[-1.0], [1.0]])[: d - 1]
    velocities[-1, 0] = along
    springs = np.array([[0, 1], [1, 2], [0, 2]][: 2 * d - 3])
    a, b = springs.T
    system = MassSpringSystem(
        positions=positions,
        velocities=velocities,
        springs=springs,
        masses=np.array(0.02),
        rest_lengths=np.linalg.norm(positions[b] - positions[a], axis=1),
        stiffness=np.array(1e-9),
        fixed=np.arange(d) < d - 1,
        obstacles=(obstacle,),
    )
    return Case(f"falling on {obstacle}", system, DT, STEPS)


def check_stopped(case: Case, outcome: Outcome) -> None:
    """A mass that falls straight down on an obstacle stays on top of it.

    It comes with v = sqrt(2 g H), at most v dt inside, as a step sees it there only once it is. An engine may move it
    out at some speed, which does not count as a rebound as long as it is far below v: a tenth of it.
    """
    assert outcome.trajectory is not None, outcome.reason
    (obstacle,) = case.system.obstacles
    speed = np.sqrt(2 * GRAVITY * HEIGHT)
    distances = obstacle.signed_distances(outcome.trajectory.positions[:, -1])[0][:, 0]
    assert distances.min() >= -1.01 * (speed + GRAVITY * DT) * DT
    after = outcome.trajectory.velocities[STEPS // 2 + 5 :, -1]
    assert np.linalg.norm(after, axis=1).max() <= 0.1 * speed
    assert abs(distances[-1]) <= 1e-3


def check_slides(case: Case, outcome: Outcome) -> None:
    """On a plane, a box, and along a cylinder, it keeps the velocity along: to 1e-6, as the weak spring acts too.

    At 0.5 m/s along, 1e-9 N/m of stiffness and some cm of stretch change it by less than 1e-8 m/s. Bullet's plane is a
    sphere, on which it gets faster by (g/R) x t, R being 1e6 sizes.
    """
    assert outcome.trajectory is not None, outcome.reason
    along = outcome.trajectory.velocities[-1, -1, 0]
    assert along == pytest.approx(case.system.velocities[-1, 0], rel=1e-6)


@pytest.mark.parametrize("kind", KINDS)
def test_a_mass_that_falls_on_an_obstacle_stays_on_it(engine: Engine, kind: str) -> None:
    """Straight from above."""
    obstacle = KINDS[kind]
    require(engine, obstacle.kind)
    if obstacle.dimension == 3:
        require(engine, "3d")
        require(engine, "mesh")
    case = falling(obstacle, 0.0)
    check_stopped(case, outcome_of(engine, case))


@pytest.mark.parametrize("kind", ["plane", "plane in space", "cylinder", "box", "box in space"])
def test_a_mass_slides_without_friction(engine: Engine, kind: str) -> None:
    """Along what is straight."""
    obstacle = KINDS[kind]
    require(engine, obstacle.kind)
    if obstacle.dimension == 3:
        require(engine, "3d")
        require(engine, "mesh")
    case = falling(obstacle, 0.5)
    check_slides(case, outcome_of(engine, case))


@pytest.mark.rotating(5)
@pytest.mark.parametrize("kind", KINDS)
def test_both_checks_pass_the_honest_engine_and_fail_on_liars(kind: str) -> None:
    """One that passes through, one that bounces, one that rubs."""
    still, sliding = falling(KINDS[kind], 0.0), falling(KINDS[kind], 0.5)
    check_stopped(still, outcome_of(Doctored(), still))
    for liar in (doctored.PassesThrough, doctored.Bounces):
        with pytest.raises(AssertionError):
            check_stopped(still, outcome_of(Doctored(liar), still))
    if kind in ("circle", "sphere"):
        return
    check_slides(sliding, outcome_of(Doctored(), sliding))
    with pytest.raises(AssertionError):
        check_slides(sliding, outcome_of(Doctored(doctored.Rubs), sliding))
