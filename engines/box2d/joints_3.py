"""Box2D 3 with distance joints that have a spring, by its own C interface. 2D, single precision."""

from __future__ import annotations

import importlib
import weakref
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from engines.box2d.common import ABLE, check, moving
from engines.engine import Precision, changed
from reference.errors import Unsupported
from reference.spring_frequencies import frequencies
from reference.state import Array
from reference.system import MassSpringSystem, Value

#: Box2D's default.
SUBSTEPS = 4

#: Box2D cuts speeds at 400 m/s; here it is told not to.
FASTEST = 1e9


@dataclass(frozen=True)
class Box2d3Joints:
    """Bodies that cannot turn, joined by distance joints; joints that share no body are solved together.

    Attributes:
        substeps: in a step.
    """

    name: str = "box2d_3_joints"
    substeps: int = SUBSTEPS
    package: str = "box2d-python"
    precision: Precision = "single"
    capabilities: frozenset[str] = ABLE

    @property
    def identified_as(self) -> Mapping[str, str]:
        """Soft constraints: solve, move, relax."""
        substeps = "" if self.substeps == SUBSTEPS else f", substeps={self.substeps}"
        return dict.fromkeys(("plain", "damping", "drag"), f"soft_constraints_relaxed(single=True{substeps})")

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen."""
        return {"subStepCount": self.substeps, "enableSleep": False, "maximumLinearSpeed": FASTEST}

    @property
    def semantics(self) -> str:
        """What its numbers mean."""
        return (
            "stiffness k [N/m] and damping c [N s/m] are told as hertz (k/m)^(1/2)/(2 pi) and the damping ratio "
            "c/(2 (k m)^(1/2)), m the effective mass; a sub-step damps twice as much as backward Euler's; drag is "
            "linearDamping Cd/m, implicit"
        )

    def start(self, system: MassSpringSystem, dt: float) -> Box2d3Simulation:
        """The system as bodies and joints. Raises Unsupported beyond the capabilities, or for very short springs."""
        check(self, system)
        return Box2d3Simulation(self, system, dt)


class Box2d3Simulation:
    """A world with a body for each mass."""

    def __init__(self, engine: Box2d3Joints, system: MassSpringSystem, dt: float) -> None:
        binding = importlib.import_module("box2d._box2d")
        self._ffi, self._lib = binding.ffi, binding.lib
        self._engine, self._system = engine, system
        world_def = self._lib.b2DefaultWorldDef()
        world_def.enableSleep, world_def.enableContinuous = False, False
        world_def.maximumLinearSpeed = FASTEST
        self._world = self._lib.b2CreateWorld(self._ffi.new("b2WorldDef *", world_def))
        weakref.finalize(self, self._lib.b2DestroyWorld, self._world)
        self._bodies = [self._body(i) for i in range(len(system.masses))]
        self._write_bodies()
        self._joints = {j: self._joint(j) for j in moving(system).tolist()}
        self._step = partial(self._lib.b2World_Step, self._world, dt, engine.substeps)
        self._write_joints()

    def step(self) -> None:
        """One b2World_Step."""
        self._step()

    def bare_step(self) -> Callable[[], object]:
        """b2World_Step."""
        return self._step

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities, body by body."""
        lib = self._lib
        places = [lib.b2Body_GetPosition(body) for body in self._bodies]
        speeds = [lib.b2Body_GetLinearVelocity(body) for body in self._bodies]
        x, v = (np.array([(q.x, q.y) for q in vectors], dtype=float) for vectors in (places, speeds))
        return x, v

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter but the rest length can change between two steps; the joints keep their impulses.

        A joint whose length is set forgets its impulse, which no scheme does.
        """
        if parameter == "rest_length":
            raise Unsupported("Box2D 3 forgets the impulse of a joint whose rest length is changed")
        system = changed(self._engine, self._system, parameter, value)
        check(self._engine, system)
        self._system = system
        self._write_bodies()
        self._write_joints()

    def _body(self, i: int) -> Any:
        system, lib = self._system, self._lib
        body_def = lib.b2DefaultBodyDef()
        body_def.type = lib.b2_staticBody if system.fixed[i] else lib.b2_dynamicBody
        body_def.position.x, body_def.position.y = system.positions[i].tolist()
        if not system.fixed[i]:
            body_def.linearVelocity.x, body_def.linearVelocity.y = system.velocities[i].tolist()
        body_def.fixedRotation, body_def.enableSleep = True, False
        return lib.b2CreateBody(self._world, self._ffi.new("b2BodyDef *", body_def))

    def _joint(self, j: int) -> Any:
        joint_def = self._lib.b2DefaultDistanceJointDef()
        a, b = self._system.springs[j].tolist()
        joint_def.bodyIdA, joint_def.bodyIdB = self._bodies[a], self._bodies[b]
        joint_def.length, joint_def.enableSpring = float(self._system.rest_lengths[j]), True
        return self._lib.b2CreateDistanceJoint(self._world, self._ffi.new("b2DistanceJointDef *", joint_def))

    def _write_bodies(self) -> None:
        system, lib = self._system, self._lib
        gravity = self._ffi.new("b2Vec2 *", system.gravity.tolist())
        lib.b2World_SetGravity(self._world, gravity[0])
        for i in np.flatnonzero(~system.fixed).tolist():
            mass = float(system.masses[i])
            lib.b2Body_SetMassData(self._bodies[i], self._ffi.new("b2MassData *", {"mass": mass})[0])
            lib.b2Body_SetLinearDamping(self._bodies[i], system.drag / mass)

    def _write_joints(self) -> None:
        _, hertz, ratio = frequencies(self._system)
        lib = self._lib
        for j, joint in self._joints.items():
            lib.b2DistanceJoint_SetSpringHertz(joint, float(hertz[j]))
            lib.b2DistanceJoint_SetSpringDampingRatio(joint, float(ratio[j]))


ENGINES = (Box2d3Joints(), Box2d3Joints("box2d_3_joints_once", substeps=1))
