"""Bullet's deformable mass-spring body: cloth, solids, and by a device of our own (`bullet_mesh`) any plane mesh."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from engines.bullet.mesh import APEX, apex_height, bending_apart, mesh_of
from engines.bullet.obstacles import add_obstacles
from engines.bullet.rest_shape import rest_shape
from engines.bullet.world import World
from engines.engine import Unsupported, changed, refuse_beyond
from reference.obstacles import Sphere
from reference.state import Array
from reference.system import MassSpringSystem, Value


@dataclass(frozen=True)
class BulletSoftbody:
    """A soft body in Bullet's deformable world, its springs integrated explicitly (Bullet's default)."""

    #: As pyproject.toml has it.
    where_it_comes: ClassVar[str] = (
        "it comes along with Python 3.11 on Linux only; elsewhere `pip install 'springlab[bullet]'` compiles it"
    )

    name: str = "bullet_softbody"
    package: str = "pybullet"
    settings: Mapping[str, object] = field(default_factory=lambda: {"world": "deformable", "apex": APEX})
    capabilities: frozenset[str] = frozenset(
        {
            "1d",
            "2d",
            "3d",
            "mesh",
            "rest_lengths",
            "stretched",
            "velocities",
            "damping",
            "drag",
            "tilted gravity",
            "no fixed mass",
            "circle",
            "plane",
        }
    )
    identified_as: Mapping[str, str] = field(
        default_factory=lambda: {"plain": "kick_drift", "damping": "kick_drift_truncated_damping", "drag": "kick_drift"}
    )
    semantics: str = (
        "stiffness is k [N/m]; damping is c [N s/m], implicit, solved until the preconditioned residual is below "
        "1e-8 m/s; drag: Bullet has none, dt Cd/m v is taken off the velocities v before each step"
    )

    def start(self, system: MassSpringSystem, dt: float) -> SoftBody:
        """The system as a soft body, ready for its first step.

        Beyond the capabilities, springs of two stiffnesses are taken where the one kind are sides of triangles and the
        other Bullet's springs for bending; and spheres where there is no apex.

        Raises:
            Unsupported: for springs that Bullet has no mesh for, and for springs without stiffness.
        """
        refuse_beyond(self, _without_what_this_mesh_can(system))
        return SoftBody(self, system, dt)


def _without_what_this_mesh_can(system: MassSpringSystem) -> MassSpringSystem:
    asked = system
    if bending_apart(system) is not None:
        asked = system.with_parameter("stiffness", float(system.stiffness[0]))
    if any(isinstance(obstacle, Sphere) for obstacle in system.obstacles) and not mesh_of(system).has_apex:
        others = tuple(obstacle for obstacle in system.obstacles if not isinstance(obstacle, Sphere))
        asked = replace(asked, obstacles=others)
    return asked


class SoftBody:
    """One system in a Bullet world of its own: a Simulation.

    Args:
        system: masses alike on springs that Bullet has a mesh for.
        dt: step [s].
    """

    def __init__(self, engine: BulletSoftbody, system: MassSpringSystem, dt: float) -> None:
        self._engine, self._dt = engine, dt
        self._system = system
        self._rest = in_space(system.positions)
        self._world = World()
        self._build(system)

    def step(self) -> None:
        """Let Bullet advance by dt, after taking off what drag costs the velocities."""
        if self._drag:
            velocities = self._world.velocities(self._body)
            self._world.set_velocities(self._body, velocities - self._drag * velocities)
        self._world.step()

    def bare_step(self) -> Callable[[], object]:
        """The world's step, without what drag takes off."""
        return self._world.bare_step()

    def state(self) -> tuple[Array, Array]:
        """Positions [m] and velocities [m/s], each (n, d)."""
        n, d = self._system.positions.shape
        return (
            self._world.positions(self._body)[:n, :d].copy(),
            self._world.velocities(self._body)[:n, :d].copy(),
        )

    def change(self, parameter: str, value: Value) -> None:
        """Set a parameter on the fly.

        Bullet changes gravity while the world runs, but no property of a soft body: for those the world is built anew
        around the positions and velocities there are. A step depends on nothing else, so nothing is lost.

        Raises:
            Unsupported: beyond the capabilities, for stiffness 0, and for what there is no mesh for.
        """
        system = changed(self._engine, self._system, parameter, value)
        if parameter == "gravity":
            self._system = system
            self._world.set_gravity(in_space(system.gravity))
            return
        refuse_beyond(self._engine, _without_what_this_mesh_can(system))
        positions, velocities = self.state()
        self._build(replace(system, positions=positions, velocities=velocities))

    def _build(self, system: MassSpringSystem) -> None:
        """An empty world, the mesh, its rest lengths, and then the start.

        Bullet measures the rest lengths in its first step, from the positions it finds then.
        """
        mesh = mesh_of(system)
        if mesh.stiffness == 0:
            raise Unsupported("bullet_softbody cannot do stiffness 0: Bullet then leaves out the damping too")
        if mesh.has_apex and system.dimension == 3 and system.obstacles:
            # an obstacle meets the triangles to the apex too
            raise Unsupported(
                "bullet_softbody cannot do obstacles in three dimensions unless triangles of springs, side by side, "
                "have all springs for sides"
            )
        self._rest = rest_shape(system, self._rest)
        self._system = system
        # All nodes of a soft body have the same mass, whatever becomes of the pinned ones.
        mass = float(system.masses[np.argmin(system.fixed)])
        self._drag = self._dt * system.drag / mass
        self._world.reset(self._dt)
        apex = np.zeros((int(mesh.has_apex), 3))
        apex[:, 2] = apex_height(system)
        nodes = mesh.nodes + len(apex)
        self._body = self._world.load(mesh.obj(), nodes * mass, mesh.stiffness, system.damping[0], mesh.bending)
        for pinned in [*np.flatnonzero(system.fixed).tolist(), *range(mesh.nodes, nodes)]:
            self._world.pin(self._body, pinned)
        self._world.set_positions(self._body, np.vstack([self._rest, apex]))
        self._world.step()
        self._world.set_positions(self._body, np.vstack([in_space(system.positions), apex]))
        self._world.set_velocities(self._body, np.vstack([in_space(system.velocities), 0 * apex]))
        add_obstacles(self._world, system)
        self._world.set_gravity(in_space(system.gravity))


def in_space(vectors: Array) -> Array:
    """Vectors of the plane as vectors in space, and those in space as they are: shape (..., 3)."""
    return np.concatenate([vectors, np.zeros((*vectors.shape[:-1], 3 - vectors.shape[-1]))], axis=-1)


ENGINES = (BulletSoftbody(),)
