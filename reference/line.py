"""A line in the plane: what moves along one axis, as the same motion up and down the second of two.

Engines know the plane or space, and so do pictures: both are given systems along a line by these functions. The motion
is the same to the bit: what a spring across the line would do is zero times a number, and stays zero.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from reference.obstacles import Obstacle, Plane
from reference.pulls import is_pull
from reference.state import Array, Trajectory
from reference.system import MassSpringSystem, Value


def in_plane(vectors: Array) -> Array:
    """Vectors along a line, shape (..., 1), as vectors up and down the plane, shape (..., 2); others as they are."""
    if vectors.shape[-1] != 1:
        return vectors
    return np.concatenate([np.zeros_like(vectors), vectors], axis=-1)


def on_line(vectors: Array) -> Array:
    """The reverse: of vectors of the plane, shape (..., 2), what is up and down, shape (..., 1), as a new array."""
    return vectors[..., 1:].copy()


def system_in_plane(system: MassSpringSystem) -> MassSpringSystem:
    """A system along a line as the same system in the plane; others as they are."""
    if system.dimension != 1:
        return system
    return replace(
        system,
        positions=in_plane(system.positions),
        velocities=in_plane(system.velocities),
        gravity=in_plane(system.gravity),
        pulls=in_plane(system.pulls),
        obstacles=tuple(map(obstacle_in_plane, system.obstacles)),
    )


def is_vertical(system: MassSpringSystem) -> bool:
    """Whether a system of the plane stays on a vertical line, as what is along a line does there."""
    sideways = (system.velocities[:, 0], system.gravity[:1], system.pulls[..., 0])
    return bool(np.ptp(system.positions[:, 0]) == 0) and not system.obstacles and not any(q.any() for q in sideways)


def system_on_line(system: MassSpringSystem) -> MassSpringSystem:
    """The reverse: of a system of the plane without obstacles, what is up and down."""
    return replace(
        system,
        positions=on_line(system.positions),
        velocities=on_line(system.velocities),
        gravity=on_line(system.gravity),
        pulls=on_line(system.pulls),
    )


def trajectory_on_line(trajectory: Trajectory) -> Trajectory:
    """Of a trajectory in the plane, what is up and down."""
    return Trajectory(trajectory.times, on_line(trajectory.positions), on_line(trajectory.velocities))


def obstacle_in_plane(obstacle: Obstacle) -> Obstacle:
    """An obstacle on a line, which is a plane across it, as the same across the plane; others as they are."""
    if not isinstance(obstacle, Plane) or obstacle.dimension != 1:
        return obstacle
    return Plane((0.0, *obstacle.point), (0.0, *obstacle.normal))


def parameter_in_plane(parameter: str) -> str:
    """The name of a parameter of a system along a line, for the same system in the plane: pulls are along y there."""
    return f"{parameter[:-1]}y" if is_pull(parameter) and parameter.endswith(".x") else parameter


def value_in_plane(parameter: str, value: Value) -> Value:
    """What a parameter of a system along a line is set to, for the same system in the plane.

    One number of gravity is downwards there as here; a list of one is along the axis.
    """
    if parameter == "gravity" and not isinstance(value, int | float):
        return (0.0, *value)
    return value
