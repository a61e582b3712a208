"""The live lab without a page: worlds side by side on one scene, everything to be changed while they move."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from reference.errors import InputError
from reference.state import Array, State
from report.live.cursor import at_rest_where_fixed, hook, on_hook, pinned, with_cursor, without_last
from report.live.history import History
from report.live.parameters import own_value
from report.live.recorder import Measures
from report.live.reproduction import Reproduction, reproduction
from report.live.stepping import checked
from report.live.timeline import Course


class Lab(Course):
    """Worlds on one scene, and what people do with them. See Course for how they go on."""

    def play(self) -> None:
        """Go; after a blow-up, from the start. What hung on the cursor in the past does not any more."""
        if any(world.stopped for world in self.worlds) and self._at is None:
            self.reset()
        if self._at is not None:
            self.release()
        self.playing = True

    def set_dt(self, dt: float) -> None:
        """Another step [s]; the motion goes on. Raises InputError unless it is a number > 0."""
        if not (math.isfinite(dt) and dt > 0):
            raise InputError(f"dt = {dt:g}: expected a number > 0 [s]")
        if dt != self._dt:
            self._go_on_from_here()
            self._dt = dt
            self._again()

    def set_parameter(self, name: str, number: float) -> None:
        """A parameter for all masses or springs, on the fly; where they differ, a multiple of what each has itself.

        Raises:
            InputError: for what makes no sense.
        """
        value = own_value(self.opened.system, name, number)
        self.own.with_parameter(name, value)
        self._go_on_from_here()
        self.numbers[name] = number
        self._change(name, value)
        self._ask()

    def set_steppers(self, names: Sequence[str]) -> None:
        """Another stepper goes on where the one before it was; a new world begins where the first one is.

        Raises:
            InputError: for an unknown name, none, or too many.
        """
        names = checked(names)
        if names == self._steppers:
            return
        self._go_on_from_here()
        states = [world.state for world in self.worlds]
        self._steppers = names
        states = [states[i] if i < len(states) else states[0] for i in range(len(names))]
        if self.stretch.steps == 0 and self.time == 0:
            self.reset()
            return
        self._begin(None, states)
        self._history, self.measures = History(), Measures(names)
        self._ask()
        self._record()

    @property
    def grabbed(self) -> int | None:
        """The mass that hangs on the cursor; while the past is looked at, that did then."""
        return self._grabbed if self._at is None else self._at.grabbed

    def grab(self, mass: int, place: Array) -> None:
        """Hang a mass on the cursor, in every world, or move the cursor it hangs on. place: [m], shape (d,)."""
        if not 0 <= mass < len(self.own.masses) or self.own.fixed[mass] or not np.isfinite(place).all():
            return
        self._go_on_from_here()
        states = [self._without_cursor(world.state) for world in self.worlds]
        true = None if self._truth.state is None else self._without_cursor(self._truth.state)
        self._grabbed, self.system = mass, with_cursor(self.own, mass, place)
        end = hook(self.own, place)
        self._truth.state = None if true is None else on_hook(true, end)
        self._begin(None, [on_hook(state, end) for state in states])

    def release(self) -> None:
        """Let go of the mass on the cursor."""
        if self.grabbed is None:
            return
        self._go_on_from_here()
        states = [self._without_cursor(world.state) for world in self.worlds]
        self._truth.state = None if self._truth.state is None else self._without_cursor(self._truth.state)
        self._grabbed, self.system = None, self.own
        self._begin(None, states)

    def toggle_pin(self, mass: int) -> None:
        """Fix a free mass where it is, or let go of a fixed one."""
        if not 0 <= mass < len(self.own.masses):
            return
        self.release()
        self._go_on_from_here()
        self.own = self.system = pinned(self.own, mass)
        if self._truth.state is not None:
            self._truth.state = at_rest_where_fixed(self.own, self._truth.state)
        self._again()

    def _without_cursor(self, state: State) -> State:
        return state if self._grabbed is None else without_last(state)

    def reproduction(self) -> Reproduction:
        """The commands that come to what is seen."""
        return reproduction(self._at.stretch if self._at else self.stretch)
