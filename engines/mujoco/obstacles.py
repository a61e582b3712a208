"""Obstacles in MuJoCo: geoms of the world, and a bead around each free mass that meets them; and masses that collide.

MuJoCo's contacts are soft: a mass sinks in, and is pushed out over some steps. How soft they are is chosen so that a
step takes the whole velocity across the surface, as the lecture's rule does: with a time constant of 2 dt (the smallest
MuJoCo takes), a damping ratio z and an impedance near 1, the acceleration asked for across is -v/dt - r/(2 z dt)^2,
r < 0 the depth. (MuJoCo documentation, "Solver parameters".) What is left is the speed at which a mass is pushed out.
"""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np

from engines.mujoco.common import OFF
from engines.vectors import three
from reference.obstacles import Box, Circle, Cylinder, Obstacle, Plane, Sphere
from reference.state import Array
from reference.system import MassSpringSystem

#: The radius of a bead, as a part of the system's size or the smallest obstacle's. Obstacles are smaller by it.
BEAD = 1e-3

#: Half the length of a cylinder, in sizes of the system and distances of the cylinder's centre from it.
LONG = 1e3

#: The damping ratio z. At 1, which is MuJoCo's own, a mass that falls on a plane was thrown back with a seventh of the
#: speed it came with; at 2 with less than a twentieth, and it does not lift off.
DAMPING = 2.0

#: The impedance of a contact, the largest there is.
IMPEDANCE = 0.9999

#: Of what is switched off, the parts that contacts need.
NEEDED = ("CONTACT", "CONSTRAINT")


def off(system: MassSpringSystem, disabled: tuple[str, ...] = OFF) -> tuple[str, ...]:
    """What of MuJoCo's step is switched off for a system: contacts too where nothing can meet."""
    meets = bool(system.obstacles) or system.collisions is not None
    return tuple(part for part in disabled if not (meets and part in NEEDED))


def add_obstacles(mujoco: ModuleType, spec: Any, system: MassSpringSystem, dt: float) -> None:
    """The geoms, where a system has obstacles.

    Args:
        spec: whose first bodies are those of the free masses.
    """
    if not system.obstacles:
        return
    bead = BEAD * min([system.size or 1.0, *(_smallest(obstacle) for obstacle in system.obstacles)])
    # of two geoms that meet: no friction, and the parameters of one of them are those of both; what masses are is said
    # elsewhere, but old versions make inertia of their geoms, and refuse too little of it
    common = _soft(bead, dt)
    for body in spec.bodies[1 : 1 + int((~system.fixed).sum())]:
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[bead, 0, 0], contype=1, conaffinity=0, **common)
    for obstacle in system.obstacles:
        shape = _shape(mujoco, obstacle, system, bead)
        spec.worldbody.add_geom(**shape, contype=0, conaffinity=1, **common)


def add_balls(mujoco: ModuleType, spec: Any, system: MassSpringSystem, dt: float) -> None:
    """A sphere around every mass that collides with others, around fixed ones as geoms of the world."""
    if system.collisions is None:
        return
    radii, bodies = system.collisions.radii, iter(spec.bodies[1:])
    common = _soft(BEAD * float(radii.max()), dt) | {
        "contype": 2,
        "conaffinity": 2,
        "type": mujoco.mjtGeom.mjGEOM_SPHERE,
    }
    for radius, fixed, position in zip(radii.tolist(), system.fixed, system.positions, strict=True):
        body = None if fixed else next(bodies)
        if radius > 0 and body is None:
            spec.worldbody.add_geom(**common, size=[radius, 0, 0], pos=three(position))
        elif radius > 0 and body is not None:
            body.add_geom(**common, size=[radius, 0, 0])


def _soft(width: float, dt: float) -> dict[str, Any]:
    """What contacts have in common: no friction, how soft they are, over which width [m] impedance rises."""
    return {"condim": 1, "solref": [2 * dt, DAMPING], "solimp": [IMPEDANCE, IMPEDANCE, width, 0.5, 2.0], "mass": 1.0}


def _shape(mujoco: ModuleType, obstacle: Obstacle, system: MassSpringSystem, bead: float) -> dict[str, Any]:
    if isinstance(obstacle, Circle | Sphere):
        size = [obstacle.radius - bead, 0, 0]
        return {"type": mujoco.mjtGeom.mjGEOM_SPHERE, "size": size, "pos": three(np.array(obstacle.centre))}
    if isinstance(obstacle, Cylinder):
        centre, axis = np.array(obstacle.centre), np.array(obstacle.axis)
        reach = system.size + float(np.abs(system.positions - centre).max())
        ends = np.concatenate([centre - LONG * reach * axis, centre + LONG * reach * axis])
        return {"type": mujoco.mjtGeom.mjGEOM_CAPSULE, "size": [obstacle.radius - bead, 0, 0], "fromto": ends}
    if isinstance(obstacle, Box):
        size = [*(half - bead for half in obstacle.half_sizes), max(obstacle.half_sizes)][:3]
        return {"type": mujoco.mjtGeom.mjGEOM_BOX, "size": size, "pos": three(np.array(obstacle.centre))}
    assert isinstance(obstacle, Plane)
    normal = np.array(three(np.array(obstacle.normal)))
    return {
        "type": mujoco.mjtGeom.mjGEOM_PLANE,
        "size": [0, 0, 1],  # without end
        "pos": three(np.array(obstacle.point)) - bead * normal,
        "quat": _turn(normal),
    }


def _smallest(obstacle: Obstacle) -> float:
    """The radius of an obstacle, or half its smallest side [m]; of a plane, none."""
    if isinstance(obstacle, Box):
        return min(obstacle.half_sizes)
    return float(getattr(obstacle, "radius", np.inf))


def _turn(normal: Array) -> Array:
    """The quaternion that turns the third axis to a unit vector."""
    if normal[2] < -1 + 1e-12:
        return np.array([0.0, 1.0, 0.0, 0.0])
    quaternion = np.array([1 + normal[2], -normal[1], normal[0], 0.0])
    return quaternion / np.linalg.norm(quaternion)
