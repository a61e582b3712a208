"""A state at a time, its rate of change, and the trajectory a run leaves behind. Needs NumPy only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from reference.errors import InputError

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class State:
    """Where everything is and how fast it moves at one time.

    Attributes:
        time: [s].
        positions: shape (n, d) [m]; for a pendulum its angles, shape (n,) [rad].
        velocities: the same shape [m/s] or [rad/s].
        memory: what a multistep scheme keeps of earlier steps, arrays of the same shape. Empty at the start and for
            one-step schemes; a new state has none unless it is given some.
    """

    time: float
    positions: Array
    velocities: Array
    memory: tuple[Array, ...] = ()

    def __post_init__(self) -> None:
        if self.positions.shape != self.velocities.shape:
            raise InputError(
                f"velocities has shape {self.velocities.shape}: expected that of positions, {self.positions.shape}"
            )

    def __add__(self, change: Slope) -> State:
        """The state moved by a slope that has been multiplied by a time."""
        return State(self.time + change.time, self.positions + change.positions, self.velocities + change.velocities)

    def kick(self, change: Array) -> State:
        """The same positions with other velocities: what a force alone does."""
        return State(self.time, self.positions, self.velocities + change)

    def remembering(self, *memory: Array) -> State:
        """The same state with something for the next step to look back at."""
        return State(self.time, self.positions, self.velocities, memory)

    def drift(self, dt: float) -> State:
        """Everything moved on for dt [s] at the velocity it has: what no force at all does."""
        return State(self.time + dt, self.positions + dt * self.velocities, self.velocities)


@dataclass(frozen=True, eq=False, slots=True)
class Slope:
    """The rate of change of a state: of time (1), of positions (velocities), of velocities (accelerations)."""

    time: float
    positions: Array
    velocities: Array

    def __rmul__(self, factor: float) -> Slope:
        return Slope(factor * self.time, factor * self.positions, factor * self.velocities)

    def __add__(self, other: Slope) -> Slope:
        return Slope(self.time + other.time, self.positions + other.positions, self.velocities + other.velocities)


@dataclass(frozen=True, eq=False)
class Trajectory:
    """What a run leaves behind: the states at times[0], times[1], ...

    Attributes:
        times: shape (m,) [s].
        positions: shape (m, n, d) [m].
        velocities: shape (m, n, d) [m/s]; NaN where an engine does not tell.
    """

    times: Array
    positions: Array
    velocities: Array

    def __post_init__(self) -> None:
        m = len(self.times)
        if self.positions.ndim != 3 or len(self.positions) != m:
            raise InputError(f"positions has shape {self.positions.shape}: expected ({m}, n, d) for {m} times")
        if self.velocities.shape != self.positions.shape:
            raise InputError(
                f"velocities has shape {self.velocities.shape}: expected that of positions, {self.positions.shape}"
            )

    def __len__(self) -> int:
        return len(self.times)

    @classmethod
    def of(cls, states: list[State]) -> Trajectory:
        """The trajectory through a list of states."""
        return cls(
            np.array([s.time for s in states]),
            np.array([s.positions for s in states]),
            np.array([s.velocities for s in states]),
        )

    def frames(self, which: slice | list[int]) -> Trajectory:
        """The trajectory at some of its times only."""
        return Trajectory(self.times[which], self.positions[which], self.velocities[which])

    def states(self) -> list[State]:
        """The states, one per time."""
        return [State(t, x, v) for t, x, v in zip(self.times.tolist(), self.positions, self.velocities, strict=True)]

    def distance(self, other: Trajectory) -> Array:
        """How far apart the two are at each time: the largest distance of any mass [m], shape (m,).

        Where one ends before the other (it blew up), or is not a number, the distance is infinite.
        """
        return _apart(self.positions, other.positions)

    def velocity_difference(self, other: Trajectory) -> Array:
        """How far apart their velocities are at each time: the largest difference of any mass [m/s], shape (m,).

        Infinite as `distance` is.
        """
        return _apart(self.velocities, other.velocities)


def _apart(one: Array, other: Array) -> Array:
    """The largest distance of any mass in each frame; infinite where one has ended, or is not a number."""
    m = max(len(one), len(other))
    result = np.full(m, np.inf)
    both = min(len(one), len(other))
    with np.errstate(over="ignore", invalid="ignore"):
        difference = one[:both] - other[:both]
        apart = np.sqrt((difference * difference).sum(axis=2).max(axis=1))
    result[:both] = np.where(np.isfinite(apart), apart, np.inf)
    return result
