"""How worlds side by side on one scene go on by themselves, in step: from a start, step by step, or from the past.

What people change of them is in `lab`.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence

from reference.changes import Change
from reference.state import State
from reference.system import FIELDS, Value
from report.live.cursor import at_rest_where_fixed
from report.live.history import History, Moment
from report.live.lane import World, ending
from report.live.parameters import own_value
from report.live.prediction import Prediction, Predictor
from report.live.recorder import Measures
from report.live.reference_run import Truth
from report.live.reproduction import Stretch
from report.live.scenes import Opened, open_scene
from report.live.stepping import checked

#: All worlds together may take so long for a frame [s]; then the lab goes slower than asked.
BUDGET = 0.03


class Course:
    """Worlds on one scene, under way. Not for several threads at once: whoever shows it asks it frame by frame.

    Args:
        scene: a name or a file.
        steppers: one for each world.
        settings: parameters of the scene set otherwise.

    Attributes:
        playing: whether frames advance.
        speed: seconds of the scene in a second.
        most_steps: no more in a frame.
        notice: what the last blow-up or failure was; empty where there was none.
        numbers: of parameters that were moved since the scene was opened.
    """

    def __init__(
        self,
        scene: str = "string",
        steppers: Sequence[str] = ("kick_drift",),
        settings: Mapping[str, str] | None = None,
    ) -> None:
        self.playing, self.speed, self.most_steps, self.notice = False, 1.0, 1000, ""
        self.worlds: list[World] = []
        self._grabbed: int | None = None
        self._at: Moment | None = None
        self._predictor = Predictor()
        self._steppers = checked(steppers)
        self.open(scene, settings)

    def open(
        self,
        scene: str,
        settings: Mapping[str, str] | None = None,
        barrier: bool | None = None,
        dt: float | None = None,
    ) -> None:
        """Another scene, at its start, with its own dt [s] or another. Raises InputError; then nothing has changed."""
        opened = open_scene(scene, settings, barrier)
        self._predictor.forget()
        self.opened: Opened = opened
        self.own, self._dt = opened.system, opened.dt if dt is None else dt
        self.numbers: dict[str, float] = {}
        self.reset()

    def reset(self) -> None:
        """Back to the scene's start, with the parameters as they are now."""
        self.clock = self.time = 0.0
        self._carry = 0.0
        self._grabbed = self._at = None
        self.own = self.system = self.opened.system
        self._due = self._from(0.0)
        self._begin(self.opened.settings if self.opened.as_named else None, [self.own.start] * len(self._steppers))
        self._history, self.measures = History(), Measures(self._steppers)
        self._truth = Truth(self.own)
        for name, number in self.numbers.items():
            self._change(name, own_value(self.opened.system, name, number))
        self._ask()
        self._record()

    def _begin(self, settings: Mapping[str, str] | None, states: Sequence[State]) -> None:
        """A stretch of its own, from these states; worlds that had stopped try again."""
        self.notice = ""
        for world in self.worlds[len(self._steppers) :]:
            world.end()
        del self.worlds[len(self._steppers) :]
        for i, (name, state) in enumerate(zip(self._steppers, states, strict=True)):
            if i < len(self.worlds):
                self.worlds[i].name = name
                self.worlds[i].restart(self.system, state, self._dt, self.own)
            else:
                self.worlds.append(World(name, self.system, state, self._dt))
        begin = tuple(states)
        self.stretch = Stretch(self.opened.name, settings, self.system, self._steppers, begin, self._dt)
        for world in self.worlds:
            self._tell(world)

    def _again(self) -> None:
        """A new stretch from where everything is; one that has not moved yet can still be named."""
        fresh = self.time == 0 and self.stretch.steps == 0 and self.stretch.settings is not None
        if fresh and self._grabbed is None and self.own.fixed is self.opened.system.fixed:
            self.reset()
            return
        self._begin(None, [at_rest_where_fixed(self.system, world.state) for world in self.worlds])
        self._ask()

    def _change(self, name: str, value: Value) -> None:
        self.own = self.own.with_parameter(name, value)
        if self._grabbed is not None and name in ("mass", "rest_length", "stiffness", "damping"):
            value = self._for_all_but_the_cursor(name)
        self.system = self.system.with_parameter(name, value)
        self.stretch = self.stretch.with_change(name, value)
        for world in self.worlds:
            world.change(name, value, self.system)
            self._tell(world)

    def _for_all_but_the_cursor(self, name: str) -> Value:
        field = FIELDS.get(name, name)
        return (*getattr(self.own, field).tolist(), float(getattr(self.system, field)[-1]))

    def frame(self, elapsed: float) -> None:
        """So many seconds have passed [s]: as many steps as they are worth, or as can be done."""
        if not self.playing:
            return
        self._go_on_from_here()
        wanted = self.speed * elapsed + self._carry
        steps = min(int(wanted / self._dt + 1e-9), self.most_steps)
        self._carry = min(wanted - steps * self._dt, self._dt)
        if steps:
            self.advance(steps, BUDGET)

    def advance(self, steps: int, budget: float = math.inf) -> None:
        """So many steps in every world, or as many as fit into a budget [s]."""
        self._go_on_from_here()
        deadline = time.perf_counter() + budget
        left, chunk = steps, 1 if math.isfinite(budget) else steps
        begin = time.perf_counter()
        while left and not self.notice:
            now = self._until_due(min(left, chunk))
            for world in self.worlds:
                world.advance(now)
            self._truth.advance(self.system, now * self._dt)
            self.stretch = self.stretch.after(now)
            self.time += now * self._dt
            left -= now
            for world in self.worlds:
                self._tell(world)
            if time.perf_counter() > deadline:
                break
            # twice as many at a time as long as they are quick
            chunk = min(2 * chunk, max(1, steps))
        self.clock += max(time.perf_counter() - begin, (steps - left) * self._dt / max(self.speed, 1e-9))
        self._record()

    def _until_due(self, steps: int) -> int:
        """Make the changes that are due now; how many steps there are until the next."""
        while self._due and self._due[0].time <= self.time + 1e-9 * self._dt:
            change: Change = self._due.pop(0)
            self._change(change.parameter, change.value)
        if not self._due:
            return steps
        return max(1, min(steps, math.ceil((self._due[0].time - self.time) / self._dt - 1e-9)))

    def _from(self, time: float) -> list[Change]:
        """What the scene itself changes from a time on [s]."""
        later = [change for change in self.opened.changes if change.time >= time - 1e-9 * self._dt]
        return sorted(later, key=lambda change: change.time)

    def rewind(self, seconds: float) -> None:
        """Show the moment so many seconds before the last one; nothing is lost until it moves on from there."""
        moment = self._history.back(seconds)
        if moment is None:
            return
        self.playing, self.notice, self._at = False, "", moment
        for world, state in zip(self.worlds, moment.states, strict=True):
            world.state = state
        self.time, self.own, self.system, self._truth.state = moment.time, moment.own, moment.system, moment.true

    @property
    def rewindable(self) -> float:
        """How far back one can go [s]."""
        return self._history.seconds

    def _go_on_from_here(self) -> None:
        """If the past is being looked at, it is now the present."""
        moment, self._at = self._at, None
        if moment is None:
            return
        self._history.forget_after(moment)
        self.measures.forget_after(moment.clock)
        self.clock, self._grabbed, self._dt = moment.clock, moment.grabbed, moment.stretch.dt
        self._due = self._from(moment.time)
        stretch = moment.stretch
        settings = stretch.settings
        self._begin(settings, moment.states)
        self.stretch = stretch
        self._ask()

    def _record(self) -> None:
        self.measures.take(self.clock, self.time, self.worlds, self._truth.state, self.own)
        states = tuple(world.state for world in self.worlds)
        self._history.keep(
            Moment(self.clock, self.time, self.own, self.system, states, self._truth.state, self.stretch, self._grabbed)
        )

    def _tell(self, world: World) -> None:
        """Of a world that has stopped just now, once: then everything pauses."""
        if world.stopped and not world.told:
            world.told = True
            self.playing = False
            self.notice = " ".join(filter(None, [self.notice, ending(world, self._dt, self.predictions)]))

    def _ask(self) -> None:
        self._predictor.ask(self._steppers, self.own, self._dt)

    @property
    def dt(self) -> float:
        """The step [s]."""
        return self._dt

    @property
    def true(self) -> State | None:
        """Where it truly is; None where that is not followed."""
        return self._truth.state

    @property
    def why_no_truth(self) -> str:
        """Why it is not followed; empty where it is."""
        return self._truth.why_not

    @property
    def predictions(self) -> Mapping[str, Prediction]:
        """By stepper, for the parameters last answered for."""
        return self._predictor.found

    def wait_for_predictions(self, seconds: float = 10.0) -> None:
        """Until the predictions are those for the parameters there are now."""
        self._predictor.wait(seconds)

    def end(self) -> None:
        """Let go of processes and threads."""
        self._predictor.end()
        for world in self.worlds:
            world.end()
