"""A step of any form on answers that are independent of one another (`reference.derivation.recording`)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from engines.own.stepping import OwnStep
from reference.errors import Fault
from reference.state import Array, State

if TYPE_CHECKING:
    from reference.derivation.recording import Advance, Recording, Slopes


def recording_of(make: Callable[[], OwnStep]) -> Recording | None:
    """What a step does with slopes; None where it asks for none, but has forces of its own.

    Args:
        make: the step anew, without memory of earlier calls.
    """
    from reference.derivation.recording import TooManyCalls, record

    step = make()
    if step.form not in ("slope", "acceleration", "system"):
        return None
    made: list[OwnStep] = []

    def advance() -> Advance:
        another = make()
        made.append(another)
        return _advance(another)

    try:
        found = record(advance)
    except (Fault, TooManyCalls):
        return None
    asked = found.solved is not None or any(s.points for row in found.unit for s in row)
    if not asked:
        return None
    return replace(found, timed="time" in step.roles and any(other.tells_time for other in made))


def _advance(step: OwnStep) -> Advance:
    def by_slope(slopes: Slopes, state: State, h: float) -> State:
        n = state.positions.size

        def slope(t: float, y: Array) -> Array:
            return np.concatenate(slopes(t, y[:n], y[n:]))

        y = np.concatenate([state.positions, state.velocities])
        end = step.after(y, state.time, h, slope)
        _overwritten(step, state)
        return State(state.time + h, end[:n], end[n:])

    def by_arrays(slopes: Slopes, state: State, h: float) -> State:
        def acceleration(x: Array, v: Array) -> Array:
            return slopes(state.time, x[:, 0], v[:, 0])[1][:, None]

        x, v = state.positions[:, None], state.velocities[:, None]
        end = step.after_pair(x, v, state.time, h, acceleration, _Asked(acceleration, len(x)))
        _overwritten(step, state)
        return State(state.time + h, end[0][:, 0], end[1][:, 0])

    return by_slope if step.form == "slope" else by_arrays


def _overwritten(step: OwnStep, state: State) -> None:
    """Tell the recording that the step wrote into what it was given: it was given a copy."""
    if step.changes_input:
        state.positions[...] = np.nan


class _Asked:
    """A system of unit masses that answers accelerations and nothing else: who asks for more has forces of its own."""

    def __init__(self, acceleration: Callable[[Array, Array], Array], count: int) -> None:
        self.acceleration = acceleration
        self.forces = acceleration
        self.masses = np.ones(count)
        self.fixed = np.zeros(count, dtype=bool)

    def __getattr__(self, name: str) -> Any:
        raise Fault(f"it asks for system.{name}")
