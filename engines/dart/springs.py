"""DART with a chain of sliding joints that have springs. Along a line, double precision.

DART has springs in its joints only, none between any two bodies: each mass slides along the line, on the one before it.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from engines.engine import changed, refuse_beyond
from reference.state import Array
from reference.system import MassSpringSystem, Value


@dataclass(frozen=True)
class DartSprings:
    """A prismatic joint for each spring; its coordinate is the spring's length.

    A step of h solves (M + h C + h^2 K) v' = M v + h f(x), then x' = x + h v', with M, C and K of the joints'
    coordinates. Along a line, where springs are linear, that is backward Euler.
    """

    name: str = "dart_springs"
    package: str = "dartpy"
    capabilities: frozenset[str] = frozenset(
        {"1d", "masses", "rest_lengths", "stiffnesses", "dampings", "stretched", "velocities", "damping"}
    )
    settings: Mapping[str, object] = field(default_factory=lambda: {"joint": "PrismaticJoint"})
    identified_as: Mapping[str, str] = field(
        default_factory=lambda: dict.fromkeys(("plain", "damping"), "backward_euler")
    )
    semantics: str = "stiffness is k [N/m] and damping c [N s/m] of each joint, implicit; drag is left out"

    def start(self, system: MassSpringSystem, dt: float) -> DartSimulation:
        """The system as a skeleton. Raises Unsupported beyond the capabilities."""
        refuse_beyond(self, system)
        return DartSimulation(self, system, dt)


class DartSimulation:
    """A world with one skeleton."""

    def __init__(self, engine: DartSprings, system: MassSpringSystem, dt: float) -> None:
        dart: Any = importlib.import_module("dartpy")
        self._dynamics = dart.dynamics
        self._engine, self._system = engine, system
        links = np.diff(system.positions[:, 1])
        self._along = np.where(links < 0, -1.0, 1.0)  # in which direction each joint slides
        self._world = dart.simulation.World()
        self._world.setTimeStep(dt)
        self._skeleton = self._dynamics.Skeleton("string")
        self._pairs: list[tuple[Any, Any]] = []
        for direction in self._along:
            parent = [self._pairs[-1][1]] if self._pairs else []
            joint, body = self._skeleton.createPrismaticJointAndBodyNodePair(*parent)
            joint.setAxis([0.0, direction, 0.0])
            self._pairs.append((joint, body))
        self._write()
        self._skeleton.setPositions(self._along * links)
        self._skeleton.setVelocities(self._along * np.diff(system.velocities[:, 1]))
        self._world.addSkeleton(self._skeleton)

    def step(self) -> None:
        """One World.step."""
        self._world.step()

    def bare_step(self) -> Callable[[], object]:
        """World.step."""
        step: Callable[[], object] = self._world.step
        return step

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities: the sums of the joints' up to each mass."""
        x, v = self._system.positions.copy(), np.zeros_like(self._system.positions)
        x[1:, 1] = x[0, 1] + np.cumsum(self._along * self._skeleton.getPositions())
        v[1:, 1] = np.cumsum(self._along * self._skeleton.getVelocities())
        return x, v

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter it has can change between two steps."""
        self._system = changed(self._engine, self._system, parameter, value)
        self._write()

    def _write(self) -> None:
        system = self._system
        self._world.setGravity([0.0, float(system.gravity[1]), 0.0])
        for j, (joint, body) in enumerate(self._pairs):
            body.setInertia(self._dynamics.Inertia(float(system.masses[j + 1]), np.zeros(3), np.eye(3)))
            joint.setSpringStiffness(0, float(system.stiffness[j]))
            joint.setRestPosition(0, float(system.rest_lengths[j]))
            joint.setDampingCoefficient(0, float(system.damping[j]))


ENGINES = (DartSprings(),)
