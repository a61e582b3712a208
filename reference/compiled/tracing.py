"""A scheme's own function, run on symbols in place of numbers: what is left is the list of what it computes.

There is one definition of each scheme, the function a student reads. For speed it must become a loop over masses that
a compiler sees as a whole. So the function is called once with symbols for positions, velocities and dt. Every
operation on a symbol writes itself down (`expressions`), and every acceleration asked for begins a new stage: before
it, all masses must be where the scheme wants them. The arithmetic is kept in its order.

The same goes for obstacles: what they do to a mass is a function of numbers, and called once with symbols.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from functools import cache
from typing import Any

from reference.compiled.expressions import Expression, Scalar, Symbol, Untraceable
from reference.errors import Unsupported
from reference.obstacles import Obstacle
from reference.schemes.catalogue import Scheme
from reference.state import Slope, State

#: The positions and velocities of a mass.
Place = tuple[Expression, Expression]


@dataclass(frozen=True)
class Program:
    """What a scheme computes in a step, in terms of x, v, the accelerations a0, a1, ... of its stages, and c0, c1, ...

    Of Heun the stages are (x, v) and (x + c0 v, v + c0 a0), and the end is (x + c1 (v + (v + c0 a0)), v + c1 (a0 +
    a1)), with c0 = dt and c1 = dt / 2.

    Attributes:
        stages: (positions, velocities) at which each acceleration is asked for.
        end: (positions, velocities) of the new state.
        coefficients: how c0, c1, ... are made of dt, with their texts.
    """

    stages: tuple[Place, ...]
    end: Place
    coefficients: tuple[tuple[str, Callable[[float], Any]], ...] = ()

    def numbers(self, dt: float) -> list[float]:
        """C0, c1, ... for a step of dt [s]."""
        return [float(value(dt)) for _, value in self.coefficients]


class TracedMotion:
    """Equations of motion that only take note of where accelerations are asked for."""

    def __init__(self, known: dict[str, Callable[[float], Any]]) -> None:
        self._known = known
        self.stages: list[Place] = []

    def acceleration(self, state: State) -> Symbol:
        """A new symbol a0, a1, ..., one per stage."""
        self.stages.append(_place(state))
        return Symbol(f"a{len(self.stages) - 1}")

    def slope(self, state: State) -> Slope:
        """As SpringMotion.slope, of symbols."""
        return Slope(1.0, state.velocities, self.acceleration(state))  # type: ignore[arg-type]


@cache
def trace(scheme: Scheme) -> Program:
    """The program of a scheme.

    Raises:
        Unsupported: with the reason, for a scheme that cannot be traced: it runs as it is written, and no faster.
    """
    if scheme.needs != "accelerations":
        raise Unsupported(f"{scheme.name} is not compiled: it needs {scheme.needs}")
    if not scheme.one_step:
        raise Unsupported(f"{scheme.name} is not compiled: it remembers earlier steps")
    known: dict[str, Callable[[float], Any]] = {}
    motion = TracedMotion(known)
    x, v = Symbol("x"), Symbol("v")
    dt = Scalar(lambda dt: dt, "dt", known)
    try:
        end = scheme.on(motion)(State(0.0, x, v), dt)  # type: ignore[arg-type]
        stages, last = tuple(motion.stages), _place(end)
    except (Untraceable, AttributeError, TypeError, ValueError, IndexError, ZeroDivisionError) as error:
        raise Unsupported(f"{scheme.name} is not compiled: {error}") from None
    if not stages:
        raise Unsupported(f"{scheme.name} is not compiled: it asks for no acceleration")
    return Program(stages, last, tuple(known.items()))


def why_not_compiled(scheme: Scheme) -> str | None:
    """Why a scheme runs as it is written only, or None where it can be compiled."""
    try:
        trace(scheme)
    except Unsupported as reason:
        return str(reason)
    return None


def _place(state: State) -> Place:
    if not (isinstance(state.positions, Symbol) and isinstance(state.velocities, Symbol)):
        raise Untraceable("its states are not made of the one it was given")
    return state.positions.expression, state.velocities.expression


@dataclass(frozen=True)
class ObstacleProgram:
    """What a row of obstacles does to a mass, in terms of place0, place1, ..., velocity0, ..., and `free`.

    Attributes:
        lines: of Python, one after the other.
        place: the texts of where it is then, one per axis.
        velocity: the texts of how it moves.
        numbers: how many o0, o1, ... there are: all those the obstacles are described by.
    """

    lines: tuple[str, ...]
    place: tuple[str, ...]
    velocity: tuple[str, ...]
    numbers: int


def trace_obstacles(obstacles: Sequence[Obstacle], dimension: int) -> ObstacleProgram:
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
        place, velocity = of_symbols.project(place, velocity, Symbol("free", lines))  # type: ignore[assignment]
    return ObstacleProgram(tuple(lines), tuple(map(repr, place)), tuple(map(repr, velocity)), counted)


def numbers_of(obstacles: Sequence[Obstacle]) -> list[float]:
    """The numbers o0, o1, ... of a row of obstacles."""
    values = [getattr(obstacle, f.name) for obstacle in obstacles for f in fields(obstacle)]
    return [float(number) for v in values for number in (v if isinstance(v, tuple) else (v,))]
