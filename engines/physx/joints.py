"""PhysX 5, in SAPIEN, with distance joints whose equal limits are soft. 2D and 3D, single precision."""

from __future__ import annotations

import importlib
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from engines.engine import LINEAR_SPRINGS, Precision, changed, refuse_beyond
from engines.vectors import three
from reference.state import Array
from reference.system import MassSpringSystem, Value

#: SAPIEN's defaults: sweeps before the bodies move (of TGS sub-steps, each of one sweep), and after.
SWEEPS, SWEEPS_AFTER = 10, 1

#: Speeds are cut beyond this [m/s]; it is SAPIEN's own 1e16, of whose square PhysX makes no infinity.
FASTEST = 1e16


@dataclass(frozen=True)
class PhysxJoints:
    """Bodies that cannot turn, joined by distance joints, under PhysX's projected Gauss-Seidel solver (PGS) or TGS.

    Attributes:
        sweeps: solver_position_iterations; of TGS, sub-steps.
        tgs: whether the solver is temporal Gauss-Seidel.
    """

    name: str = "physx_joints"
    sweeps: int = SWEEPS
    tgs: bool = False
    package: str = "sapien"
    precision: Precision = "single"
    capabilities: frozenset[str] = LINEAR_SPRINGS

    @property
    def identified_as(self) -> Mapping[str, str]:
        """Soft constraints without a warm start: one sub-step of many sweeps, or many of one."""
        scheme = f"soft_constraints_cold(drag_first=True, order=newest_first, substeps=1, sweeps={self.sweeps})"
        if self.tgs:
            substeps = "" if self.sweeps == SWEEPS else f", substeps={self.sweeps}"
            scheme = f"temporal_gauss_seidel(damping_as_stiffness=True{substeps})"
        return dict.fromkeys(("plain", "damping", "drag"), scheme)

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen."""
        return {
            "enable_tgs": self.tgs,
            "solver_position_iterations": self.sweeps,
            "solver_velocity_iterations": SWEEPS_AFTER,
            "locked_motion_axes": "rotations",
            "sleep_threshold": 0,
        }

    @property
    def semantics(self) -> str:
        """What its numbers mean."""
        each = " in each sub-step, and by a sweep more" if self.tgs else ""
        beside = ", and a little stiffness" if self.tgs else ""
        return (
            f"stiffness is k [N/m] and damping c [N s/m]{beside} of each joint's limits, implicit; one mass is stepped "
            f"by backward Euler{each}; drag is linear_damping Cd/m, explicit"
        )

    def start(self, system: MassSpringSystem, dt: float) -> PhysxSimulation:
        """The system as bodies and joints. Raises Unsupported beyond the capabilities."""
        refuse_beyond(self, system)
        return PhysxSimulation(self, system, dt)


class PhysxSimulation:
    """A scene with a body for each mass."""

    def __init__(self, engine: PhysxJoints, system: MassSpringSystem, dt: float) -> None:
        with warnings.catch_warnings():  # of a library for pictures, which nothing here needs
            warnings.simplefilter("ignore")
            self._sapien: Any = importlib.import_module("sapien")
            self._physx: Any = importlib.import_module("sapien.physx")
        self._engine, self._system, self._dt = engine, system, dt
        self._begin()

    def step(self) -> None:
        """One PhysxCpuSystem.step."""
        self._world.step()

    def bare_step(self) -> Callable[[], object]:
        """PhysxCpuSystem.step."""
        step: Callable[[], object] = self._world.step
        return step

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities, body by body."""
        x, v = self._system.positions.copy(), np.zeros_like(self._system.positions)
        d = self._system.dimension
        for i in np.flatnonzero(~self._system.fixed).tolist():
            x[i], v[i] = self._entities[i].pose.p[:d], self._bodies[i].linear_velocity[:d]
        return x, v

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter it has can change: a new scene goes on from here, as nothing else is kept."""
        system = changed(self._engine, self._system, parameter, value)
        x, v = self.state()
        self._system = replace(system, positions=x, velocities=v)
        self._begin()

    def _begin(self) -> None:
        system, physx = self._system, self._physx
        config = physx.PhysxSceneConfig()
        config.gravity, config.enable_tgs = three(system.gravity), self._engine.tgs
        physx.set_scene_config(config)
        self._world = physx.PhysxCpuSystem()
        self._world.timestep = self._dt
        self._scene = self._sapien.Scene([self._world])
        self._bodies = [self._body(i) for i in range(len(system.masses))]
        self._entities = [self._entity(i) for i in range(len(system.masses))]
        for j, (a, b) in enumerate(system.springs.tolist()):
            if not (system.fixed[a] and system.fixed[b]):
                self._join(a, b, j)

    def _body(self, i: int) -> Any:
        """Without a shape, so that nothing collides."""
        physx, system = self._physx, self._system
        if system.fixed[i]:
            return physx.PhysxRigidStaticComponent()
        body = physx.PhysxRigidDynamicComponent()
        body.mass, body.inertia = float(system.masses[i]), [1.0, 1.0, 1.0]
        body.linear_damping, body.angular_damping = system.drag / body.mass, 0.0
        body.max_linear_velocity, body.sleep_threshold = FASTEST, 0.0
        body.solver_position_iterations, body.solver_velocity_iterations = self._engine.sweeps, SWEEPS_AFTER
        return body

    def _entity(self, i: int) -> Any:
        """What has a place, and carries the body."""
        system, body, entity = self._system, self._bodies[i], self._sapien.Entity()
        entity.add_component(body)
        entity.set_pose(self._sapien.Pose(three(system.positions[i])))
        entity.add_to_scene(self._scene)
        if not system.fixed[i]:
            body.linear_velocity = three(system.velocities[i])
            body.set_locked_motion_axes([False] * 3 + [True] * 3)
        return entity

    def _join(self, a: int, b: int, j: int) -> None:
        """A joint is a component of the second body's entity, and does nothing until it is added to it.

        That body must be one that moves.
        """
        system = self._system
        a, b = (b, a) if system.fixed[b] else (a, b)
        joint = self._physx.PhysxDistanceJointComponent(self._bodies[b])
        joint.parent = self._bodies[a]
        joint.pose_in_parent = joint.pose_in_child = self._sapien.Pose()
        rest = float(system.rest_lengths[j])
        joint.set_limit(rest, rest, float(system.stiffness[j]), float(system.damping[j]))
        self._entities[b].add_component(joint)


ENGINES = (PhysxJoints(), PhysxJoints("physx_joints_tgs", tgs=True))
