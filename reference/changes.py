"""Parameters that change on the fly, while the system moves (lecture slide 12)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reference.errors import InputError


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
