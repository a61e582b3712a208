"""One world: a system under one stepper, as far as it has come; and what is said of it once it cannot go on."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from reference.conserved import energy, momentum
from reference.outcome import blow_up
from reference.state import Array, State, Trajectory
from reference.system import MassSpringSystem, Value
from report.live.prediction import Prediction
from report.live.stepping import Stepping, Stopped, stepping

#: A spring so many times its length is no physics any more, and the eye need not wait for more.
STRAIN = 20.0


class World:
    """A system under one stepper. One that stops keeps its last good state, and its reason.

    Args:
        name: of the stepper.
        system: with its parameters; where its masses are is the state's.
        state: where it begins.
        dt: the step [s].

    Attributes:
        state: as far as it has come.
        stopped: why it cannot go on; None while it can.
        blown_up: whether that is a blow-up, and not an engine that failed.
        told: whether that has been said.
    """

    def __init__(self, name: str, system: MassSpringSystem, state: State, dt: float) -> None:
        self.name, self.state, self._dt = name, state, dt
        self.stopped: str | None = None
        self.blown_up = self.told = False
        self._system = self._own = system
        self._stepping: Stepping | None = None
        self.restart(system, state, dt, system)

    def restart(self, system: MassSpringSystem, state: State, dt: float, own: MassSpringSystem) -> None:
        """Go on from a state, maybe of another system or with another dt [s]; a reason to stop is forgotten.

        Args:
            own: the system without what hangs on the cursor: its springs are watched.
        """
        self.end()
        self._system, self.state, self._dt, self._own = system, state, dt, own
        self.stopped, self.blown_up, self.told = None, False, False
        try:
            self._stepping = stepping(self.name, system, state, dt)
        except Stopped as stop:
            self.stopped = str(stop)

    def advance(self, steps: int) -> None:
        """So many steps, if it can."""
        if self._stepping is None or self.stopped:
            return
        try:
            state = self._stepping.advance(steps)
        except Stopped as stop:
            self.stopped = str(stop)
            return
        reason = self._torn(state)
        if reason:
            self.stopped, self.blown_up = reason, True
        if np.isfinite(state.positions).all():
            self.state = state

    def change(self, parameter: str, value: Value, system: MassSpringSystem) -> None:
        """A parameter changes on the fly; the motion goes on. Args: system: with the change in it."""
        self._system = system
        if self._stepping is None or self.stopped:
            return
        try:
            self._stepping.change(parameter, value)
        except Stopped as stop:
            self.stopped = str(stop)

    def end(self) -> None:
        """Let go of what it holds."""
        if self._stepping is not None:
            self._stepping.end()
            self._stepping = None

    @property
    def energy(self) -> float:
        """[J]."""
        return energy(self._system, self.state)

    @property
    def momentum(self) -> Array:
        """[kg m/s], of the masses that can move, shape (d,)."""
        return momentum(self._system, self.state)

    def _torn(self, state: State) -> str | None:
        if not np.isfinite(state.velocities).all() and np.isfinite(state.positions).all():
            return f"a velocity is not a number at t = {state.time:.6g} s"
        n = len(self._own.masses)
        now = State(state.time, state.positions[:n], state.velocities[:n])
        return blow_up(self._own, Trajectory.of([self._own.start, now]), STRAIN)


def distance(one: State, other: State) -> float:
    """How far two states are apart [m]: the largest distance of any mass that both have."""
    n = min(len(one.positions), len(other.positions))
    return float(np.linalg.norm(one.positions[:n] - other.positions[:n], axis=1).max(initial=0.0))


def ending(world: World, dt: float, predictions: Mapping[str, Prediction]) -> str:
    """What is said of a world that has stopped: what happened, and what theory makes of dt."""
    if not world.blown_up:
        return f"{world.name} stopped: {world.stopped}."
    said = f"{world.name} blew up: {world.stopped}."
    known = predictions.get(world.name)
    return f"{said} {known.of(dt)}" if known else said
