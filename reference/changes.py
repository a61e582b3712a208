"""Steps and what happens at them: how many there are, and parameters that change on the fly (lecture slide 12)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reference.errors import InputError

#: A trajectory keeps every step: beyond this many it would fill the memory.
MOST_STEPS = 10_000_000


@dataclass(frozen=True)
class Change:
    """A parameter that changes while the system moves (lecture slide 12).

    Attributes:
        time: when [s]; it takes effect at the start of the first step that begins then or later.
        parameter: one of PARAMETERS.
        value: the new value, for all masses or springs.
    """

    time: float
    parameter: str
    value: float

    def step(self, dt: float) -> int:
        """The index of the first step it acts on; a time within 1e-9 of a step's start counts as that start."""
        return int(np.ceil(self.time / dt - 1e-9))


def changes_by_step(changes: Sequence[Change], dt: float) -> dict[int, list[Change]]:
    """The changes in order of time, by the step they act on.

    Raises:
        InputError: for a time before the start, or not a number.
    """
    by_step: dict[int, list[Change]] = {}
    for change in sorted(changes, key=lambda c: c.time):
        if not (np.isfinite(change.time) and change.time >= 0):
            raise InputError(f"change time = {change.time:g}: expected a finite number >= 0 [s]")
        by_step.setdefault(change.step(dt), []).append(change)
    return by_step


def whole_steps(dt: float, duration: float) -> int:
    """The number of steps of dt [s] nearest to a duration [s].

    Raises:
        InputError: unless both are positive numbers and there is at least one step.
    """
    for name, value in (("dt", dt), ("duration", duration)):
        if not (np.isfinite(value) and value > 0):
            raise InputError(f"{name} = {value:g}: expected a finite number > 0 [s]")
    steps = round(min(duration / dt, 2.0 * MOST_STEPS))
    if steps < 1:
        raise InputError(f"duration = {duration:g}: expected at least one step of dt = {dt:g} s")
    if steps > MOST_STEPS:
        raise InputError(f"duration = {duration:g}: expected at most {MOST_STEPS:,} steps of dt = {dt:g} s")
    return steps
