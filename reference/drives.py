"""Parameters that change all the time: in a straight line from one value to another, or as a sine.

Through a step a parameter is held at what it is in the step's middle, as the ground's motion is
(`scenes.ground_motion`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reference.changes import Change, whole_steps
from reference.errors import InputError, unknown_name
from reference.pulls import is_pull
from reference.state import Array
from reference.system import PARAMETERS, MassSpringSystem


@dataclass(frozen=True)
class Ramp:
    """A parameter goes from the value that the system has to another one: a Drive.

    Attributes:
        parameter: one of PARAMETERS, or a pull (`pull.3.y`).
        begin, end: when [s].
        value: what it is from then on, one number for all.
    """

    parameter: str
    begin: float
    end: float
    value: float

    def __post_init__(self) -> None:
        _known(self.parameter)
        if not 0 <= self.begin < self.end < np.inf:
            raise InputError(
                f"ramp of {self.parameter} from {self.begin:g} to {self.end:g} s: expected 0 <= begin < end"
            )

    def changes(self, system: MassSpringSystem, dt: float, duration: float) -> list[Change]:
        """One at every step between begin and end, and the last value after it."""
        target = system.with_parameter(self.parameter, self.value).numbers_of(self.parameter)

        def value(times: Array, first: Array) -> Array:
            part = np.clip((times - self.begin) / (self.end - self.begin), 0.0, 1.0)
            return np.asarray(first + part[:, None] * (target - first))

        return _changes(self.parameter, system, dt, duration, value)


@dataclass(frozen=True)
class Sine:
    """A parameter swings about the value that the system has, by A sin(2 pi f (t - begin)): a Drive.

    Attributes:
        parameter: one of PARAMETERS, or a pull.
        begin: when that begins [s].
        amplitude: A, in the parameter's unit; of gravity downwards, as its number is.
        frequency: f [Hz].
    """

    parameter: str
    begin: float
    amplitude: float
    frequency: float

    def __post_init__(self) -> None:
        _known(self.parameter)
        if not 0 <= self.begin < np.inf:
            raise InputError(f"sine of {self.parameter} from {self.begin:g} s: expected a time >= 0")
        if not 0 < self.frequency < np.inf:
            raise InputError(f"sine of {self.parameter} at {self.frequency:g} Hz: expected a finite number > 0")
        if not np.isfinite(self.amplitude):
            raise InputError(f"sine of {self.parameter} by {self.amplitude:g}: expected a finite number")

    def changes(self, system: MassSpringSystem, dt: float, duration: float) -> list[Change]:
        """One at every step from begin on. Raises InputError where the parameter would become what it cannot be."""
        along = np.ones_like(system.numbers_of(self.parameter))
        if self.parameter == "gravity":
            along = system.with_parameter("gravity", 1.0).numbers_of("gravity")

        def value(times: Array, first: Array) -> Array:
            phase = 2 * np.pi * self.frequency * (times - self.begin)
            swing = np.where(times > self.begin, self.amplitude * np.sin(phase), 0.0)
            return np.asarray(first + swing[:, None] * along)

        return _changes(self.parameter, system, dt, duration, value)


def _known(parameter: str) -> None:
    if parameter not in PARAMETERS and not is_pull(parameter):
        raise unknown_name("parameter", parameter, PARAMETERS)


def _changes(
    parameter: str, system: MassSpringSystem, dt: float, duration: float, value: Callable[[Array, Array], Array]
) -> list[Change]:
    """A change at every step at which the parameter is another than before."""
    starts: Array = dt * np.arange(whole_steps(dt, duration), dtype=float)
    first = system.numbers_of(parameter)
    values = value(starts + dt / 2, first)
    another = (np.diff(values, axis=0, prepend=first[None]) != 0).any(axis=1)
    pairs = zip(starts[another].tolist(), values[another].tolist(), strict=True)
    return [Change(time, parameter, tuple(numbers)) for time, numbers in pairs]
