"""Newton's particles joined by springs, under three of its solvers, on the processor. 2D and 3D, single precision."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from engines.engine import LINEAR_SPRINGS, Precision, changed, refuse_beyond
from engines.vectors import three
from reference.errors import Unsupported
from reference.state import Array
from reference.system import MassSpringSystem, Value

Solver = Literal["SolverXPBD", "SolverSemiImplicit", "SolverVBD"]

#: The scheme of each, with its default number of iterations.
SCHEMES: Mapping[Solver, str] = {
    "SolverXPBD": "xpbd_jacobi(single=True)",
    "SolverSemiImplicit": "kick_drift",
    "SolverVBD": "vertex_block_descent(single=True)",
}

#: Newton takes particles nearer to one another than their radii, 0.1 m unless told otherwise, for colliding ones; and
#: cuts speeds at 1e5 m/s, unless told otherwise.
RADIUS_PART, FASTEST = 1e-6, 3e38


@dataclass(frozen=True)
class NewtonParticles:
    """Particles and springs; a fixed mass has a mass of zero there.

    Solvers: SolverXPBD, position-based, all springs from the same positions; SolverSemiImplicit, kick then drift;
    SolverVBD, vertex block descent, all masses from the same positions, as springs are not coloured.
    """

    name: str
    solver: Solver
    iterations: int | None = None
    package: str = "newton"
    precision: Precision = "single"
    capabilities: frozenset[str] = LINEAR_SPRINGS - {"drag"}

    @property
    def identified_as(self) -> Mapping[str, str]:
        """The schemes written out above."""
        return {case: self._scheme() for case in ("plain", "damping")}

    @property
    def formerly(self) -> Mapping[str, Mapping[str, str]]:
        """XPBD forgot its corrections after each iteration; VBD took damping for a time, and braked free fall."""
        if self.solver == "SolverXPBD":
            return {"1.7.0": {case: self._scheme("accumulated=False") for case in ("plain", "damping")}}
        if self.solver == "SolverVBD":
            return {"1.3.0": {"plain": self._scheme(), "damping": self._scheme("braked=True")}}
        return {}

    def _scheme(self, *words: str) -> str:
        """The solver's, with parameters that are not its own."""
        base, _, own = SCHEMES[self.solver].rstrip(")").partition("(")
        iterations = () if self.iterations is None else (f"iterations={self.iterations}",)
        given = ", ".join(sorted(filter(None, (*own.split(", "), *iterations, *words))))
        return f"{base}({given})" if given else base

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen."""
        iterations = {} if self.iterations is None else {"iterations": self.iterations}
        return {"solver": self.solver, **iterations, "particle_max_velocity": FASTEST, "device": "cpu"}

    @property
    def semantics(self) -> str:
        """What its numbers mean."""
        how = "explicit" if self.solver == "SolverSemiImplicit" else "implicit, as far as the iterations go"
        return f"stiffness spring_ke is k [N/m] and damping spring_kd c [N s/m] of each spring, {how}; there is no drag"

    def start(self, system: MassSpringSystem, dt: float) -> NewtonSimulation:
        """The system as particles and springs. Raises Unsupported beyond the capabilities, or for XPBD without k."""
        check(self, system)
        return NewtonSimulation(self, system, dt)


def check(engine: NewtonParticles, system: MassSpringSystem) -> None:
    """Raise Unsupported for what Newton would leave out in silence."""
    refuse_beyond(engine, system)
    if engine.solver == "SolverXPBD" and (system.damping[system.stiffness <= 0] > 0).any():
        raise Unsupported(f"{engine.name} leaves out a spring without stiffness, and its damping with it")


class NewtonSimulation:
    """A model with a particle for each mass."""

    def __init__(self, engine: NewtonParticles, system: MassSpringSystem, dt: float) -> None:
        warp = importlib.import_module("warp")
        warp.config.quiet = True
        newton: Any = importlib.import_module("newton")
        self._engine, self._system, self._dt = engine, system, dt
        builder = newton.ModelBuilder(up_axis=newton.Axis.Y)  # gravity: `_write`
        radius = RADIUS_PART * float(system.rest_lengths.min(initial=1.0))
        masses = np.where(system.fixed, 0.0, system.masses).tolist()
        for x, v, mass in zip(system.positions, system.velocities, masses, strict=True):
            builder.add_particle(pos=three(x), vel=three(v), mass=mass, radius=radius)
        for (a, b), k, c in zip(system.springs.tolist(), system.stiffness, system.damping, strict=True):
            builder.add_spring(a, b, float(k), float(c), 0.0)
        if engine.solver == "SolverVBD":
            builder.color()
        self._model = builder.finalize(device="cpu")
        self._model.particle_max_velocity = FASTEST
        # nothing collides, not even masses that are at one place
        self._model.particle_grid, self._model.particle_max_radius = None, 0.0
        options = {} if engine.iterations is None else {"iterations": engine.iterations}
        self._solver = getattr(newton.solvers, engine.solver)(self._model, **options)
        self._now, self._then = self._model.state(), self._model.state()
        self._write()

    def step(self) -> None:
        """One step of the solver, with no force left from the last."""
        self._now.clear_forces()
        self._solver.step(self._now, self._then, None, None, self._dt)
        self._now, self._then = self._then, self._now

    def bare_step(self) -> Callable[[], object]:
        """Here the two states must change places, so the adapter's step is the engine's."""
        return self.step

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities of all particles."""
        d = self._system.dimension
        x, v = (q.numpy()[:, :d].astype(float) for q in (self._now.particle_q, self._now.particle_qd))
        return x, v

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter it has can change between two steps."""
        system = changed(self._engine, self._system, parameter, value)
        check(self._engine, system)
        self._system = system
        self._write()

    def _write(self) -> None:
        model, system = self._model, self._system
        masses = np.where(system.fixed, 0.0, system.masses).astype(np.float32)
        inverse = np.divide(1, masses, out=np.zeros_like(masses), where=masses > 0)
        model.particle_mass.assign(masses)
        model.particle_inv_mass.assign(inverse)
        if len(system.springs):
            model.spring_rest_length.assign(system.rest_lengths.astype(np.float32))
            model.spring_stiffness.assign(system.stiffness.astype(np.float32))
            model.spring_damping.assign(system.damping.astype(np.float32))
        model.set_gravity(three(system.gravity))


ENGINES = (
    NewtonParticles("newton_xpbd", "SolverXPBD"),
    NewtonParticles("newton_xpbd_10", "SolverXPBD", iterations=10),
    NewtonParticles("newton_semi_implicit", "SolverSemiImplicit"),
    NewtonParticles("newton_vbd", "SolverVBD"),
)
