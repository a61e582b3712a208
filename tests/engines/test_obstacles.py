"""What engines make of contacts, by measurement: the facts that the adapters' settings rest on."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from engines.engine import find, version
from engines.mujoco import obstacles as mujoco_obstacles
from engines.process.isolation import EngineStepper, isolated
from reference.obstacles import Circle
from reference.system import MassSpringSystem
from tests.conformance.test_obstacles import KINDS, STEPS, falling

DT = 1e-3


def bounce(first: float, second: float) -> float:
    """Pymunk: how much of its speed a body is thrown back with by a shape, their elasticities being these."""
    import pymunk

    space = pymunk.Space()
    space.collision_slop = space.collision_bias = 0.0
    body = pymunk.Body(0.02, float("inf"))
    body.position, body.velocity = (0.0, 1.01), (0.0, -2.0)
    point, circle = pymunk.Circle(body, 0.0), pymunk.Circle(space.static_body, 1.0)
    point.elasticity, circle.elasticity = first, second
    space.add(body, point, circle)
    for _ in range(20):
        space.step(DT)
    return float(body.velocity.y / 2.0)


def overlap(slop: float | None) -> float:
    """Pymunk: how deep [m] a mass that rests on a circle of 1 m is in it after 2 s."""
    import pymunk

    space = pymunk.Space()
    space.gravity = (0.0, -9.81)
    if slop is not None:
        space.collision_slop, space.collision_bias = slop, 0.0
    body = pymunk.Body(0.02, float("inf"))
    body.position = (0.0, 1.01)
    space.add(body, pymunk.Circle(body, 0.0), pymunk.Circle(space.static_body, 1.0))
    for _ in range(2000):
        space.step(DT)
    return float(1.0 - body.position.y)


@pytest.mark.skipif(version(find("pymunk_springs")) is None, reason="pymunk is not installed")
def test_pymunk_multiplies_elasticities() -> None:
    """Restitution is their product: 0 unless both are set, which the adapter does not."""
    for first, second in ((0.0, 0.0), (1.0, 0.0), (0.8, 0.5), (1.0, 1.0)):
        assert isolated(bounce, first, second) == pytest.approx(first * second, abs=1e-12)


@pytest.mark.skipif(version(find("pymunk_springs")) is None, reason="pymunk is not installed")
def test_pymunk_leaves_masses_inside_unless_told() -> None:
    """By its default slop a mass stays as deep as it came, up to v dt; without slop it is out, but for g dt^2."""
    left, out = isolated(overlap, None), isolated(overlap, 0.0)
    assert isinstance(left, float)
    assert isinstance(out, float)
    assert 0.1 * np.sqrt(2 * 9.81 * 0.01) * DT < left < np.sqrt(2 * 9.81 * 0.01) * DT
    assert abs(out) <= 1.01 * 9.81 * DT**2 < left


def rebound(damping: float) -> float:
    """MuJoCo: with how much of the speed that it came with a mass leaves a plane, at a damping ratio."""
    mujoco_obstacles.DAMPING = damping
    case = falling(KINDS["plane"], 0.0)
    simulation = find("mujoco_tendons").start(case.system, case.dt)
    up = 0.0
    for _ in range(STEPS):
        simulation.step()
        up = max(up, float(simulation.state()[1][-1, 1]))
    return up / float(np.sqrt(2 * 9.81 * 0.2))


@pytest.mark.skipif(version(find("mujoco_tendons")) is None, reason="mujoco is not installed")
def test_mujoco_throws_back_less_the_more_it_is_damped() -> None:
    """A mass comes at most v dt deep and is pushed out at r/(4 z^2 dt): at most v/(4 z^2), z the damping ratio."""
    found = [float(isolated(rebound, z)) for z in (1.0, 2.0, 4.0)]  # type: ignore[arg-type]
    for back, z in zip(found, (1.0, 2.0, 4.0), strict=True):
        assert 0.1 / (4 * z**2) <= back <= 1.02 / (4 * z**2)
    assert mujoco_obstacles.DAMPING == 2.0


def through(anchor: float) -> Any:
    """Bullet: how deep [m] a mass gets that slides on a circle of 1 m, a spring without pull leading to an anchor."""
    place = np.array([np.sin(0.2), np.cos(0.2)])
    system = MassSpringSystem(
        positions=np.array([[0.0, anchor], place]),
        springs=np.array([[0, 1]]),
        masses=np.array(0.02),
        rest_lengths=np.array(np.linalg.norm(place - [0.0, anchor])),
        stiffness=np.array(1e-9),
        fixed=np.array([True, False]),
        obstacles=(Circle((0.0, 0.0), 1.0),),
    )
    simulation = find("bullet_softbody").start(system, DT)
    deepest = 0.0
    for _ in range(300):
        simulation.step()
        deepest = max(deepest, 1.0 - float(np.linalg.norm(simulation.state()[0][1])))
    return deepest


@pytest.mark.skipif(version(find("bullet_softbody")) is None, reason="pybullet is not installed")
def test_bullet_is_exact_on_a_sphere_but_for_springs_that_cut_it() -> None:
    """From above to 1e-12 m. A spring that runs through the sphere meets it too, and its masses are thrown about."""
    assert isolated(through, 4.0) <= 1e-12
    assert isolated(through, -3.0) >= 0.1


@pytest.mark.skipif(version(find("bullet_softbody")) is None, reason="pybullet is not installed")
def test_bullet_refuses_a_circle_within_its_margin() -> None:
    """With the reason."""
    case = falling(Circle((0.0, -0.01), 0.01), 0.0)
    outcome = EngineStepper(find("bullet_softbody")).run(case.system, case.dt, 1)
    assert (outcome.ending, "margin" in outcome.reason) == ("unsupported", True)
