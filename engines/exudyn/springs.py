"""Exudyn with mass points joined by its spring-dampers, under its explicit solvers. 2D and 3D."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from types import ModuleType
from typing import Any, ClassVar, Literal

import numpy as np

from engines.engine import CAPABILITIES, COLLISIONS, OBSTACLES, changed, refuse_beyond
from engines.vectors import three
from reference.springs.angular import AngularSprings
from reference.springs.angular_law import forces_on_masses
from reference.springs.nonlinear_law import damping_at, secant_stiffness
from reference.state import Array
from reference.system import MassSpringSystem, Value

Solver = Literal["RK44", "ExplicitEuler", "VelocityVerlet"]

#: The scheme of each solver, whatever of damping and drag it is given.
SCHEMES: Mapping[Solver, str] = {"RK44": "rk4", "ExplicitEuler": "euler", "VelocityVerlet": "velocity_verlet"}


@dataclass(frozen=True)
class ExudynSprings:
    """Mass points on nodes, joined by spring-dampers; a fixed mass is a ground node.

    Springs that are not linear, and what resists bending, it asks the lab's own law for, by its user functions.

    Solvers, each with h = dt:
        RK44            the classic Runge-Kutta method.
        ExplicitEuler   x' = x + h v, v' = v + h a(x, v): Euler's own, not the semi-implicit one.
        VelocityVerlet  w = v + h/2 a, x' = x + h w, a' = a(x', w), v' = w + h/2 a'. The next step begins with this a',
                        taken at w, not at v'. Where forces depend on velocities, a step is therefore no function of
                        positions and velocities alone: no scheme, so damping and drag are left out.
    """

    where_it_comes: ClassVar[str] = "expected the extra springlab[exudyn]"

    name: str
    solver: Solver
    package: str = "exudyn"

    @property
    def capabilities(self) -> frozenset[str]:
        """Everything but obstacles and collisions; for VelocityVerlet everything but those, damping and drag."""
        left_out = {"damping", "dampings", "drag"} if self.solver == "VelocityVerlet" else set()
        return frozenset(CAPABILITIES) - {*OBSTACLES, *COLLISIONS} - left_out

    @property
    def identified_as(self) -> Mapping[str, str]:
        """The schemes written out above."""
        able = [what for what in ("plain", "damping", "drag") if what == "plain" or what in self.capabilities]
        return dict.fromkeys(able, SCHEMES[self.solver])

    @property
    def semantics(self) -> str:
        """What its numbers mean."""
        if "damping" not in self.capabilities:
            return (
                "stiffness is k [N/m] of each spring-damper; damping and drag, which it would take late, are left out"
            )
        return (
            "stiffness is k [N/m] and damping c [N s/m] of each spring-damper, explicit; drag is Cd [N s/m] of a "
            "damper between each mass and the ground, explicit"
        )

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen."""
        return {"solverType": self.solver, "linearSolver.solverType": "EigenSparse", "parallel.numberOfThreads": 1}

    def start(self, system: MassSpringSystem, dt: float) -> ExudynSimulation:
        """The system as nodes, mass points and connectors. Raises Unsupported beyond the capabilities."""
        refuse_beyond(self, system)
        return ExudynSimulation(self, system, dt)


class ExudynSimulation:
    """A system in Exudyn, its solver between two steps. The coordinates are the free masses' positions, in order."""

    def __init__(self, engine: ExudynSprings, system: MassSpringSystem, dt: float) -> None:
        exudyn = importlib.import_module("exudyn")
        exudyn.config.printToConsole = False
        exudyn.config.suppressWarnings = True
        self._engine, self._system, self._dt = engine, system, dt
        self._container = exudyn.SystemContainer()  # holds the memory that coordinates are views of
        self._mbs = self._container.AddSystem()
        self._items = Items(exudyn, self._mbs, system)
        self._settings = _settings(exudyn, engine.solver, dt)
        self._solver = exudyn.MainSolverExplicit()
        self._initial = exudyn.ConfigurationType.Initial
        self._positions, self._velocities = system.positions.copy(), system.velocities.copy()
        self._free = np.flatnonzero(~system.fixed)
        self._advance = partial(self._solver.DiscontinuousIteration, self._mbs, self._settings)
        self._begin()
        data, shape = self._mbs.systemData, (-1, system.dimension)
        self._q = data.GetODE2Coordinates(copy=False).reshape(shape)
        self._v = data.GetODE2Coordinates_t(copy=False).reshape(shape)

    def step(self) -> None:
        """One step of the solver: all of it but what writes files, draws, and counts the time."""
        self._advance()

    def bare_step(self) -> Callable[[], object]:
        """The solver's DiscontinuousIteration, which makes one step whatever its name."""
        return self._advance

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities, read from Exudyn's own memory: to ask for them takes 3 us, as long as a step."""
        self._positions[self._free], self._velocities[self._free] = self._q, self._v
        return self._positions.copy(), self._velocities.copy()

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter the engine has can change. The solver begins anew, as it keeps the masses and the forces."""
        self._system = changed(self._engine, self._system, parameter, value)
        self.state()
        self._begin()

    def _begin(self) -> None:
        """The system's numbers into the items, the present state into the initial one, and the solver to its start."""
        self._items.write(self._system)
        data = self._mbs.systemData
        data.SetODE2Coordinates(self._positions[self._free].ravel(), self._initial)
        data.SetODE2Coordinates_t(self._velocities[self._free].ravel(), self._initial)
        self._solver.InitializeSolver(self._mbs, self._settings)
        self._solver.it.currentStepSize = self._dt


class Items:
    """What a system is made of in Exudyn, by number: mass points, their weights and drag, springs."""

    def __init__(self, exudyn: ModuleType, mbs: Any, system: MassSpringSystem) -> None:
        self._mbs = mbs
        self._free = np.flatnonzero(~system.fixed)
        self._bodies, self._weights, self._drags, self._pulls = [], [], [], []
        self._by_law = system.nonlinear is not None  # and also once all springs that were not linear are broken
        item = importlib.import_module("exudyn.itemInterface")
        flat = system.dimension == 2
        node_type, body_type = (item.NodePoint2D, item.MassPoint2D) if flat else (item.NodePoint, item.MassPoint)
        ground = mbs.AddMarker(item.MarkerNodePosition(nodeNumber=mbs.AddNode(item.NodePointGround())))
        ends = []
        for i, fixed in enumerate(system.fixed):
            # free nodes have their reference at the origin, so that coordinates are positions
            at = item.NodePointGround(referenceCoordinates=list(three(system.positions[i]))) if fixed else node_type()
            node = mbs.AddNode(at)
            ends.append(mbs.AddMarker(item.MarkerNodePosition(nodeNumber=node)))
            if fixed:
                continue
            self._bodies.append(mbs.AddObject(body_type(nodeNumber=node)))
            body = mbs.AddMarker(item.MarkerBodyMass(bodyNumber=self._bodies[-1]))
            self._weights.append(mbs.AddLoad(item.LoadMassProportional(markerNumber=body)))
            self._pulls.append(mbs.AddLoad(item.Force(markerNumber=ends[-1])))
            self._drags.append(mbs.AddObject(item.CartesianSpringDamper(markerNumbers=[ground, ends[-1]])))
        self._springs = [mbs.AddObject(item.SpringDamper(markerNumbers=[ends[a], ends[b]])) for a, b in system.springs]
        self._bends = []
        if system.angular_springs is not None:
            nodes = [mbs.GetObjectParameter(body, "nodeNumber") for body in self._bodies]
            massless = np.zeros((len(nodes) * system.dimension,) * 2)
            self._bends.append(mbs.AddObject(item.ObjectGenericODE2(nodeNumbers=nodes, massMatrix=massless)))
        mbs.Assemble()

    def write(self, system: MassSpringSystem) -> None:
        """The parameters of a system into its items."""
        mbs = self._mbs
        for body, mass in zip(self._bodies, system.masses[self._free].tolist(), strict=True):
            mbs.SetObjectParameter(body, "mass", mass)
        for weight in self._weights:
            mbs.SetLoadParameter(weight, "loadVector", list(three(system.gravity)))
        for load, pull in zip(self._pulls, system.pulls[self._free], strict=True):
            mbs.SetLoadParameter(load, "loadVector", list(three(pull)))
        for drag in self._drags:
            mbs.SetObjectParameter(drag, "damping", [system.drag] * 3)
            mbs.SetObjectParameter(drag, "activeConnector", system.drag > 0)
        for j, spring in enumerate(self._springs):
            mbs.SetObjectParameter(spring, "referenceLength", float(system.rest_lengths[j]))
            mbs.SetObjectParameter(spring, "stiffness", float(system.stiffness[j]))
            mbs.SetObjectParameter(spring, "damping", float(system.damping[j]))
            if self._by_law:
                mbs.SetObjectParameter(spring, "springForceUserFunction", partial(_force, system.of_spring(j)))
        for bend in self._bends:
            mbs.SetObjectParameter(bend, "forceUserFunction", partial(_bending, system))


def _bending(system: MassSpringSystem, mbs: Any, time: float, item: int, q: Any, v: Any) -> Any:
    """What Exudyn asks for of an object with a force of its own: that of all angular springs on the free masses [N]."""
    positions, free = system.positions.copy(), ~system.fixed
    positions[free] = np.reshape(q, (-1, system.dimension))
    return forces_on_masses(system.angular_springs or AngularSprings(), positions)[free].ravel().tolist()


def _force(
    alone: MassSpringSystem,
    mbs: Any,
    time: float,
    item: int,
    stretch: float,
    rate: float,
    stiffness: float,
    damping: float,
    force: float,
) -> float:
    """What Exudyn asks for of a spring that is not linear: the force with which it pulls its masses together [N]."""
    at = np.array([stretch])
    return float((secant_stiffness(alone, at) * at + damping_at(alone, at) * rate).item())


def _settings(exudyn: ModuleType, solver: Solver, dt: float) -> Any:
    """Of one solver, silent, writing nothing."""
    settings = exudyn.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.sensors.active = False
    settings.parallel.numberOfThreads = 1
    settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse  # dense, a step takes n^2
    time = settings.timeIntegration
    time.verboseMode = 0
    time.solverType = getattr(exudyn.DynamicSolverType, solver)
    time.endTime, time.numberOfSteps = dt, 1
    time.explicit.computeEndOfStepAccelerations = False  # nothing reads them
    return settings


ENGINES = (
    ExudynSprings("exudyn_springs", "RK44"),
    ExudynSprings("exudyn_springs_euler", "ExplicitEuler"),
    ExudynSprings("exudyn_springs_verlet", "VelocityVerlet"),
)
