"""PyPBD with particles joined by XPBD distance constraints. 2D and 3D, double precision."""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from engines.engine import CAPABILITIES, LINEAR_SPRINGS, changed, refuse_beyond
from engines.vectors import three
from reference.errors import Unsupported
from reference.state import Array
from reference.system import MassSpringSystem, Value

#: PyPBD's gravity along y [m/s^2]; no other can be told it from Python.
GRAVITY = -9.81

#: The sweeps of a step; PyPBD's own are those of the scheme, five sub-steps of one sweep each.
SWEEPS, SUBSTEPS, SWEEP = 5, 5, 1


@dataclass(frozen=True)
class PbdParticles:
    """Particles and constraints; constraints that share no particle are solved together, in colours.

    Attributes:
        substeps, sweeps: NUM_SUB_STEPS and MAX_ITERATIONS.
    """

    name: str = "pypbd_xpbd"
    substeps: int = 1
    sweeps: int = SWEEPS
    package: str = "pyPBD"
    capabilities: frozenset[str] = LINEAR_SPRINGS - {"damping", "dampings", "drag", "tilted gravity"}

    @property
    def identified_as(self) -> Mapping[str, str]:
        """XPBD by Gauss-Seidel over colours."""
        substeps = "" if self.substeps == SUBSTEPS else f", substeps={self.substeps}"
        sweeps = "" if self.sweeps == SWEEP else f", sweeps={self.sweeps}"
        return {"plain": f"xpbd_gauss_seidel(order=apart{substeps}{sweeps})"}

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen."""
        return {"NUM_SUB_STEPS": self.substeps, "MAX_ITERATIONS": self.sweeps, "VELOCITY_UPDATE_METHOD": "first order"}

    @property
    def semantics(self) -> str:
        """What its numbers mean."""
        return "stiffness is k [N/m] of each constraint, by a compliance 1/k; there is neither damping nor drag"

    def start(self, system: MassSpringSystem, dt: float) -> PbdSimulation:
        """The system as particles and constraints. Raises Unsupported as `check` does."""
        check(self, system)
        return PbdSimulation(self, system, dt)


def check(engine: PbdParticles, system: MassSpringSystem) -> None:
    """Raise Unsupported beyond the capabilities, and for what PyPBD would take for something else."""
    refuse_beyond(engine, system)
    if (system.stiffness <= 0).any():
        raise Unsupported(f"{engine.name} takes a spring without stiffness for a rigid rod")
    if system.gravity[system.vertical_axis] != GRAVITY:
        raise Unsupported(f"{engine.name} cannot do {CAPABILITIES['tilted gravity']}, nor any but {GRAVITY} m/s^2")


class PbdSimulation:
    """PyPBD has one simulation in a process: it is emptied, and filled with a particle for each mass."""

    def __init__(self, engine: PbdParticles, system: MassSpringSystem, dt: float) -> None:
        # one thread: on a busy machine several wait long for one another, at every colour of every sweep
        os.environ.setdefault("OMP_NUM_THREADS", "1")
        self._pbd: Any = importlib.import_module("pypbd")
        self._engine, self._system, self._dt = engine, system, dt
        self._begin()

    def step(self) -> None:
        """One TimeStepController.step."""
        self._step()

    def bare_step(self) -> Callable[[], object]:
        """TimeStepController.step."""
        return self._step

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities, particle by particle."""
        d, count = self._system.dimension, len(self._system.masses)
        x = np.array([self._particles.getPosition(i)[:d] for i in range(count)])
        return x, np.array([self._particles.getVelocity(i)[:d] for i in range(count)])

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter it has can change: it is filled anew from here, as it keeps nothing else."""
        system = changed(self._engine, self._system, parameter, value)
        check(self._engine, system)
        x, v = self.state()
        self._system = replace(system, positions=x, velocities=v)
        self._begin()

    def _begin(self) -> None:
        pbd, system = self._pbd, self._system
        simulation = pbd.Simulation.getCurrent()
        simulation.initDefault()
        self._model = model = pbd.SimulationModel()
        model.init()
        simulation.setModel(model)
        self._particles = particles = model.getParticles()
        for i, x in enumerate(system.positions):
            particles.addVertex(three(x))
            particles.setMass(i, 0.0 if system.fixed[i] else float(system.masses[i]))
            particles.setVelocity(i, three(system.velocities[i]))
        for j, (a, b) in enumerate(system.springs.tolist()):
            if not (system.fixed[a] and system.fixed[b]):
                model.addDistanceConstraint_XPBD(a, b, float(system.stiffness[j]))
                model.getConstraints()[-1].restLength = float(system.rest_lengths[j])
        stepper = simulation.getTimeStep()
        controller = pbd.TimeStepController
        stepper.setValueUInt(controller.NUM_SUB_STEPS, self._engine.substeps)
        stepper.setValueUInt(controller.MAX_ITERATIONS, self._engine.sweeps)
        pbd.TimeManager.getCurrent().setTimeStepSize(self._dt)
        self._step = partial(stepper.step, model)


ENGINES = (PbdParticles(), PbdParticles("pypbd_xpbd_substeps", SUBSTEPS, SWEEP))
