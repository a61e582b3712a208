"""A plane of two parameters, with a system at every point of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from reference.errors import InputError
from reference.state import Array
from reference.system import PARAMETERS, MassSpringSystem

#: What an axis can be.
AXES = ("dt", "masses", *PARAMETERS)

#: The values of the axes at a point, by name.
Point = Mapping[str, float]

#: Makes the system at a point, from the values of the axes (dt aside).
SystemAt = Callable[[Point], MassSpringSystem]


@dataclass(frozen=True)
class Axis:
    """One axis of a plane.

    Attributes:
        name: one of AXES; "masses" is how many.
        low, high: its range, in SI units.
    """

    name: str
    low: float
    high: float

    @property
    def heading(self) -> str:
        """Its name and its unit, for figures and tables."""
        units = {"dt": "s", "masses": "1", **{name: text.partition(",")[0] for name, text in PARAMETERS.items()}}
        return f"{self.name} [{units[self.name]}]"

    def values(self, count: int) -> Array:
        """Evenly spaced, from low to high; whole numbers for masses, as many as there are."""
        values = np.linspace(self.low, self.high, count)
        return np.unique(np.round(values)) if self.name == "masses" else values


@dataclass(frozen=True)
class Plane:
    """Two axes, and what they are parameters of.

    Attributes:
        x, y: the axes.
        system_at: makes the system at a point.
        dt: the step where no axis is dt [s].

    Raises:
        InputError: for an axis of no parameter, or a range that does not rise.
    """

    x: Axis
    y: Axis
    system_at: SystemAt
    dt: float

    def __post_init__(self) -> None:
        for axis in (self.x, self.y):
            if axis.name not in AXES:
                raise InputError(f"map axis {axis.name!r}: expected one of {', '.join(AXES)}")
            if not (np.isfinite([axis.low, axis.high]).all() and axis.low < axis.high):
                raise InputError(f"map axis {axis.name} from {axis.low:g} to {axis.high:g}: expected a rising range")

    @property
    def has_dt(self) -> bool:
        """Whether one of the axes is dt."""
        return "dt" in (self.x.name, self.y.name)

    @property
    def middle(self) -> Point:
        """The point in the middle, where nothing that an axis is about is switched off."""
        return {axis.name: (axis.low + axis.high) / 2 for axis in (self.x, self.y)}

    def points(self, x_values: Array, y_values: Array) -> list[Point]:
        """All pairs of the values, row by row: x varies fastest."""
        return [{self.x.name: float(x), self.y.name: float(y)} for y in y_values for x in x_values]

    def system(self, point: Point) -> MassSpringSystem:
        """The system at a point."""
        return self.system_at(self.parameters(point))

    def parameters(self, point: Point) -> Point:
        """The values that the system at a point depends on: all but dt."""
        return {name: value for name, value in point.items() if name != "dt"}

    def step(self, point: Point) -> float:
        """The dt at a point [s]."""
        return point.get("dt", self.dt)
