"""A scheme's own function, run on symbols in place of numbers: what is left is the list of what it computes.

There is one definition of each scheme, the function a student reads. For speed it must become a loop over masses that
a compiler sees as a whole. So the function is called once with symbols for positions, velocities and dt. Every
operation on a symbol writes itself down, and every acceleration asked for begins a new stage: before it, all masses
must be where the scheme wants them. The arithmetic is kept in its order, so that loop and function agree to the bit.

The same goes for obstacles: what they do to a mass is a function of numbers, and called once with symbols.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import Any

import numpy as np

from reference.catalogue import Scheme
from reference.obstacles import Obstacle
from reference.state import Slope, State

#: What NumPy has that symbols know, besides their own operators.
OPERATIONS: Mapping[Any, str] = MappingProxyType(
    {
        np.add: "{} + {}",
        np.subtract: "{} - {}",
        np.multiply: "{} * {}",
        np.divide: "{} / {}",
        np.less: "{} < {}",
        np.greater: "{} > {}",
        np.sqrt: "np.sqrt({})",
        np.absolute: "np.abs({})",
        np.minimum: "np.minimum({}, {})",
        np.maximum: "np.maximum({}, {})",
        np.where: "{1} if {0} else {2}",
    }
)


class Symbol:
    """An expression being written: text of Python that is true for each mass and axis alone.

    Args:
        text: what it is.
        notes: where every operation is noted down as a line of its own; else the text of the result has it all.
    """

    shape: tuple[int, ...] = ()

    def __init__(self, text: str, notes: list[str] | None = None) -> None:
        self.text = text
        self._notes = notes

    def __repr__(self) -> str:
        return self.text

    def _made(self, text: str) -> Symbol:
        if self._notes is None:
            return Symbol(f"({text})")
        self._notes.append(f"t{len(self._notes)} = {text}")
        return Symbol(f"t{len(self._notes) - 1}", self._notes)

    def _with(self, operator: str, other: object, turned: bool = False) -> Symbol:
        if not isinstance(other, Symbol | float | int):
            return NotImplemented
        left, right = (other, self) if turned else (self, other)
        return self._made(f"{left!r} {operator} {right!r}")

    def __array_ufunc__(self, function: Any, method: str, *inputs: Any, **_: Any) -> Symbol:
        """What NumPy's own functions of numbers do with a symbol."""
        if function not in OPERATIONS or method != "__call__":
            return NotImplemented
        known = [repr(i if isinstance(i, Symbol) else float(i)) for i in inputs]
        return self._made(OPERATIONS[function].format(*known))

    def __array_function__(self, function: Any, _: Any, inputs: Any, __: Any) -> Symbol:
        """What its functions of arrays do."""
        return self.__array_ufunc__(function, "__call__", *inputs)

    def __lt__(self, other: object) -> Symbol:
        return self._with("<", other)

    def __gt__(self, other: object) -> Symbol:
        return self._with(">", other)

    def __and__(self, other: object) -> Symbol:
        return self._with("&", other)

    def __add__(self, other: object) -> Symbol:
        return self._with("+", other)

    def __radd__(self, other: object) -> Symbol:
        return self._with("+", other, turned=True)

    def __sub__(self, other: object) -> Symbol:
        return self._with("-", other)

    def __rsub__(self, other: object) -> Symbol:
        return self._with("-", other, turned=True)

    def __mul__(self, other: object) -> Symbol:
        return self._with("*", other)

    def __rmul__(self, other: object) -> Symbol:
        return self._with("*", other, turned=True)

    def __truediv__(self, other: object) -> Symbol:
        return self._with("/", other)

    def __rtruediv__(self, other: object) -> Symbol:
        return self._with("/", other, turned=True)


@dataclass(frozen=True)
class Program:
    """What a scheme computes in a step, in terms of x, v, dt and the accelerations a0, a1, ... of its stages.

    Attributes:
        stages: (positions, velocities) at which each acceleration is asked for.
        end: (positions, velocities) of the new state.
    """

    stages: tuple[tuple[str, str], ...]
    end: tuple[str, str]


class TracedMotion:
    """Equations of motion that only take note of where accelerations are asked for."""

    def __init__(self) -> None:
        self.stages: list[tuple[str, str]] = []

    def acceleration(self, state: State) -> Symbol:
        """A new symbol a0, a1, ..., one per stage."""
        self.stages.append((repr(state.positions), repr(state.velocities)))
        return Symbol(f"a{len(self.stages) - 1}")

    def slope(self, state: State) -> Slope:
        """As SpringMotion.slope, of symbols."""
        return Slope(1.0, state.velocities, self.acceleration(state))  # type: ignore[arg-type]


def trace(scheme: Scheme) -> Program:
    """The program of an explicit scheme that treats all springs alike (`springs_only` is False)."""
    motion = TracedMotion()
    x, v, dt = Symbol("x"), Symbol("v"), Symbol("dt")
    end = scheme.step(motion, State(0.0, x, v), dt)  # type: ignore[arg-type]
    return Program(tuple(motion.stages), (repr(end.positions), repr(end.velocities)))


@dataclass(frozen=True)
class Barriers:
    """What a row of obstacles does to a mass, in terms of place0, place1, ..., velocity0, ..., and `free`.

    Attributes:
        lines: of Python, one after the other.
        place: the texts of where it is then, one per axis. velocity: of how it moves.
        numbers: how many o0, o1, ... there are: all those the obstacles are described by.
    """

    lines: tuple[str, ...]
    place: tuple[str, ...]
    velocity: tuple[str, ...]
    numbers: int


def trace_obstacles(obstacles: Sequence[Obstacle], dimension: int) -> Barriers:
    """What obstacles do to a mass, whatever their numbers are: only kinds and order are in the text."""
    lines: list[str] = []
    place, velocity = ([Symbol(f"{q}{i}", lines) for i in range(dimension)] for q in ("place", "velocity"))
    counted = 0
    for obstacle in obstacles:
        of_symbols = object.__new__(type(obstacle))
        for f in fields(obstacle):
            value = getattr(obstacle, f.name)
            count = len(value) if isinstance(value, tuple) else 1
            symbols = tuple(Symbol(f"o{counted + k}", lines) for k in range(count))
            object.__setattr__(of_symbols, f.name, symbols if isinstance(value, tuple) else symbols[0])
            counted += count
        place, velocity = of_symbols.meet(place, velocity, Symbol("free", lines))  # type: ignore[assignment]
    return Barriers(tuple(lines), tuple(map(repr, place)), tuple(map(repr, velocity)), counted)


def numbers_of(obstacles: Sequence[Obstacle]) -> list[float]:
    """The numbers o0, o1, ... of a row of obstacles."""
    values = [getattr(obstacle, f.name) for obstacle in obstacles for f in fields(obstacle)]
    return [float(number) for v in values for number in (v if isinstance(v, tuple) else (v,))]
