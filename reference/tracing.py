"""A scheme's own function, run on symbols in place of numbers: what is left is the list of what it computes.

There is one definition of each scheme, the function a student reads. For speed it must become a loop over masses that
a compiler sees as a whole. So the function is called once with symbols for positions, velocities and dt. Every
operation on a symbol writes itself down, and every acceleration asked for begins a new stage: before it, all masses
must be where the scheme wants them. The arithmetic is kept in its order, so that loop and function agree to the bit.
"""

from __future__ import annotations

from dataclasses import dataclass

from reference.catalogue import Scheme
from reference.state import Slope, State


class Symbol:
    """An expression being written: text of Python that is true for each mass and axis alone."""

    shape: tuple[int, ...] = ()

    def __init__(self, text: str) -> None:
        self.text = text

    def __repr__(self) -> str:
        return self.text

    def _with(self, operator: str, other: object, turned: bool = False) -> Symbol:
        if not isinstance(other, Symbol | float | int):
            return NotImplemented
        left, right = (other, self) if turned else (self, other)
        return Symbol(f"({left!r} {operator} {right!r})")

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
