"""The last seconds, to go back to: as many moments as fit into a number of seconds and of bytes."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from reference.state import State
from reference.system import MassSpringSystem
from report.live.segment import Segment

#: How far back one can go [s of the timeline's clock], and what that may take of the memory [bytes].
SECONDS, BYTES = 10.0, 64 * 2**20


@dataclass(frozen=True, eq=False)
class Moment:
    """All there is at one frame.

    Attributes:
        clock: for how long the timeline has run [s].
        time: of the scene [s].
        system: the scene's, with its parameters.
        stepped: the same with the mass on the cursor.
        states: one for each lane.
        reference: the state of the reference run; None where there is none.
        segment: what has happened since the last thing no command can say.
        grabbed: the mass that hangs on the cursor, if one does.
    """

    clock: float
    time: float
    system: MassSpringSystem
    stepped: MassSpringSystem
    states: tuple[State, ...]
    reference: State | None
    segment: Segment
    grabbed: int | None

    @property
    def bytes(self) -> int:
        """What its states take."""
        states = [*self.states, *([self.reference] if self.reference else [])]
        return sum(s.positions.nbytes + s.velocities.nbytes for s in states)


class History:
    """Moments, the oldest first, forgotten in time."""

    def __init__(self) -> None:
        self._moments: deque[Moment] = deque()
        self._bytes = 0

    def __len__(self) -> int:
        return len(self._moments)

    @property
    def seconds(self) -> float:
        """How far back it goes [s]."""
        return self._moments[-1].clock - self._moments[0].clock if self._moments else 0.0

    def keep(self, moment: Moment) -> None:
        """One more; the oldest go."""
        self._moments.append(moment)
        self._bytes += moment.bytes
        while len(self._moments) > 1 and (self.seconds > SECONDS or self._bytes > BYTES):
            self._bytes -= self._moments.popleft().bytes

    def back(self, seconds: float) -> Moment | None:
        """The moment that many seconds of the scene before the last, or the first; None where there is none."""
        if not self._moments:
            return None
        then = self._moments[-1].time - seconds
        return next((m for m in reversed(self._moments) if m.time <= then + 1e-9), self._moments[0])

    def forget_after(self, clock: float) -> None:
        """What came after a time of the clock [s] has not happened."""
        while self._moments and self._moments[-1].clock > clock:
            self._bytes -= self._moments.pop().bytes
