"""Pymunk (Chipmunk) with its DampedSpring between bodies that cannot turn. 2D.

What it does in a step, in this order: positions move with the velocities they have; every spring gives its elastic
impulse; gravity and forces act; then the springs' damping is applied in rounds, one spring after the other. So it is
semi-implicit (symplectic) Euler, positions first (`drift_kick`), with damping by sequential impulses. It has no spring
between three bodies: what resists bending is a force that the lab sets, at the positions that its step begins with.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from engines.engine import COLLISIONS, LAWS, Unsupported, changed, refuse_beyond
from engines.pymunk.obstacles import add_balls, add_obstacles
from reference.springs.angular_law import forces_on_masses
from reference.springs.nonlinear_law import secant_stiffness
from reference.state import Array
from reference.system import MassSpringSystem, Value

#: Pymunk's default.
ROUNDS = 10


@dataclass(frozen=True)
class PymunkSprings:
    """Pymunk as it comes, or with each spring's damping converted.

    Attributes:
        rounds: of sequential impulses in a step (`Space.iterations`; 10 is Pymunk's default).
        backward_euler: whether to give Pymunk the c' for which its damping, converged, is backward Euler with the
            system's c: c' = (m/dt) ln(1 + dt c/m), m the spring's effective mass.
    """

    name: str = "pymunk_springs"
    rounds: int = ROUNDS
    backward_euler: bool = False
    package: str = "pymunk"
    capabilities: frozenset[str] = frozenset(
        {"1d", "2d", "mesh", "masses", "rest_lengths", "stiffnesses", "dampings", "stretched", "velocities"}
        | {"damping", "drag", "tilted gravity", "no fixed mass", "circle", "plane", "box"}
        | {"no rest length", "pulls", "angular springs", *LAWS, *COLLISIONS}
    )

    @property
    def identified_as(self) -> Mapping[str, str]:
        """With damping: as many rounds of it as there are, ten being the scheme's own; or, converted, the implicit."""
        rounds = "" if self.rounds == ROUNDS else f"(rounds={self.rounds})"
        sequential = f"drift_kick_sequential_damping{rounds}"
        damping = "drift_kick_implicit_damping" if self.backward_euler else sequential
        return {"plain": "drift_kick", "damping": damping, "drag": "drift_kick"}

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen."""
        damping = "(m/dt) ln(1 + dt c/m)" if self.backward_euler else "c"
        return {"Space.iterations": self.rounds, "DampedSpring.damping": damping, "Body.moment": "inf"}

    @property
    def semantics(self) -> str:
        """What its numbers mean."""
        alone = "1/(1 + dt c/m)" if self.backward_euler else "exp(-dt c/m)"
        return (
            f"stiffness is k [N/m]; with damping c [N s/m] a spring alone keeps {alone} of its elongation rate in a "
            "step, m its effective mass; drag is the force -Cd v set before each step"
        )

    def start(self, system: MassSpringSystem, dt: float) -> PymunkSimulation:
        """The system as bodies and springs in a new space.

        Raises:
            Unsupported: beyond the capabilities; for damped springs that go slack, as Pymunk damps those, too.
        """
        refuse_beyond(self, system)
        if (system.slackens & (system.damping > 0)).any():
            raise Unsupported("Pymunk damps springs that are slack, too: expected none that go slack with damping")
        return PymunkSimulation(self, system, dt)


class PymunkSimulation:
    """A space with one body per mass and one damped spring per spring."""

    def __init__(self, engine: PymunkSprings, system: MassSpringSystem, dt: float) -> None:
        import pymunk
        from pymunk import batch

        self._engine, self._system, self._dt = engine, system, dt
        if system.nonlinear is not None and not hasattr(pymunk.DampedSpring, "force_func"):
            raise Unsupported(
                "this Pymunk asks nobody for the force of a spring: springs that are not linear need a newer one"
            )
        self._by_law = system.nonlinear is not None  # and also once all springs that were not linear are broken
        self._space = pymunk.Space()
        self._space.iterations = engine.rounds
        bodies = [_body(pymunk, system, i) for i in range(len(system.masses))]
        self._moving = [body for body, fixed in zip(bodies, system.fixed, strict=True) if not fixed]
        # Pymunk refuses those between two fixed masses, which move nothing
        self._springs = {
            j: pymunk.DampedSpring(bodies[a], bodies[b], (0, 0), (0, 0), 0, 0, 0)
            for j, (a, b) in enumerate(system.springs.tolist())
            if not (system.fixed[a] and system.fixed[b])
        }
        self._space.add(*bodies, *self._springs.values())
        add_obstacles(pymunk, self._space, system, self._moving)
        add_balls(pymunk, self._space, system, bodies)
        self._set_parameters()
        self._batch, self._buffer = batch, batch.Buffer()
        self._fields = batch.BodyFields.POSITION | batch.BodyFields.VELOCITY
        self._rows = self._rows_of(bodies)

    def step(self) -> None:
        """One Space.step, with drag, pulls and what resists bending as forces, which Pymunk forgets after each."""
        pulls = self._pulls()
        if self._system.drag:
            for body in self._moving:
                body.force = -self._system.drag * body.velocity
        for body, pull in zip(self._moving, pulls, strict=False):
            body.force += tuple(pull)
        self._space.step(self._dt)

    def _pulls(self) -> list[list[float]]:
        """On every moving body [N]: angular springs pull as positions are once they have moved, first in the step."""
        system = self._system
        pulls = system.pulls
        if system.angular_springs is not None:
            x, v = self.state()
            pulls = pulls + forces_on_masses(system.angular_springs, x + self._dt * v)
        return pulls[~system.fixed].tolist() if pulls.any() else []

    def bare_step(self) -> Callable[[], object]:
        """Space.step."""
        return partial(self._space.step, self._dt)

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities of all bodies, read in one batch: 4 us where one by one takes 18 us and more."""
        self._buffer.clear()
        self._batch.get_space_bodies(self._space, self._fields, self._buffer)
        rows = np.frombuffer(self._buffer.float_buf()).reshape(-1, 4)[self._rows]
        return rows[:, :2], rows[:, 2:]

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter can change between two steps."""
        self._system = changed(self._engine, self._system, parameter, value)
        if parameter == "gravity":
            self._space.gravity = tuple(self._system.gravity.tolist())
            return
        self._set_parameters()

    def _set_parameters(self) -> None:
        system = self._system
        self._space.gravity = tuple(system.gravity.tolist())
        for body, mass in zip(self._moving, system.masses[~system.fixed].tolist(), strict=True):
            body.mass = mass
        damping = self._damping()
        for j, spring in self._springs.items():
            spring.rest_length = float(system.rest_lengths[j])
            spring.stiffness = float(system.stiffness[j])
            spring.damping = float(damping[j])
            if self._by_law:
                spring.force_func = partial(_force, system.of_spring(j))

    def _damping(self) -> Array:
        system = self._system
        if not self._engine.backward_euler:
            return system.damping
        inverse = np.where(system.fixed, 0.0, 1 / system.masses)
        a, b = system.springs.T
        per_mass = self._dt * (inverse[a] + inverse[b])
        # A spring between two fixed masses has no effective mass, and nothing to damp.
        return np.divide(np.log1p(per_mass * system.damping), per_mass, where=per_mass > 0, out=np.zeros_like(per_mass))

    def _rows_of(self, bodies: list[Any]) -> list[int]:
        """In which row of a batch each body is: the space keeps them in an order of its own."""
        self._batch.get_space_bodies(self._space, self._batch.BodyFields.BODY_ID, self._buffer)
        identities = np.frombuffer(self._buffer.int_buf(), np.uintp).tolist()
        return [identities.index(body.id) for body in bodies]


def _force(alone: MassSpringSystem, spring: Any, length: float) -> float:
    """What Pymunk asks for of a spring that is not linear: the force with which it pushes its masses apart [N]."""
    stretch = np.array([length - spring.rest_length])
    return -float((secant_stiffness(alone, stretch) * stretch).item())


def _body(pymunk: Any, system: MassSpringSystem, i: int) -> Any:
    if system.fixed[i]:
        body = pymunk.Body(body_type=pymunk.Body.STATIC)
    else:
        body = pymunk.Body(float(system.masses[i]), float("inf"))
        body.velocity = tuple(system.velocities[i].tolist())
    body.position = tuple(system.positions[i].tolist())
    return body


ENGINES = (
    PymunkSprings(),
    PymunkSprings("pymunk_springs_backward", rounds=400, backward_euler=True),
)
