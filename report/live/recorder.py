"""What is measured of the worlds at every frame: energy, momentum, distance; for the plots and as CSV."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

import numpy as np

from reference.conserved import momentum
from reference.state import Array, State
from reference.system import MassSpringSystem
from report.live.lane import World, distance

#: So many frames are kept, five minutes of them.
FRAMES = 18_000


class Measures:
    """Rows of numbers, one for each frame: the lab's clock, the time, and three numbers for each world.

    Energy is in J. Momentum is how far its sum is from that of the true motion [kg m/s], distance how far the mass is
    that is farthest from where it truly is [m]. Where the true motion is not followed both are from the first world's,
    and of that one they are no numbers.
    """

    def __init__(self, names: Sequence[str]) -> None:
        self.names = tuple(names)
        self._rows: deque[tuple[float, ...]] = deque(maxlen=FRAMES)
        self._first: tuple[float, ...] = ()

    def __len__(self) -> int:
        return len(self._rows)

    def take(
        self, clock: float, time: float, worlds: Sequence[World], true: State | None, own: MassSpringSystem
    ) -> None:
        """One more row. Args: own: the system without a cursor's mass."""
        n = len(own.masses)
        right = true or worlds[0].state
        right_momentum = momentum(own, State(0.0, right.positions[:n], right.velocities[:n]))
        row = [clock, time]
        for world in worlds:
            state = State(0.0, world.state.positions[:n], world.state.velocities[:n])
            row.append(world.energy)
            known = true is not None or world is not worlds[0]
            row.append(float(np.linalg.norm(momentum(own, state) - right_momentum)) if known else np.nan)
            row.append(distance(state, right) if known else np.nan)
        self._rows.append(tuple(row))
        self._first = self._first or self._rows[0]

    @property
    def begin(self) -> Array:
        """The three numbers of each world in the very first row, shape (worlds, 3)."""
        return np.array(self._first[2:]).reshape(-1, 3)

    def forget_after(self, clock: float) -> None:
        """What came after has not happened."""
        while self._rows and self._rows[-1][0] > clock:
            self._rows.pop()

    def last(self, seconds: float, most: int) -> tuple[Array, Array]:
        """Times [s], shape (m,), and numbers, shape (m, worlds, 3), of the last seconds of the clock, m <= most."""
        rows: list[tuple[float, ...]] = []
        for row in reversed(self._rows):
            if self._rows[-1][0] - row[0] > seconds:
                break
            rows.append(row)
        table = np.array(rows[:: -max(1, -(-len(rows) // most))] if rows else np.zeros((0, 2 + 3 * len(self.names))))
        return table[:, 1], table[:, 2:].reshape(len(table), len(self.names), 3)

    def csv(self) -> str:
        """All rows."""
        columns = ["time [s]"]
        for i, name in enumerate(self.names):
            who = name if self.names.count(name) == 1 else f"{name} {i + 1}"
            columns += [f"{who} energy [J]", f"{who} momentum off [kg m/s]", f"{who} distance [m]"]
        lines = [",".join(columns), *(",".join(map(repr, row[1:])) for row in self._rows)]
        return "\n".join([*lines, ""])
