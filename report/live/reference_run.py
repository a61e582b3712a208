"""The reference run: the most accurate solution there is, followed beside the lanes as long as there is time for it."""

from __future__ import annotations

import time

from reference.errors import SolverError
from reference.state import State
from reference.system import MassSpringSystem
from reference.theory.exact import WHY_NOT_EXACT, exact
from report.live.stepping import Stopped, moved

#: It may take this long for a frame [s], on average; beyond that it is not followed.
BUDGET = 0.02

#: How much of a frame's time enters the average; no frame counts for more than LONGEST [s], as the first time SciPy is
#: imported, and others use the machine, too.
WEIGHT, LONGEST = 0.05, 0.1

#: The most steps of the solver in a frame.
MOST_STEPS = 1000

TOO_SLOW = "the true motion is not followed: it takes too long here; distances are from the first lane"


class ReferenceRun:
    """The true motion of a system.

    Attributes:
        state: as far as it has come; None where it is not followed.
    """

    def __init__(self, system: MassSpringSystem) -> None:
        self.state: State | None = None if system.obstacles else system.start
        self._why_not = WHY_NOT_EXACT if system.obstacles else ""
        self._average = 0.0

    @property
    def why_not(self) -> str:
        """Why it is not followed; empty where it is."""
        return "" if self.state is not None else self._why_not

    def advance(self, system: MassSpringSystem, duration: float) -> None:
        """A moment on [s], with the parameters there are now."""
        if self.state is None:
            return
        begin = time.perf_counter()
        try:
            motion = exact(moved(system, self.state), duration, 1, most_steps=MOST_STEPS)
        except (SolverError, Stopped) as error:
            self._give_up(str(error))
            return
        self.state = State(self.state.time + duration, motion.positions[-1], motion.velocities[-1])
        self._average += WEIGHT * (min(time.perf_counter() - begin, LONGEST) - self._average)
        if self._average > BUDGET:
            self._give_up(TOO_SLOW)

    def _give_up(self, why: str) -> None:
        self.state, self._why_not = None, why
