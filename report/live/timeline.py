"""The timeline: lanes on one scene that advance in step, from its start to the present, and back into the past.

Where something happens that no command can say (a dt, a stepper, a mass held or fixed by hand), a new segment begins.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence

from reference.changes import Change
from reference.state import Array, State
from reference.system import FIELDS, MassSpringSystem, Value
from report.live.cursor import at_rest_where_fixed, hook, on_hook, pinned, with_cursor, without_last
from report.live.history import History, Moment
from report.live.lane import Lane
from report.live.recorder import Recorder
from report.live.reference_run import ReferenceRun
from report.live.scenes import OpenedScene
from report.live.segment import Segment

#: Parameters of which there is one for each mass or spring: the cursor's spring keeps its own.
PER_ITEM = ("mass", "rest_length", "stiffness", "damping")


class Timeline:
    """Lanes under way on a scene, from its start. Not for several threads at once.

    Args:
        opened: the scene.
        steppers: one for each lane.
        dt: the step [s].
        parameters: set when it begins.
        on_stop: told of every lane that stops.

    Attributes:
        opened: the scene, as it was opened.
        steppers: by name, one for each lane.
        dt: the step [s].
        time: of the scene [s].
        clock: for how long it has run [s]: by this one goes back.
        system: the scene's, with its parameters as they are now.
        stepped: what the lanes step: the same, with the mass on the cursor where there is one.
        grabbed: the mass that hangs on the cursor, if one does.
        segment: what has happened since the last thing no command can say.
        lanes: as many as steppers.
        reference: the true motion beside them.
        recorder: what is measured of them.
        in_past: whether a moment of the past is shown, which is not the present yet.
    """

    def __init__(
        self,
        opened: OpenedScene,
        steppers: tuple[str, ...],
        dt: float,
        parameters: Mapping[str, Value],
        on_stop: Callable[[Lane], None],
    ) -> None:
        self.opened, self._on_stop = opened, on_stop
        self.steppers, self.dt = steppers, dt
        self.time = self.clock = 0.0
        self.system = self.stepped = opened.system
        self.grabbed: int | None = None
        self.in_past = False
        self.reference = ReferenceRun(opened.system)
        self._pending = self._scene_changes(since=0.0)
        self.lanes: list[Lane] = []
        self.segment: Segment
        self._begin([opened.system.start] * len(steppers), opened.settings if opened.as_named else None)
        self._history, self.recorder = History(), Recorder(steppers)
        for name, value in parameters.items():
            self.change(name, value)
        self._record()

    def end(self) -> None:
        """Let go of what the lanes hold."""
        for lane in self.lanes:
            lane.end()

    # Forwards.

    def advance(self, steps: int, budget: float = math.inf, speed: float = 1.0) -> None:
        """Advance all lanes by a number of steps, or by as many as fit into a budget; stop with the first that stops.

        Args:
            budget: how long it may take [s].
            speed: how many seconds of the scene are shown in a second: the clock goes on by no less than that takes.
        """
        self.resume()
        going = [lane for lane in self.lanes if not lane.stopped]
        begin, done, chunk = time.perf_counter(), 0, steps if math.isinf(budget) else 1
        while going and done < steps:
            done += self._advance_lanes(min(chunk, steps - done))
            if any(lane.stopped for lane in going) or time.perf_counter() - begin > budget:
                break
            chunk *= 2  # twice as many at a time as long as they are quick
        self.clock += max(time.perf_counter() - begin, done * self.dt / max(speed, 1e-9))
        self._record()

    def _advance_lanes(self, steps: int) -> int:
        """Make the scene's own changes that are due, and go on, at most to the next one. Returns how many steps."""
        steps = self._make_due_changes(steps)
        for lane in self.lanes:
            lane.advance(steps)
        self.reference.advance(self.stepped, steps * self.dt)
        self.segment = self.segment.after(steps)
        self.time += steps * self.dt
        return steps

    def _make_due_changes(self, steps: int) -> int:
        """Change what the scene itself changes by now; of these steps, how many there are until it does so again."""
        while self._pending and self._pending[0].time <= self.time + 1e-9 * self.dt:
            change = self._pending.pop(0)
            self.change(change.parameter, change.value)
        if not self._pending:
            return steps
        return max(1, min(steps, math.ceil((self._pending[0].time - self.time) / self.dt - 1e-9)))

    def _scene_changes(self, since: float) -> list[Change]:
        """What the scene itself changes from a time on [s], in order."""
        later = [change for change in self.opened.changes if change.time >= since - 1e-9 * self.dt]
        return sorted(later, key=lambda change: change.time)

    # Changes on the way.

    def change(self, name: str, value: Value) -> None:
        """A parameter changes on the fly: the motion goes on, and a command can say it.

        Raises:
            InputError: for a value the parameter cannot have.
        """
        system = self.system.with_parameter(name, value)
        self.resume()
        self.system = system
        if self.grabbed is not None and name in PER_ITEM:
            value = self._with_the_cursors(name)
        self.stepped = self.stepped.with_parameter(name, value)
        self.segment = self.segment.with_change(name, value)
        for lane in self.lanes:
            lane.change(name, value, self.stepped)

    def _with_the_cursors(self, name: str) -> Value:
        """The values of all masses or springs, and at the end that of the one on the cursor."""
        field = FIELDS.get(name, name)
        return (*getattr(self.system, field).tolist(), float(getattr(self.stepped, field)[-1]))

    def set_dt(self, dt: float) -> None:
        """Go on with another step [s]."""
        self.resume()
        self.dt = dt
        self._begin([lane.state for lane in self.lanes])

    def set_steppers(self, steppers: tuple[str, ...]) -> None:
        """Others take over; a lane more begins where the first one is."""
        self.resume()
        states = [lane.state for lane in self.lanes]
        self.steppers = steppers
        self._begin([states[i] if i < len(states) else states[0] for i in range(len(steppers))])
        self.recorder.take(steppers)
        self._record()

    def grab(self, mass: int, place: Array) -> None:
        """Hang a mass on the cursor, or move the cursor it hangs on. place: [m], shape (d,)."""
        self.resume()
        end = hook(self.system, place)
        hung = with_cursor(self.system, mass, place)
        self._go_on_with(self.system, hung, lambda state: on_hook(self._without_cursor(state), end))
        self.grabbed = mass

    def release(self) -> None:
        """Let go of the mass on the cursor, if there is one."""
        if self.grabbed is None:
            return
        self.resume()
        self._go_on_with(self.system, self.system, self._without_cursor)
        self.grabbed = None

    def toggle_pin(self, mass: int) -> None:
        """Fix a free mass where it is, or let go of a fixed one; the cursor lets go."""
        self.resume()
        self.release()
        system = pinned(self.system, mass)
        self._go_on_with(system, system, lambda state: at_rest_where_fixed(system, state))

    def _without_cursor(self, state: State) -> State:
        return state if self.grabbed is None else without_last(state)

    def _go_on_with(
        self, system: MassSpringSystem, stepped: MassSpringSystem, state_in: Callable[[State], State]
    ) -> None:
        """Go on with other systems. Args: state_in: what a state is in the one that is stepped."""
        states = [state_in(lane.state) for lane in self.lanes]
        if self.reference.state is not None:
            self.reference.state = state_in(self.reference.state)
        self.system, self.stepped = system, stepped
        self._begin(states)

    # Back, and on from there.

    def rewind(self, seconds: float) -> None:
        """Show the moment that many seconds of the scene before the last one, with the lanes there were then.

        Nothing is lost until it goes on from there.
        """
        moment = self._history.back(seconds)
        if moment is None:
            return
        self.in_past = True
        self.clock, self.time, self.dt = moment.clock, moment.time, moment.segment.dt
        self.system, self.stepped, self.grabbed = moment.system, moment.stepped, moment.grabbed
        self.segment, self.reference.state = moment.segment, moment.reference
        if self.steppers != moment.segment.steppers:
            self.steppers = moment.segment.steppers
            self._start_lanes(moment.states)
        for lane, state in zip(self.lanes, moment.states, strict=True):
            lane.state = state

    def resume(self) -> None:
        """If the past is shown, it is now the present: what came after it has not happened."""
        if not self.in_past:
            return
        self.in_past = False
        self._history.forget_after(self.clock)
        self.recorder.forget_after(self.clock)
        self.recorder.take(self.steppers)
        self._pending = self._scene_changes(since=self.time)
        self._start_lanes([lane.state for lane in self.lanes])

    def _begin(self, states: Sequence[State], settings: Mapping[str, str] | None = None) -> None:
        """Begin a segment from these states. Args: settings: of the scene, where that can be named."""
        begin = tuple(at_rest_where_fixed(self.stepped, state) for state in states)
        self.segment = Segment(self.opened.name, settings, self.stepped, self.steppers, begin, self.dt)
        self._start_lanes(begin)

    def _start_lanes(self, states: Sequence[State]) -> None:
        """Lanes from these states; those that had stopped try again."""
        self.end()
        self.lanes = [
            Lane(name, self.stepped, state, self.dt, self.system, self._on_stop)
            for name, state in zip(self.steppers, states, strict=True)
        ]

    def _record(self) -> None:
        """Keep what there is now, for the plots and to go back to."""
        reference, states = self.reference.state, tuple(lane.state for lane in self.lanes)
        self.recorder.record(self.clock, self.time, self.lanes, reference, self.system)
        self._history.keep(
            Moment(self.clock, self.time, self.system, self.stepped, states, reference, self.segment, self.grabbed)
        )
