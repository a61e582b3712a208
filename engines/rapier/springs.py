"""Rapier with its spring joints between bodies that cannot turn. 2D and 3D, single precision."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from engines.engine import LINEAR_SPRINGS, Precision, changed, refuse_beyond
from engines.vectors import three
from reference.state import Array
from reference.system import MassSpringSystem, Value

#: Rapier cuts speeds at 400 m/s; here it is told not to.
FASTEST = 1e9

#: Rapier's default.
SUBSTEPS = 4


@dataclass(frozen=True)
class RapierSprings:
    """Bodies joined by spring joints; every sub-step begins from no impulse.

    Attributes:
        substeps: in a step (`num_solver_iterations`).
    """

    name: str = "rapier_springs"
    substeps: int = SUBSTEPS
    package: str = "rapier3d"
    precision: Precision = "single"
    capabilities: frozenset[str] = LINEAR_SPRINGS

    @property
    def identified_as(self) -> Mapping[str, str]:
        """Soft constraints without a warm start."""
        substeps = "" if self.substeps == SUBSTEPS else f", substeps={self.substeps}"
        return dict.fromkeys(("plain", "damping", "drag"), f"soft_constraints_cold(single=True{substeps})")

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen."""
        return {"num_solver_iterations": self.substeps, "locked_axes": "ROTATION_LOCKED", "can_sleep": False}

    @property
    def semantics(self) -> str:
        """What its numbers mean."""
        return (
            "stiffness is k [N/m] and damping c [N s/m] of each spring joint, implicit; one mass is stepped by "
            "backward Euler in each sub-step; drag is linear_damping Cd/m, implicit, once a step"
        )

    def start(self, system: MassSpringSystem, dt: float) -> RapierSimulation:
        """The system as bodies and joints. Raises Unsupported beyond the capabilities."""
        refuse_beyond(self, system)
        return RapierSimulation(self, system, dt)


class RapierSimulation:
    """A world with a body for each mass."""

    def __init__(self, engine: RapierSprings, system: MassSpringSystem, dt: float) -> None:
        self._rapier: Any = importlib.import_module("rapier3d")
        self._engine, self._system, self._dt = engine, system, dt
        self._begin()

    def step(self) -> None:
        """One PhysicsWorld.step."""
        self._world.step()

    def bare_step(self) -> Callable[[], object]:
        """PhysicsWorld.step."""
        step: Callable[[], object] = self._world.step
        return step

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities, body by body."""
        bodies = [self._world.rigid_bodies.get(handle) for handle in self._bodies]
        d = self._system.dimension
        x = np.array([tuple(body.translation)[:d] for body in bodies], dtype=float)
        v = np.array([tuple(body.linvel)[:d] for body in bodies], dtype=float)
        return x, v

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter can change between two steps: a new world goes on from here, as nothing else is kept."""
        system = changed(self._engine, self._system, parameter, value)
        x, v = self.state()
        self._system = replace(system, positions=np.where(system.fixed[:, None], system.positions, x), velocities=v)
        self._begin()

    def _begin(self) -> None:
        rapier, system = self._rapier, self._system
        self._world = rapier.PhysicsWorld(gravity=three(system.gravity))
        parameters = self._world.integration_parameters
        parameters.dt, parameters.num_solver_iterations = self._dt, self._engine.substeps
        parameters.normalized_max_linear_velocity = FASTEST
        self._bodies = [self._world.add_body(self._body(i).build()) for i in range(len(system.masses))]
        for j, (a, b) in enumerate(system.springs.tolist()):
            if not (system.fixed[a] and system.fixed[b]):
                numbers = (float(q[j]) for q in (system.rest_lengths, system.stiffness, system.damping))
                joint = rapier.SpringJointBuilder(*numbers).build()
                self._world.impulse_joints.insert(self._bodies[a], self._bodies[b], joint, True)

    def _body(self, i: int) -> Any:
        rapier, system = self._rapier, self._system
        place = three(system.positions[i])
        if system.fixed[i]:
            return rapier.RigidBody.fixed().translation(place)
        mass = float(system.masses[i])
        body = rapier.RigidBody.dynamic().translation(place).linvel(three(system.velocities[i]))
        body = body.additional_mass(mass).linear_damping(system.drag / mass).can_sleep(False)
        return body.locked_axes(rapier.LockedAxes.ROTATION_LOCKED)


ENGINES = (RapierSprings(), RapierSprings("rapier_springs_once", substeps=1))
