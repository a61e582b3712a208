"""The ground moves, and all supports with it: what earthquake engineers drive structures by (slide 29).

Seen from the ground, supports that all move alike with the acceleration a(t) are at rest, and gravity is g - a(t). That
is exact, for any system and any motion; where motions are small it is M u'' + C u' + K u = -M 1 a(t) (Chopra, *Dynamics
of Structures*, ch. 1 and 9). Drag is then relative to air that moves with the ground. So a ground motion is gravity
that changes on the fly, and every stepper that takes a change of gravity takes it.

Gravity is held constant through a step, at what it is in the step's middle: over a step that differs from the motion by
an odd function, and leaves an error of the order dt^2; held at what it is when the step begins, it would leave dt/2 of
delay.
"""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import ClassVar, Literal, Protocol, get_args

import numpy as np
import numpy.typing as npt

from reference.changes import Change, whole_steps
from reference.errors import InputError
from reference.files.regular_file import check_file
from reference.state import Array
from reference.system import MassSpringSystem

#: A record's file may be so large [bytes].
LARGEST_RECORD = 64 * 2**20

#: How the frequency of a sweep goes from one to the other.
Law = Literal["linear", "exponential"]


class Accelerogram(Protocol):
    """The acceleration of the ground against time."""

    def acceleration(self, times: Array) -> Array:
        """At times [s], shape (m,): along the first axes, shape (m, 1 to d) [m/s^2]; zero before and after."""


@dataclass(frozen=True)
class GroundMotion:
    """The ground under a system moves: a Drive.

    Attributes:
        ground: how.
        parameter: what changes for it.
    """

    ground: Accelerogram
    parameter: str = "gravity"
    moves_ground: ClassVar[bool] = True

    def changes(self, system: MassSpringSystem, dt: float, duration: float) -> list[Change]:
        """Gravity [m/s^2] at every step at which it is another than before; in the end it is the system's own.

        Raises:
            InputError: where the ground moves along more axes than the system has.
        """
        starts: Array = dt * np.arange(whole_steps(dt, duration), dtype=float)
        ground = self.ground.acceleration(starts + dt / 2)
        if ground.shape[1] > system.dimension:
            raise InputError(
                f"the ground moves along {ground.shape[1]} axes: expected at most the system's {system.dimension}"
            )
        gravity = np.tile(system.gravity, (len(starts), 1))
        gravity[:, : ground.shape[1]] -= ground
        another = (np.diff(gravity, axis=0, prepend=system.gravity[None]) != 0).any(axis=1)
        values = map(tuple, gravity[another].tolist())
        return [Change(time, "gravity", value) for time, value in zip(starts[another].tolist(), values, strict=True)]


@dataclass(frozen=True)
class FrequencySweep:
    """The ground shakes as a sine whose frequency goes from one to another.

    a(t) = A sin(2 pi times the integral of f from 0 to t), with f = f0 + (f1 - f0) t/T, linear, or f0 (f1/f0)^(t/T),
    exponential, which takes as long for each octave.

    Attributes:
        from_frequency: f0 [Hz].
        to_frequency: f1 [Hz]; the same for a plain sine.
        amplitude: A [m/s^2].
        duration: T [s].
        law: linear or exponential.
        direction: along which it shakes; its length does not matter.

    Raises:
        InputError: naming the field, the value, and what was expected.
    """

    from_frequency: float
    to_frequency: float
    amplitude: float
    duration: float
    law: Law = "linear"
    direction: tuple[float, ...] = (1.0,)

    def __post_init__(self) -> None:
        for name, unit in (("from_frequency", "Hz"), ("to_frequency", "Hz"), ("duration", "s")):
            if not 0 < getattr(self, name) < np.inf:
                raise InputError(f"{name} = {getattr(self, name):g}: expected a finite number > 0 [{unit}]")
        if not 0 <= self.amplitude < np.inf:
            raise InputError(f"amplitude = {self.amplitude:g}: expected a finite number >= 0 [m/s^2]")
        if self.law not in get_args(Law):
            raise InputError(f"law = {self.law!r}: expected one of {', '.join(get_args(Law))}")
        if not (1 <= len(self.direction) <= 3 and 0 < float(np.linalg.norm(self.direction)) < np.inf):
            raise InputError(f"direction = {list(self.direction)}: expected one to three finite numbers, not all zero")

    def frequency(self, times: npt.ArrayLike) -> Array:
        """F at times [s], shape (m,) [Hz]."""
        part = np.asarray(times, dtype=np.float64) / self.duration
        if self.law == "linear":
            return np.asarray(self.from_frequency + (self.to_frequency - self.from_frequency) * part)
        return np.asarray(self.from_frequency * (self.to_frequency / self.from_frequency) ** part)

    @np.errstate(over="ignore", invalid="ignore")
    def acceleration(self, times: Array) -> Array:
        """See Accelerogram."""
        times = np.clip(times, 0.0, self.duration)  # at both ends it is outside
        inside = (times > 0) & (times < self.duration)
        octaves = np.log(self.to_frequency / self.from_frequency)
        if self.law == "linear" or octaves == 0:
            turns = (self.from_frequency + self.frequency(times)) / 2 * times
        else:
            turns = (self.frequency(times) - self.from_frequency) * self.duration / octaves
        shaking = np.where(inside, self.amplitude * np.sin(2 * np.pi * turns), 0.0)
        return np.outer(shaking, np.array(self.direction) / np.linalg.norm(self.direction))


