"""The recorder: what is measured of the lanes at every frame, energy, momentum and distance, for plots and as CSV."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

import numpy as np

from reference.conserved import momentum
from reference.state import Array, State
from reference.system import MassSpringSystem
from report.live.lane import Lane, distance

#: Frames that are kept, five minutes of them.
FRAMES = 18_000


class Recorder:
    """Rows of numbers, one for each frame: the timeline's clock, the time, and three numbers for each lane.

    Energy is in J. Momentum is how far its sum is from that of the true motion [kg m/s], distance how far the mass is
    that is farthest from where it truly is [m]. Where the true motion is not followed both are from the first lane's,
    and of that one they are NaN.
    """

    def __init__(self, names: Sequence[str]) -> None:
        self.names = tuple(names)
        self._rows: deque[tuple[float, ...]] = deque(maxlen=FRAMES)
        self._first: tuple[float, ...] = ()

    def __len__(self) -> int:
        return len(self._rows)

    def take(self, names: Sequence[str]) -> None:
        """Other lanes from now on: of a new one nothing is known before, and it begins as the first one did."""
        more = len(names) - len(self.names)
        if more:
            keep, unknown = 2 + 3 * min(len(names), len(self.names)), (np.nan,) * 3 * max(more, 0)
            rows = ((*row[:keep], *unknown) for row in self._rows)
            self._rows = deque(rows, maxlen=FRAMES)
            self._first = (*self._first[:keep], *self._first[2:5] * max(more, 0))
        self.names = tuple(names)

    def record(
        self, clock: float, time: float, lanes: Sequence[Lane], reference: State | None, system: MassSpringSystem
    ) -> None:
        """One more row.

        Args:
            clock, time: of the timeline and of the scene [s].
            reference: the state of the reference run, if there is one.
            system: the scene's, without the mass on the cursor.
        """
        right = _own(system, reference or lanes[0].state)
        right_momentum = momentum(system, right)
        row = [clock, time]
        for lane in lanes:
            state = _own(system, lane.state)
            row.append(lane.energy)
            if reference is None and lane is lanes[0]:
                row += [np.nan, np.nan]
            else:
                row.append(float(np.linalg.norm(momentum(system, state) - right_momentum)))
                row.append(distance(state, right))
        self._rows.append(tuple(row))
        self._first = self._first or tuple(row)

    @property
    def begin(self) -> Array:
        """The three numbers of each lane in the very first row, shape (lanes, 3)."""
        return np.array(self._first[2:]).reshape(-1, 3)

    def forget_after(self, clock: float) -> None:
        """What came after a time of the clock [s] has not happened."""
        while self._rows and self._rows[-1][0] > clock:
            self._rows.pop()

    def last(self, seconds: float, most: int) -> tuple[Array, Array]:
        """Times [s], shape (m,), and numbers, shape (m, lanes, 3), of the last seconds of the clock, m <= most."""
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


def _own(system: MassSpringSystem, state: State) -> State:
    """A state without the mass on the cursor."""
    n = len(system.masses)
    return State(state.time, state.positions[:n], state.velocities[:n])
