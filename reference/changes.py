"""Steps and what happens at them: how many there are, and parameters that change on the fly (lecture slide 12)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from reference.errors import InputError
from reference.state import State
from reference.system import HELD, MassSpringSystem, Value

#: A trajectory keeps every step: beyond this many it would fill the memory.
MOST_STEPS = 10_000_000

#: And where something changes at every step, that alone would take seconds.
MOST_DRIVEN = 100_000

#: The range of dt and of durations [s]: products with a few other numbers are numbers, too.
SHORTEST, LONGEST = 1e-100, 1e100


@dataclass(frozen=True)
class Change:
    """A parameter that changes while the system moves (lecture slide 12).

    Attributes:
        time: when [s]; it takes effect at the start of the first step that begins then or later.
        parameter: one of PARAMETERS; or a pull, `pull.MASS.AXIS`; or `hold` or `release`, of masses; or `break`, of
            springs.
        value: the new value, one number for all, or one for each mass, spring or axis (kept as a tuple); of masses that
            are held where they are, or let go from rest, and of springs that break, their numbers.
    """

    time: float
    parameter: str
    value: Value

    def __post_init__(self) -> None:
        if not isinstance(self.value, int | float | tuple):
            object.__setattr__(self, "value", tuple(float(number) for number in self.value))

    def step(self, dt: float) -> int:
        """The index of the first step it acts on; a time within 1e-9 of a step's start counts as that start.

        For times beyond all runs it is one that no run comes to.
        """
        return int(min(np.ceil(self.time / dt - 1e-9), 2.0 * MOST_STEPS))


def applied(change: Change, system: MassSpringSystem, state: State) -> tuple[MassSpringSystem, State]:
    """The system and its state after a change: a mass that is held is at rest from then on.

    What a multistep scheme remembers of before is forgotten where masses are held or let go.

    Raises:
        InputError: as `with_parameter` does.
    """
    system = system.with_parameter(change.parameter, change.value)
    if change.parameter not in HELD:
        return system, state
    if len(state.velocities) != len(system.fixed):
        raise InputError(f"{change.parameter}: masses on rods are neither held nor released on the fly")
    velocities = np.where(system.fixed.reshape(-1, *(1,) * (state.velocities.ndim - 1)), 0.0, state.velocities)
    return system, State(state.time, state.positions, velocities)


class Drive(Protocol):
    """What changes a system all the time while it moves: the ground under it, a truck that crosses it."""

    @property
    def parameter(self) -> str:
        """Which of PARAMETERS it changes."""

    def changes(self, system: MassSpringSystem, dt: float, duration: float) -> Sequence[Change]:
        """The changes, in order of time, for steps of dt [s] that together make a duration [s]."""


@dataclass(frozen=True, eq=False)
class Driven:
    """A system, and what drives it: what the function of a scene may return in place of a system alone.

    Raises:
        InputError: where two drives change the same parameter: one would undo what the other does.
    """

    system: MassSpringSystem
    drives: tuple[Drive, ...] = ()

    def __post_init__(self) -> None:
        driven = [drive.parameter for drive in self.drives]
        for name in driven:
            if driven.count(name) > 1:
                raise InputError(f"{name} is driven {driven.count(name)} times: expected once")

    @property
    def ground_moves(self) -> bool:
        """Whether gravity changes as it does seen from ground that moves, and not by itself."""
        return any(getattr(drive, "moves_ground", False) for drive in self.drives)

    def changes(self, dt: float, duration: float) -> tuple[Change, ...]:
        """What the drives change, one drive after the other. Raises InputError beyond MOST_DRIVEN steps."""
        if self.drives and whole_steps(dt, duration) > MOST_DRIVEN:
            raise InputError(
                f"duration = {duration:g}: expected at most {MOST_DRIVEN:,} steps of dt = {dt:g} s where the ground or "
                "the load moves"
            )
        return tuple(change for drive in self.drives for change in drive.changes(self.system, dt, duration))


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
        if not SHORTEST <= value <= LONGEST:
            raise InputError(f"{name} = {value:g}: expected a number from {SHORTEST:g} to {LONGEST:g} [s]")
    steps = round(min(duration / dt, 2.0 * MOST_STEPS))
    if steps < 1:
        raise InputError(f"duration = {duration:g}: expected at least one step of dt = {dt:g} s")
    if steps > MOST_STEPS:
        raise InputError(f"duration = {duration:g}: expected at most {MOST_STEPS:,} steps of dt = {dt:g} s")
    return steps
