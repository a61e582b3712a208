"""The live lab without a page: a timeline of lanes on one scene, and all that people do with it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from reference.errors import InputError
from reference.state import Array
from report.live.lane import Lane, notice_of
from report.live.parameters import own_value
from report.live.prediction import Prediction, Predictor
from report.live.reproduction import Reproduction, reproduction
from report.live.scenes import OpenedScene, open_scene
from report.live.stepping import checked
from report.live.timeline import Timeline

#: All lanes together may take this long for a frame [s]; then the lab goes slower than asked.
BUDGET = 0.03

#: The steps [s] and speeds that a page can be asked for, and the most steps a frame.
DT, SPEED, MOST_STEPS = (1e-12, 1e3), (1e-6, 1e6), 2000


class Lab:
    """A scene, the lanes that step it, and what people change while they move. Not for several threads at once.

    Args:
        scene: a name or a file.
        steppers: one for each lane.
        settings: parameters of the scene set otherwise.

    Attributes:
        playing: whether frames advance.
        speed: seconds of the scene in a second.
        most_steps: no more in a frame.
        numbers: of parameters that were moved since the scene was opened.
        timeline: the lanes since the scene's start.

    Raises:
        InputError: for an unknown scene or stepper, or settings that make no sense.
    """

    def __init__(
        self,
        scene: str = "string",
        steppers: Sequence[str] = ("kick_drift",),
        settings: Mapping[str, str] | None = None,
    ) -> None:
        self.playing, self.speed, self.most_steps = False, 1.0, 1000
        self._steppers = checked(steppers)
        self.numbers: dict[str, float] = {}
        opened = open_scene(scene, settings)
        self._predictor = Predictor()
        self.timeline = self._from_start(opened, opened.dt)

    def open(
        self,
        scene: str,
        settings: Mapping[str, str] | None = None,
        barrier: bool | None = None,
        dt: float | None = None,
    ) -> None:
        """Another scene, at its start, with its own dt [s] or another. Raises InputError; then nothing has changed."""
        opened = open_scene(scene, settings, barrier)
        self.numbers = {}
        self._predictor.forget()
        self._start(opened, opened.dt if dt is None else dt)

    def reset(self) -> None:
        """Back to the scene's start, with the parameters as they are now."""
        self._start(self.timeline.opened, self.timeline.dt)

    def _start(self, opened: OpenedScene, dt: float) -> None:
        self.timeline.end()
        self.timeline = self._from_start(opened, dt)

    def _from_start(self, opened: OpenedScene, dt: float) -> Timeline:
        """A new timeline, with the parameters that were moved."""
        self._carry = 0.0
        values = {name: own_value(opened.system, name, number) for name, number in self.numbers.items()}
        timeline = Timeline(opened, self._steppers, dt, values, self._stopped)
        self._predictor.ask(self._steppers, timeline.system, dt)
        return timeline

    # Frames.

    def play(self) -> None:
        """Go; after a blow-up, from the start. What hung on the cursor in the past does not any more."""
        if self.timeline.in_past:
            self.release()
        elif any(lane.stopped for lane in self.timeline.lanes):
            self.reset()
        self.playing = True

    def frame(self, elapsed: float) -> None:
        """Some time has passed [s]: as many steps as it is worth, or as can be done."""
        if not self.playing:
            return
        dt = self.timeline.dt
        wanted = self.speed * elapsed + self._carry
        steps = min(int(wanted / dt + 1e-9), self.most_steps)
        self._carry = min(wanted - steps * dt, dt)
        if steps:
            self.advance(steps, BUDGET)

    def advance(self, steps: int, budget: float = math.inf) -> None:
        """A number of steps in every lane, or as many as fit into a budget [s]."""
        self.timeline.advance(steps, budget, self.speed)

    def rewind(self, seconds: float) -> None:
        """Pause, and show the moment that many seconds of the scene before the last; what is done next is done there.

        Raises:
            InputError: unless it is a number.
        """
        _check("back", seconds, 0.0, math.inf, "s")
        self.playing = False
        self.timeline.rewind(seconds)
        self._steppers = self.timeline.steppers
        self._ask()

    # What people change.

    def set_dt(self, dt: float) -> None:
        """Another step [s]; the motion goes on. Raises InputError unless it is a number within DT."""
        _check("dt", dt, *DT, "s")
        if dt == self.timeline.dt:
            return
        if self.timeline.segment.at_start:
            self._start(self.timeline.opened, dt)
        else:
            self.timeline.set_dt(dt)
            self._ask()

    def set_speed(self, speed: float) -> None:
        """How many seconds of the scene go by in a second. Raises InputError unless it is a number within SPEED."""
        _check("speed", speed, *SPEED, "s of the scene in 1 s")
        self.speed = speed

    def set_most_steps(self, steps: int) -> None:
        """No more steps in a frame. Raises InputError unless from 1 to MOST_STEPS."""
        _check("steps a frame", steps, 1, MOST_STEPS, "1")
        self.most_steps = steps

    def set_parameter(self, name: str, number: float) -> None:
        """A parameter for all masses or springs, on the fly; where they differ, a multiple of what each has itself.

        Raises:
            InputError: for what makes no sense.
        """
        self.timeline.change(name, own_value(self.timeline.opened.system, name, number))
        self.numbers[name] = number
        self._ask()

    def set_steppers(self, names: Sequence[str]) -> None:
        """Another stepper goes on where the one before it was; a new lane begins where the first one is.

        Raises:
            InputError: for an unknown name, none, or too many.
        """
        names = checked(names)
        if names == self._steppers:
            return
        self._steppers = names
        if self.timeline.segment.at_start:
            self.reset()
        else:
            self.timeline.set_steppers(names)
            self._ask()

    def grab(self, mass: int, place: Array) -> None:
        """Hang a mass on the cursor, in every lane, or move the cursor it hangs on. place: [m], shape (d,)."""
        if self._there_is(mass) and not self.timeline.system.fixed[mass] and np.isfinite(place).all():
            self.timeline.grab(mass, place)

    def release(self) -> None:
        """Let go of the mass on the cursor."""
        self.timeline.release()

    def toggle_pin(self, mass: int) -> None:
        """Fix a free mass where it is, or let go of a fixed one."""
        if self._there_is(mass):
            self.timeline.toggle_pin(mass)
            self._ask()

    def _there_is(self, mass: int) -> bool:
        return 0 <= mass < len(self.timeline.system.masses)

    # What is said.

    @property
    def notice(self) -> str:
        """What the last blow-ups or failures were; empty where there are none, or the past is shown."""
        lanes = [] if self.timeline.in_past else self.timeline.lanes
        return " ".join(lane.notice for lane in lanes if lane.notice)

    def _stopped(self, lane: Lane) -> None:
        """A lane has stopped just now: everything pauses."""
        self.playing = False
        lane.notice = notice_of(lane, self.predictions)

    @property
    def predictions(self) -> Mapping[str, Prediction]:
        """By stepper, for the parameters last answered for."""
        return self._predictor.found

    def wait_for_predictions(self, seconds: float = 600.0) -> None:
        """Until the predictions are those for the parameters there are now, but not longer than that [s]."""
        self._predictor.wait(seconds)

    def _ask(self) -> None:
        self._predictor.ask(self._steppers, self.timeline.system, self.timeline.dt)

    def reproduction(self) -> Reproduction:
        """The commands that come to what is seen."""
        return reproduction(self.timeline.segment)

    def end(self) -> None:
        """Let go of processes and threads."""
        self._predictor.end()
        self.timeline.end()


def _check(name: str, value: float, low: float, high: float, unit: str) -> None:
    """Refuse a value beyond a range, and what is no number. Raises InputError."""
    if not (math.isfinite(value) and low <= value <= high):
        raise InputError(f"{name} = {value:g}: expected a number from {low:g} to {high:g} [{unit}]")