@dataclass(frozen=True, eq=False)
class Record:
    """The ground moves as was recorded; in between along straight lines.

    Attributes:
        times: [s], rising, shape (r,).
        accelerations: along the first axes [m/s^2], shape (r, 1 to 3).
    """

    times: Array
    accelerations: Array

    def acceleration(self, times: Array) -> Array:
        """See Accelerogram."""
        columns = [np.interp(times, self.times, column, left=0.0, right=0.0) for column in self.accelerations.T]
        return np.stack(columns, axis=1)


def read_record(path: Path, scale: float = 1.0) -> Record:
    """An accelerogram from a CSV file: a header, then times [s] that rise and accelerations along the axes [m/s^2].

    Args:
        scale: what accelerations are multiplied by: 9.81 for a record in parts of the earth's.

    Raises:
        InputError: naming the file, the line, the column, the value, and what was expected.
    """
    if not isfinite(scale):
        raise InputError(f"scale = {scale:g}: expected a finite number")
    try:
        _check_file(path)
        with path.open(newline="", encoding="utf-8-sig") as file:
            lines = csv.reader(file)
            rows = [(lines.line_num, row) for row in lines if row]
        return _record(rows, scale)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or "expected lines of numbers with commas between them, in UTF-8"
        raise InputError(f"record {path}: {reason}") from None
    except InputError as error:
        raise InputError(f"record {path}{error}") from None


def _check_file(path: Path) -> None:
    try:
        check_file(path, LARGEST_RECORD)
    except InputError as error:
        raise InputError(f": {error}") from None


def _record(rows: Sequence[tuple[int, list[str]]], scale: float) -> Record:
    if not rows or _number(rows[0][1][0]) is not None:
        raise InputError(", line 1: expected a header, as: time [s], x [m/s^2]")
    header = rows[0][1]
    if not 2 <= len(header) <= 4:
        raise InputError(f", line 1: {len(header)} columns, expected two to four: time, then one for each axis")
    if len(rows) < 3:
        raise InputError(f": {len(rows) - 1} lines after the header, expected two or more")
    last = 0.0
    table: list[list[float]] = []
    for line, row in rows[1:]:
        if len(row) != len(header):
            raise InputError(f", line {line}: {len(row)} columns, expected {len(header)} as in the header")
        numbers = []
        for name, text in zip(header, row, strict=True):
            number = _number(text)
            if number is None or not isfinite(number):
                raise InputError(f", line {line}, column {name.strip()!r}: {text!r}, expected a finite number")
            numbers.append(number)
        if numbers[0] < last or (table and numbers[0] == last):
            what = "later than the line before" if table else ">= 0"
            raise InputError(
                f", line {line}, column {header[0].strip()!r}: {row[0].strip()}, expected a time {what} [s]"
            )
        last = numbers[0]
        table.append(numbers)
    values = np.array(table)
    with np.errstate(over="ignore"):
        accelerations = scale * values[:, 1:]
    if not np.isfinite(accelerations).all():
        raise InputError(f": scale = {scale:g} makes accelerations that are no finite numbers")
    return Record(values[:, 0], accelerations)


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None
