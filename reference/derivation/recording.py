"""Answers to a stepper that asks for slopes, independent of one another: what it makes of them can then be read off.

The state is two unit vectors X and V of a large space, and the j-th answer is two more, p_j for x' and q_j for v'.
Whatever points and results a stepper comes to, their components are its coefficients. Steps follow one another, each
from new X and V, so that what it remembers of earlier ones shows as coefficients of older answers. All is done at two
step lengths, powers of two, so that powers of h are told apart. Then steps from dense vectors, at two sizes, show
whether it is linear in its answers at all.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from reference.errors import InputError
from reference.state import Array, State

#: The dimension of the space: five steps of fifty calls have room.
DIMENSION = 512

#: Step lengths, and the time at the start.
LENGTHS, START = (1 / 4, 1 / 8), 2.0

#: So many steps are taken: whoever looks back further than four is not recognised.
STEPS = 5

#: A stepper that asks more often in a step iterates.
MOST_CALLS = 48

#: One that solves equations asks up to so often.
MOST_SOLVING = 20_000

#: So many steps in a row are then taken, for what looks back.
ROW = 8

#: Gives x' and v' at a time [s], positions and velocities, each shape (n,).
Slopes = Callable[[float, Array, Array], tuple[Array, Array]]

#: A stepper: slopes, a state with arrays of shape (n,), h [s] -> the state after it.
Advance = Callable[[Slopes, State, float], State]


class TooManyCalls(BaseException):
    """A step asks more than MOST_CALLS times."""


@dataclass
class Step:
    """A step: every point asked, with the answer given to it, and where the step came to.

    Attributes:
        times: at which it asked [s].
        points: (x, v) at which it asked.
        answers: (x', v') that it was given.
        start: where it began.
        end: where it came to.
    """

    h: float
    times: list[float] = field(default_factory=list)
    points: list[tuple[Array, Array]] = field(default_factory=list)
    answers: list[tuple[Array, Array]] = field(default_factory=list)
    start: tuple[Array, Array] = (np.zeros(0), np.zeros(0))
    end: tuple[Array, Array] = (np.zeros(0), np.zeros(0))
    begun_at: float = START
    overwrites: bool = False

    def take(self, advance: Advance, answer: Slopes, state: State, most: int = MOST_CALLS) -> State:
        """Do it."""

        def asked(time: float, x: Array, v: Array) -> tuple[Array, Array]:
            if len(self.times) >= most:
                raise TooManyCalls
            self.times.append(float(time))
            self.points.append((np.array(x), np.array(v)))
            given = answer(time, x, v)
            self.answers.append(given)
            return given[0].copy(), given[1].copy()

        self.begun_at = state.time
        self.start = state.positions.copy(), state.velocities.copy()
        end = advance(asked, state, self.h)
        self.overwrites = not (
            np.array_equal(self.start[0], state.positions) and np.array_equal(self.start[1], state.velocities)
        )
        self.end = np.array(end.positions, float), np.array(end.velocities, float)
        if self.end[0].shape != self.start[0].shape:
            raise InputError(f"it returns arrays of shape {self.end[0].shape}: expected {self.start[0].shape}")
        return end


@dataclass(frozen=True, eq=False)
class Solved:
    """A step that solves equations, with slopes that are not linear: y is all unknowns in a row.

    Attributes:
        start, end: y before and after it.
        points: every y it asked at, in order.
        slopes: what it was answered.
        states: y0, and y after each of a row of steps from there.
        rates: the slopes at these.
        parts: at what parts of h the step said that it asked, in order.
        calls: how often it asked; and how often a step asks whose slopes are a thousandth of these.
        overwrites: whether it wrote into y0.
    """

    h: float
    start: Array
    end: Array
    points: tuple[Array, ...]
    slopes: tuple[Array, ...]
    states: tuple[Array, ...]
    rates: tuple[Array, ...]
    parts: tuple[float, ...] = ()
    calls: tuple[int, int] = (0, 0)
    overwrites: bool = False


@dataclass(frozen=True)
class Recording:
    """What a stepper did.

    Attributes:
        unit: for each of LENGTHS, steps with unit answers.
        dense: single steps, each the STEPS-th of a row, with dense answers of two sizes.
        solved: where it asked more than MOST_CALLS times in a step, what it then did; and there is nothing else.
        timed: whether it says at what times it asks.
    """

    unit: tuple[tuple[Step, ...], ...] = ()
    dense: tuple[tuple[Step, ...], ...] = ()
    solved: Solved | None = None
    timed: bool = True

    @property
    def overwrites(self) -> bool:
        """Whether it writes into the state it is given."""
        solved = self.solved is not None and self.solved.overwrites
        return solved or any(step.overwrites for row in self.unit for step in row)


def record(advance: Callable[[], Advance], timed: bool = True) -> Recording:
    """Record a stepper.

    Args:
        advance: makes it anew, without memory.
        timed: whether the times at which it asks are its own.

    Raises:
        TooManyCalls: where it asks more than MOST_SOLVING times in a step.
    """
    try:
        unit = tuple(_unit_steps(advance(), h) for h in LENGTHS)
        dense = tuple(_dense_steps(advance(), size) for size in (1.0, 1e3))
    except TooManyCalls:
        return Recording(solved=_solved(advance(), advance()), timed=timed)
    return Recording(unit, dense, timed=timed)


def _unit_steps(advance: Advance, h: float) -> tuple[Step, ...]:
    used = 0

    def fresh() -> Array:
        nonlocal used
        if used >= DIMENSION:
            raise TooManyCalls
        vector = np.zeros(DIMENSION)
        vector[used] = 1.0
        used += 1
        return vector

    def answer(time: float, x: Array, v: Array) -> tuple[Array, Array]:
        return fresh(), fresh()

    steps, state = [], State(START, np.zeros(1), np.zeros(1))
    for i in range(STEPS):
        state = State(START + i * h, fresh(), fresh(), state.memory)
        steps.append(Step(h))
        state = steps[-1].take(advance, answer, state)
    return tuple(steps)


def _dense_steps(advance: Advance, size: float) -> tuple[Step, ...]:
    random = np.random.default_rng(3)

    def dense() -> Array:
        return size * random.normal(size=16)

    def answer(time: float, x: Array, v: Array) -> tuple[Array, Array]:
        return dense(), dense()

    h, steps, state = LENGTHS[0], [], State(START, np.zeros(1), np.zeros(1))
    for i in range(STEPS):
        state = State(START + i * h, dense(), dense(), state.memory)
        steps.append(Step(h))
        state = steps[-1].take(advance, answer, state)
    return tuple(steps)


def _solved(advance: Advance, another: Advance) -> Solved:
    """Steps of equations of which every unknown is its own: l y + m cos(2 y) + n + sin(3 y)/3, with its own numbers."""
    random = np.random.default_rng(11)
    size, h = 12, LENGTHS[0]
    linear, bent, constant = (random.uniform(-1, 1, 2 * size) for _ in range(3))

    def answer(time: float, x: Array, v: Array) -> tuple[Array, Array]:
        y = np.concatenate([x, v])
        slope = linear * y + 0.5 * bent * np.cos(2 * y) + constant + np.sin(3 * y) / 3
        return slope[:size], slope[size:]

    state = State(START, random.uniform(-1, 1, size), random.uniform(-1, 1, size))
    states = [state]
    step = Step(h)
    states.append(step.take(advance, answer, state, MOST_SOLVING))
    while len(states) <= ROW:
        states.append(Step(h).take(advance, answer, states[-1], MOST_SOLVING))
    gentle = Step(h)

    def gently(time: float, x: Array, v: Array) -> tuple[Array, Array]:
        slope_x, slope_v = answer(time, x, v)
        return slope_x / 1024, slope_v / 1024

    gentle.take(another, gently, state, MOST_SOLVING)
    ys = [np.concatenate([s.positions, s.velocities]) for s in states]
    rates = [np.concatenate(answer(s.time, s.positions, s.velocities)) for s in states]
    row = [np.concatenate(pair) for pair in (step.start, step.end)]
    points, slopes = (tuple(map(np.concatenate, pairs)) for pairs in (step.points, step.answers))
    parts = tuple((time - step.begun_at) / h for time in step.times)
    calls = len(step.times), len(gentle.times)
    return Solved(h, row[0], row[1], points, slopes, tuple(ys), tuple(rates), parts, calls, step.overwrites)
