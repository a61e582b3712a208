"""Obstacles in Bullet: spheres that never move. A circle is a sphere whose centre is in the plane of motion.

Bullet keeps the nodes of a soft body a margin away from other bodies: a sphere here is smaller by that much. It looks
where a node would be after the step, and changes its velocity so that it does not get inside: nothing of the velocity
across the surface is left, whatever restitution is asked for.

Only of spheres does Bullet know exactly how far a node is. Of others it keeps distances on a grid, and of planes none:
on a box nodes were seen to sink by 0.1 m, through a plane by 1 m. So a plane is a sphere too, a very large one.

Not only masses meet them. The triangles between them do too, and in the plane so do the links of a string, whether
Bullet is asked for contacts of faces or not: a spring does not cut across a circle, and one that does at the start has
its masses thrown about.
"""

from __future__ import annotations

import numpy as np

from engines.bullet.world import World
from engines.engine import Unsupported
from reference.obstacles import Circle, Plane, Sphere
from reference.state import Array
from reference.system import MassSpringSystem

#: How far from a body Bullet keeps the nodes of a soft body [m], unless told otherwise.
MARGIN = 0.02

#: The radius of a sphere that stands for a plane, in sizes of the system and of its distance from the plane's point. At
#: a size from the point it is 5e-7 of the size off the plane; rounding of so large a radius is 1e-10 of the size.
LARGE = 1e6


def add_obstacles(world: World, system: MassSpringSystem) -> None:
    """The bodies. Raises Unsupported for a circle or sphere no larger than the margin."""
    for obstacle in system.obstacles:
        if isinstance(obstacle, Plane):
            far = float(np.abs(system.positions - np.array(obstacle.point)).max())
            radius = LARGE * (system.size + far)
            world.add_sphere(_in_space(obstacle.point) - radius * _in_space(obstacle.normal), radius - MARGIN)
            continue
        assert isinstance(obstacle, Circle | Sphere)
        if obstacle.radius <= MARGIN:
            raise Unsupported(f"radius = {obstacle.radius:g} m: Bullet's margin about a {obstacle.kind} is {MARGIN} m")
        world.add_sphere(_in_space(obstacle.centre), obstacle.radius - MARGIN)


def _in_space(vector: tuple[float, ...]) -> Array:
    return np.array([*vector, 0.0])[:3]
