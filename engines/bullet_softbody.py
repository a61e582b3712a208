"""Bullet's deformable mass-spring body as a chain of springs in the plane.

Bullet takes its springs from the edges of a mesh of triangles, and a chain has no triangles. So each link of the chain
gets one, with a common third corner: an apex, pinned at a great height above the plane. The springs to the apex stand
upright on the plane and pull on nothing that moves in it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from engines.bullet_world import World
from engines.engine import Unsupported, refuse_beyond
from reference.state import Array
from reference.system import MassSpringSystem

#: Height of the apex over the plane, in lengths of the chain. From 2^27 on, the length of a spring to the apex is the
#: height, whatever mass hangs on it wherever: the rest is lost in rounding. With a power of two for the height, the
#: direction times the length is exact too, and the spring pulls with exactly no force.
APEX = 2.0**40


@dataclass(frozen=True)
class BulletSoftbody:
    """A soft body in Bullet's deformable world, its springs integrated explicitly (Bullet's default)."""

    name: str = "bullet_softbody"
    package: str = "pybullet"
    settings: Mapping[str, object] = field(default_factory=lambda: {"world": "deformable", "apex": APEX})
    capabilities: frozenset[str] = frozenset(
        {"rest_lengths", "stretched", "velocities", "damping", "drag", "tilted gravity"}
    )
    identified_as: Mapping[str, str] = field(
        default_factory=lambda: {"plain": "kick_drift", "damping": "kick_drift_truncated_damping", "drag": "kick_drift"}
    )
    semantics: str = (
        "stiffness is k [N/m]; damping is c [N s/m], implicit, solved until the preconditioned residual is below "
        "1e-8 m/s; drag: Bullet has none, dt Cd/m v is taken off the velocities v before each step"
    )

    def start(self, system: MassSpringSystem, dt: float) -> SoftString:
        """The chain as a soft body, ready for its first step.

        Raises:
            Unsupported: for anything but a chain in the plane, and for one without stiffness.
        """
        refuse_beyond(self, system)
        return SoftString(system, dt)


class SoftString:
    """One chain in a Bullet world of its own: a Simulation.

    Args:
        system: a chain in the plane.
        dt: step [s].
    """

    def __init__(self, system: MassSpringSystem, dt: float) -> None:
        self._dt = dt
        self._system = system
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
        """Positions [m] and velocities [m/s], each (n, 2)."""
        return (
            self._world.positions(self._body)[:-1, :2].copy(),
            self._world.velocities(self._body)[:-1, :2].copy(),
        )

    def change(self, parameter: str, value: float) -> None:
        """Set a parameter on the fly.

        Bullet changes gravity while the world runs, but no property of a soft body: for those the world is built anew
        around the positions and velocities there are. A step depends on nothing else, so nothing is lost.

        Raises:
            Unsupported: for stiffness 0.
        """
        system = self._system.with_parameter(parameter, value)
        if parameter == "gravity":
            self._system = system
            self._world.set_gravity(system.gravity)
            return
        positions, velocities = self.state()
        self._build(replace(system, positions=positions, velocities=velocities))

    def _build(self, system: MassSpringSystem) -> None:
        """An empty world, the mesh, its rest lengths, and then the start.

        Bullet measures the rest lengths in its first step, from the positions it finds then.
        """
        if system.stiffness[0] == 0:
            raise Unsupported("bullet_softbody cannot do stiffness 0: Bullet then leaves out the damping too")
        self._system = system
        self._drag = self._dt * system.drag / system.masses[-1]
        self._world.reset(self._dt)
        n = len(system.masses)
        # All nodes of a soft body have the same mass, whatever becomes of the pinned ones.
        total_mass = (n + 1) * system.masses[-1]
        self._body = self._world.load(mesh(n), total_mass, system.stiffness[0], system.damping[0])
        for pinned in (0, n):
            self._world.pin(self._body, pinned)
        apex = np.array([0.0, 0.0, apex_height(system)])
        self._world.set_positions(self._body, np.vstack([rest_positions(system), apex]))
        self._world.step()
        self._world.set_positions(self._body, np.vstack([np.pad(system.positions, ((0, 0), (0, 1))), apex]))
        self._world.set_velocities(self._body, np.pad(system.velocities, ((0, 1), (0, 1))))
        self._world.set_gravity(system.gravity)


def mesh(n: int) -> str:
    """A mesh of n nodes and an apex, one triangle per link, in the text format OBJ.

    Where the nodes are does not matter yet, except that Bullet crashes on a triangle without area.
    """
    corners = [f"v {i} 0 0" for i in range(n)] + ["v 0 0 1"]
    triangles = [f"f {i} {i + 1} {n + 1}" for i in range(1, n)]
    return "\n".join(corners + triangles) + "\n"


def rest_positions(system: MassSpringSystem) -> Array:
    """The chain with every spring at its rest length, folded on itself, from the origin: shape (n, 3) [m].

    Folded, because 0, L, 0, L, ... are exactly L apart and 0, L, 2 L, 3 L, ... only to rounding.
    """
    there_and_back = np.where(np.arange(len(system.rest_lengths)) % 2 == 0, 1.0, -1.0)
    positions = np.zeros((len(system.positions), 3))
    positions[1:, 0] = np.cumsum(there_and_back * system.rest_lengths)
    return positions


def apex_height(system: MassSpringSystem) -> float:
    """APEX times a length the chain keeps within, to the next power of two [m]."""
    reach = float(np.abs(system.positions).max() + system.rest_lengths.sum())
    return float(2.0 ** np.ceil(np.log2(APEX * reach)))


ENGINES = (BulletSoftbody(),)
