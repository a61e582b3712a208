"""Obstacles in Pymunk: static shapes without friction or rebound, and a point around each free mass that meets them.

And circles around masses that collide with one another.

Chipmunk leaves a shape `Space.collision_slop` inside another, 0.1 m by default, which is as long as a spring here; and
takes what is deeper out over some steps, by velocities that do not count as motion. Here there is no slop, and one step
takes out all.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from reference.obstacles import Box, Circle, Obstacle, Plane
from reference.system import MassSpringSystem

#: A plane is a bar, round at its ends, whose upper side is the plane: its length and its thickness in sizes of the
#: system and of its distance from the plane's point.
LONG = 1e3

#: Of shapes in one group, none meets another; and shapes of one category meet those of the same only.
MASSES = 1
OBSTACLE, BALL = 0b01, 0b10


def add_obstacles(pymunk: Any, space: Any, system: MassSpringSystem, bodies: Sequence[Any]) -> None:
    """The shapes, where a system has obstacles.

    Args:
        bodies: of the free masses.
    """
    if not system.obstacles:
        return
    space.collision_slop = 0.0
    space.collision_bias = 0.0  # what is left of an overlap after a second
    points = [pymunk.Circle(body, 0.0) for body in bodies]
    for point in points:
        point.filter = pymunk.ShapeFilter(MASSES, OBSTACLE, OBSTACLE)
    shapes = [_shape(pymunk, space.static_body, obstacle, system) for obstacle in system.obstacles]
    for shape in shapes:
        shape.filter = pymunk.ShapeFilter(0, OBSTACLE, OBSTACLE)
    space.add(*points, *shapes)


def add_balls(pymunk: Any, space: Any, system: MassSpringSystem, bodies: Sequence[Any]) -> None:
    """A circle around every mass that collides, fixed ones too; elasticity is the product of those of the two."""
    if system.collisions is None:
        return
    space.collision_slop = space.collision_bias = 0.0
    for body, radius in zip(bodies, system.collisions.radii.tolist(), strict=True):
        if radius > 0:
            ball = pymunk.Circle(body, radius)
            ball.elasticity = system.collisions.restitution**0.5
            ball.filter = pymunk.ShapeFilter(0, BALL, BALL)
            space.add(ball)


def _shape(pymunk: Any, ground: Any, obstacle: Obstacle, system: MassSpringSystem) -> Any:
    """Elasticity and friction of a contact are the products of those of its shapes, and 0 where they are not set."""
    if isinstance(obstacle, Circle):
        return pymunk.Circle(ground, obstacle.radius, obstacle.centre)
    if isinstance(obstacle, Box):
        (x, y), (w, h) = obstacle.centre, obstacle.half_sizes
        return pymunk.Poly(ground, [(x - w, y - h), (x + w, y - h), (x + w, y + h), (x - w, y + h)])
    assert isinstance(obstacle, Plane)
    point, normal = np.array(obstacle.point), np.array(obstacle.normal)
    reach = LONG * (system.size + float(np.abs(system.positions - point).max()))
    middle, along = point - reach * normal, reach * np.array([-normal[1], normal[0]])
    return pymunk.Segment(ground, tuple((middle - along).tolist()), tuple((middle + along).tolist()), reach)
