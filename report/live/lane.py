"""A lane: one system under one stepper, as far as it has come; and what is said of it once it cannot go on."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from reference.changes import Change
from reference.conserved import energy
from reference.outcome import blow_up
from reference.state import State, Trajectory
from reference.system import MassSpringSystem, Value
from report.live.prediction import Prediction
from report.live.stepping import Stepping, Stopped, stepping


class Lane:
    """A system under one stepper. One that stops keeps its last good state, and its reason.

    Args:
        name: of the stepper.
        stepped: the system with its parameters; where its masses are is the state's.
        state: where it begins.
        dt: the step [s].
        scene: the system without the mass on the cursor: its springs are watched.
        on_stop: told when the lane stops, maybe at once.

    Attributes:
        state: as far as it has come.
        stopped: why it cannot go on; None while it can.
        blown_up: whether that is a blow-up, and not an engine that failed.
        notice: what people are told of that.
    """

    def __init__(
        self,
        name: str,
        stepped: MassSpringSystem,
        state: State,
        dt: float,
        scene: MassSpringSystem,
        on_stop: Callable[[Lane], None],
    ) -> None:
        self.name, self.state, self.dt = name, state, dt
        self.stopped: str | None = None
        self.blown_up, self.notice = False, ""
        self._stepped, self._scene, self._on_stop = stepped, scene, on_stop
        self._stepping: Stepping | None = None
        try:
            self._stepping = stepping(name, stepped, state, dt)
        except Stopped as stop:
            self._stop(str(stop))

    def advance(self, steps: int) -> None:
        """A number of steps, if it can."""
        if self._stepping is None or self.stopped:
            return
        try:
            state = self._stepping.advance(steps)
        except Stopped as stop:
            self._stop(str(stop))
            return
        if np.isfinite(state.positions).all():
            self.state = state
        reason = self._blow_up(state)
        if reason:
            self._stop(reason, blown_up=True)

    def change(self, parameter: str, value: Value, stepped: MassSpringSystem) -> None:
        """A parameter changes on the fly; the motion goes on. Args: stepped: the system with the change in it."""
        self._stepped = stepped
        if self._stepping is None or self.stopped:
            return
        try:
            self._stepping.change(parameter, value)
        except Stopped as stop:
            self._stop(str(stop))

    def end(self) -> None:
        """Let go of what it holds."""
        if self._stepping is not None:
            self._stepping.end()
            self._stepping = None

    @property
    def energy(self) -> float:
        """[J], with heights from where the scene's masses start: weights may change, as on ground that shakes."""
        begin = np.zeros_like(self.state.positions)
        n = len(self._scene.masses)
        begin[:n] = self._scene.positions[:n]
        return energy(self._stepped, self.state, begin)

    def _stop(self, reason: str, blown_up: bool = False) -> None:
        self.stopped, self.blown_up = reason, blown_up
        self._on_stop(self)

    def _blow_up(self, state: State) -> str | None:
        """How a state has left physics behind, or None if it has not."""
        n = len(self._scene.masses)
        now = State(state.time, state.positions[:n], state.velocities[:n])
        return blow_up(self._scene, Trajectory.of([self._scene.start, now]), changes=self._changed())

    def _changed(self) -> list[Change]:
        """What has been changed on the fly, as far as it gives a system more energy."""
        stepped = self._stepped
        return [
            Change(0.0, "mass", float(stepped.masses.max())),
            Change(0.0, "stiffness", float(stepped.stiffness.max(initial=0.0))),
            Change(0.0, "gravity", tuple(stepped.gravity)),
        ]


def distance(one: State, other: State) -> float:
    """The largest distance of any mass between two states of the same masses [m]."""
    return float(np.linalg.norm(one.positions - other.positions, axis=1).max(initial=0.0))


def notice_of(lane: Lane, predictions: Mapping[str, Prediction]) -> str:
    """What is said of a lane that has stopped: what happened, and what theory makes of its dt."""
    if not lane.blown_up:
        return f"{lane.name} stopped: {lane.stopped}."
    said = f"{lane.name} blew up: {lane.stopped}."
    known = predictions.get(lane.name)
    return f"{said} {known.of(lane.dt)}" if known else said
