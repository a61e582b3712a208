"""Drake with free bodies joined by linear spring-dampers. 2D and 3D.

Its springs are explicit everywhere, damping too. The multibody plant is either discrete, of dt, or continuous, and then
one of Drake's integrators steps it, without error control: each step of theirs is one of ours.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from engines.engine import LINEAR_SPRINGS, changed, refuse_beyond
from engines.vectors import three
from reference.state import Array
from reference.system import MassSpringSystem, Value

Stepping = Literal["discrete", "explicit_euler", "runge_kutta2", "semi_explicit_euler"]

#: The scheme of each.
SCHEMES: Mapping[Stepping, str] = {
    "discrete": "kick_drift",
    "explicit_euler": "euler",
    "runge_kutta2": "heun",
    "semi_explicit_euler": "kick_drift",
}


@dataclass(frozen=True)
class DrakeSprings:
    """A body for each free mass, which nothing turns; fixed masses are places of the world.

    Attributes:
        stepping: "discrete", or the name of an integrator.
    """

    name: str
    stepping: Stepping
    package: str = "drake"
    capabilities: frozenset[str] = LINEAR_SPRINGS - {"drag"}

    @property
    def identified_as(self) -> Mapping[str, str]:
        """The scheme written out above, with damping too."""
        return dict.fromkeys(("plain", "damping"), SCHEMES[self.stepping])

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen."""
        if self.stepping == "discrete":
            return {"time_step": "dt"}
        return {"integration_scheme": self.stepping, "max_step_size": "dt", "use_error_control": False}

    @property
    def semantics(self) -> str:
        """What its numbers mean."""
        return "stiffness is k [N/m] and damping c [N s/m] of each spring-damper, explicit; drag is left out"

    def start(self, system: MassSpringSystem, dt: float) -> DrakeSimulation:
        """The system as bodies and force elements. Raises Unsupported beyond the capabilities."""
        refuse_beyond(self, system)
        return DrakeSimulation(self, system, dt)


class DrakeSimulation:
    """A plant under Drake's simulator."""

    def __init__(self, engine: DrakeSprings, system: MassSpringSystem, dt: float) -> None:
        self._engine, self._system, self._dt = engine, system, dt
        self._free = np.flatnonzero(~system.fixed)
        self._begin()

    def step(self) -> None:
        """One step: the simulator is sent on by dt."""
        self._steps += 1
        self._simulator.AdvanceTo(self._steps * self._dt)

    def bare_step(self) -> Callable[[], object]:
        """The simulator must be told a time, so the adapter's step is the engine's."""
        return self.step

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities: of each body a rotation and a place, a spin and a velocity."""
        x, v = self._system.positions.copy(), np.zeros_like(self._system.positions)
        d, plant, context = self._system.dimension, self._plant, self._context
        x[self._free] = plant.GetPositions(context).reshape(-1, 7)[:, 4 : 4 + d]
        v[self._free] = plant.GetVelocities(context).reshape(-1, 6)[:, 3 : 3 + d]
        return x, v

    def change(self, parameter: str, value: Value) -> None:
        """A plant's numbers stay as they are once it is finished: another one goes on from here, with nothing lost."""
        system = changed(self._engine, self._system, parameter, value)
        x, v = self.state()
        self._system = replace(system, positions=x, velocities=v)
        self._begin()

    def _begin(self) -> None:
        tree, system = importlib.import_module("pydrake.multibody.tree"), self._system
        plant_type = importlib.import_module("pydrake.multibody.plant").MultibodyPlant
        self._plant = plant = plant_type(self._dt if self._engine.stepping == "discrete" else 0.0)
        plant.mutable_gravity_field().set_gravity_vector(three(system.gravity))
        ends: list[tuple[Any, Any]] = [(plant.world_body(), three(x)) for x in system.positions]
        for i in self._free.tolist():
            inertia = tree.SpatialInertia(float(system.masses[i]), np.zeros(3), tree.UnitInertia.SolidSphere(1.0))
            ends[i] = (plant.AddRigidBody(f"mass {i}", inertia), np.zeros(3))
        for j, (a, b) in enumerate(system.springs.tolist()):
            if not (system.fixed[a] and system.fixed[b]):
                numbers = [float(q[j]) for q in (system.rest_lengths, system.stiffness, system.damping)]
                plant.AddForceElement(tree.LinearSpringDamper(*ends[a], *ends[b], *numbers))
        plant.Finalize()
        self._start_simulator()

    def _start_simulator(self) -> None:
        analysis, system = importlib.import_module("pydrake.systems.analysis"), self._system
        self._context = self._plant.CreateDefaultContext()
        count = len(self._free)
        q, v = np.zeros((count, 7)), np.zeros((count, 6))
        q[:, 0] = 1.0
        q[:, 4:] = [three(x) for x in system.positions[self._free]]
        v[:, 3:] = [three(x) for x in system.velocities[self._free]]
        self._plant.SetPositions(self._context, q.ravel())
        self._plant.SetVelocities(self._context, v.ravel())
        self._simulator = analysis.Simulator(self._plant, self._context)
        if self._engine.stepping != "discrete":
            config = analysis.SimulatorConfig(
                integration_scheme=self._engine.stepping, max_step_size=self._dt, use_error_control=False
            )
            analysis.ApplySimulatorConfig(config, self._simulator)
        self._simulator.Initialize()
        self._steps = 0


ENGINES = (
    DrakeSprings("drake_discrete", "discrete"),
    DrakeSprings("drake_explicit_euler", "explicit_euler"),
    DrakeSprings("drake_runge_kutta2", "runge_kutta2"),
    DrakeSprings("drake_semi_explicit_euler", "semi_explicit_euler"),
)
