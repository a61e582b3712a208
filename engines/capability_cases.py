"""One system for each thing a system may ask of an engine: what its capabilities are tried with. Needs NumPy only."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from reference.collisions.round_masses import Collisions
from reference.obstacles import Box, Circle, Cylinder, Plane, Sphere
from reference.scenes import find
from reference.springs.kinds import NonlinearSprings
from reference.state import Array
from reference.system import MassSpringSystem

#: Obstacles that nothing comes near in the 200 steps of a case: there an engine is to step as it does without them.
AWAY = (0.6, 1.0, 0.0)
FLOOR, BAR = Plane((0.0, -3.0), (0.0, 1.0)), Cylinder(AWAY, (0.0, 0.0, 1.0), 0.3)
DISC, BALL, BLOCK = Circle(AWAY[:2], 0.3), Sphere(AWAY, 0.3), Box(AWAY[:2], (0.3, 0.2))

#: Every other one of the string's ten springs, from the second on.
_SOME = np.arange(10) % 2 == 1

#: What some springs have besides: in a string whose masses are thrown apart and together all of it comes to bear.
LAWS = {
    "tension_only": NonlinearSprings(tension_only=_SOME),
    "compression_only": NonlinearSprings(compression_only=_SOME),
    "hardening": NonlinearSprings(hardening=np.where(_SOME, 1e6, 0.0)),
    "largest_force": NonlinearSprings(largest_force=np.where(_SOME, 1.0, np.inf)),
    "breaking": NonlinearSprings(breaking_force=np.where(_SOME, 1.0, np.inf)),
}


def for_each_capability() -> Mapping[str, MassSpringSystem]:
    """By each name of engines.engine.CAPABILITIES, a system that asks for it, and for little else."""
    string = find("string").system
    plain, bent = string({}), np.linspace(-0.3, 0.3, 5)
    plain = replace(plain, masses=np.where(plain.fixed, 0.5, plain.masses))  # what is held has no say
    thrown = 0.5 * np.random.default_rng(0).normal(size=plain.positions.shape) * ~plain.fixed[:, None]
    off_the_plane = np.outer(0.125 * np.arange(11), [0.6, 0.0, 0.8])
    triangles = MassSpringSystem(
        positions=0.125 * np.array([[0, 0], [1, 0], [0.5, -(3**0.5) / 2], [1.5, -(3**0.5) / 2]]),
        springs=np.array([[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]),
        masses=np.array(0.02),
        rest_lengths=np.array(0.125),
        stiffness=np.array(200.0),
        fixed=np.array([True, False, False, False]),
    )
    in_space = replace(plain, positions=off_the_plane, velocities=np.zeros(1), gravity=np.array(9.81))
    return {
        "1d": find("chain").system({}),
        "2d": plain,
        "3d": in_space,
        "mesh": triangles,
        "masses": string({"masses": 3, "mass": "0.02,0.01,0.03"}),
        "rest_lengths": string({"masses": 3, "rest_length": "0.1,0.15,0.125"}),
        "stiffnesses": string({"masses": 3, "stiffness": "200,150,250"}),
        "dampings": string({"masses": 3, "damping": "0.1,0,0.2"}),
        "stretched": chain(bent, 0.125, stretch=[1.02, 0.99, 1.05, 0.97, 1.0]),
        "velocities": chain(bent, 0.125, velocities=swinging(bent, 0.125, [1.0, -2.0, 0.5, 0.0, 3.0])),
        "damping": string({"damping": 0.1}),
        "drag": string({"drag": 0.02}),
        "tilted gravity": replace(plain, gravity=np.array([3.0, -9.0])),
        "no fixed mass": replace(triangles, fixed=np.zeros(4, dtype=bool)),
        "no rest length": replace(plain, rest_lengths=np.array(0.0), stiffness=np.array(20.0)),
        "pulls": replace(plain, pulls=0.1 * thrown),
        "angular springs": string({"angular_stiffness": 0.02}),
        "collisions": replace(plain, collisions=Collisions(np.array(0.03))),
        "restitution": replace(plain, collisions=Collisions(np.array(0.03), 0.5)),
        **{name: replace(plain, velocities=thrown, nonlinear=law) for name, law in LAWS.items()},
        **{obstacle.kind: replace(plain, obstacles=(obstacle,)) for obstacle in (DISC, FLOOR, BLOCK)},
        **{obstacle.kind: replace(in_space, obstacles=(obstacle,)) for obstacle in (BALL, BAR)},
    }


def chain(
    angles: npt.ArrayLike,
    lengths: npt.ArrayLike,
    *,
    mass: npt.ArrayLike = 0.02,
    stiffness: npt.ArrayLike = 200.0,
    damping: npt.ArrayLike = 0.0,
    drag: float = 0.0,
    gravity: npt.ArrayLike = 9.81,
    stretch: npt.ArrayLike = 1.0,
    velocities: npt.ArrayLike = 0.0,
) -> MassSpringSystem:
    """A string in the plane, hung at its first mass.

    Args:
        angles: of the links from the first axis [rad], shape (n,).
        lengths: rest lengths [m], one or (n,).
        mass: of the masses after the first [kg], one or (n,).
        stretch: length at the start in rest lengths, one or (n,).
        velocities: of the masses after the first [m/s], one or (n, 2).
    """
    directions = np.column_stack([np.cos(angles), np.sin(angles)])
    n = len(directions)
    reach = np.vstack([np.zeros(2), np.cumsum(directions * np.reshape(np.multiply(lengths, stretch), (-1, 1)), axis=0)])
    masses = np.broadcast_to(mass, n)
    return MassSpringSystem(
        positions=reach,
        velocities=np.vstack([np.zeros(2), np.broadcast_to(velocities, (n, 2))]),
        springs=np.column_stack([np.arange(n), np.arange(1, n + 1)]),
        masses=np.concatenate([masses[:1], masses]),
        rest_lengths=np.asarray(lengths, dtype=float),
        stiffness=np.asarray(stiffness, dtype=float),
        damping=np.asarray(damping, dtype=float),
        drag=drag,
        gravity=np.asarray(gravity, dtype=float),
        fixed=np.arange(n + 1) == 0,
    )


def swinging(angles: Array, lengths: npt.ArrayLike, rates: npt.ArrayLike) -> Array:
    """The velocities [m/s] of masses whose links turn at these rates [rad/s]: they stretch no spring. Shape (n, 2)."""
    across = np.column_stack([-np.sin(angles), np.cos(angles)])
    return np.cumsum(across * np.reshape(np.multiply(lengths, rates), (-1, 1)), axis=0)
