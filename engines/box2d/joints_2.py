"""Box2D 2.3 with distance joints that have a frequency. 2D, single precision."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from engines.box2d.common import ABLE, check, moving
from engines.engine import Precision, changed
from reference.spring_frequencies import frequencies
from reference.state import Array
from reference.system import MassSpringSystem, Value


@dataclass(frozen=True)
class Box2d2Joints:
    """Bodies that cannot turn, joined by distance joints; a step begins from the impulses of the one before.

    Attributes:
        sweeps: velocity iterations (8 is Box2D's own advice).
    """

    name: str = "box2d_2_joints"
    sweeps: int = 8
    package: str = "box2d"
    precision: Precision = "single"
    capabilities: frozenset[str] = ABLE

    @property
    def identified_as(self) -> Mapping[str, str]:
        """Soft constraints, warm-started, in the order that Box2D walks from body to body."""
        sweeps = "" if self.sweeps == 8 else f", sweeps={self.sweeps}"
        return dict.fromkeys(("plain", "damping", "drag"), f"soft_constraints_warm(single=True{sweeps})")

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen."""
        return {"velocityIterations": self.sweeps, "fixedRotation": True, "doSleep": False}

    @property
    def semantics(self) -> str:
        """What its numbers mean."""
        return (
            "stiffness k [N/m] and damping c [N s/m] are told as the frequency (k/m)^(1/2)/(2 pi) and the damping "
            "ratio c/(2 (k m)^(1/2)), m the effective mass; one mass is stepped by backward Euler; drag is "
            "linearDamping Cd/m, explicit"
        )

    def start(self, system: MassSpringSystem, dt: float) -> Box2d2Simulation:
        """The system as bodies and joints. Raises Unsupported beyond the capabilities, or for very short springs."""
        check(self, system)
        return Box2d2Simulation(self, system, dt)


class Box2d2Simulation:
    """A world with a body for each mass."""

    def __init__(self, engine: Box2d2Joints, system: MassSpringSystem, dt: float) -> None:
        box2d = importlib.import_module("Box2D")
        self._engine, self._system, self._box2d = engine, system, box2d
        self._world = box2d.b2World(gravity=(0, 0), doSleep=False)
        self._world.continuousPhysics = False
        self._bodies = [self._body(i) for i in range(len(system.masses))]
        self._joints = {j: self._joint(*system.springs[j].tolist()) for j in moving(system).tolist()}
        self._step = partial(self._world.Step, dt, engine.sweeps, 1)
        self._write()

    def step(self) -> None:
        """One b2World.Step."""
        self._step()

    def bare_step(self) -> Callable[[], object]:
        """b2World.Step."""
        return self._step

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities, body by body."""
        x = np.array([tuple(body.position) for body in self._bodies], dtype=float)
        return x, np.array([tuple(body.linearVelocity) for body in self._bodies], dtype=float)

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter can change between two steps; the joints keep their impulses."""
        system = changed(self._engine, self._system, parameter, value)
        check(self._engine, system)
        self._system = system
        self._write()

    def _body(self, i: int) -> Any:
        position = tuple(self._system.positions[i].tolist())
        if self._system.fixed[i]:
            return self._world.CreateStaticBody(position=position)
        velocity = tuple(self._system.velocities[i].tolist())
        return self._world.CreateDynamicBody(
            position=position, linearVelocity=velocity, fixedRotation=True, allowSleep=False
        )

    def _joint(self, a: int, b: int) -> Any:
        centre = {"localAnchorA": (0, 0), "localAnchorB": (0, 0), "collideConnected": True}
        return self._world.CreateDistanceJoint(bodyA=self._bodies[a], bodyB=self._bodies[b], length=1.0, **centre)

    def _write(self) -> None:
        system = self._system
        self._world.gravity = tuple(system.gravity.tolist())
        for i in np.flatnonzero(~system.fixed).tolist():
            mass = float(system.masses[i])
            self._bodies[i].massData = self._box2d.b2MassData(mass=mass, center=(0, 0), I=0)
            self._bodies[i].linearDamping = system.drag / mass
        _, hertz, ratio = frequencies(system)
        for j, joint in self._joints.items():
            joint.length = float(system.rest_lengths[j])
            joint.frequency, joint.dampingRatio = float(hertz[j]), float(ratio[j])


ENGINES = (Box2d2Joints(), Box2d2Joints("box2d_2_joints_once", sweeps=1))
