"""The true motion beside the worlds, as long as it can be followed: the most accurate solution there is, bit by bit."""

from __future__ import annotations

import time

from reference.errors import SolverError
from reference.state import State
from reference.system import MassSpringSystem
from reference.theory.exact import WHY_NOT_EXACT, exact
from report.live.stepping import Stopped, moved

#: It may take so long for a frame [s], on average; beyond that it is not followed.
BUDGET = 0.02

TOO_SLOW = "the true motion is not followed: it takes too long here; distances are from the first world"


class Truth:
    """Where a system truly is.

    Attributes:
        state: None where it is not followed.
        why_not: the reason then; else empty.
    """

    def __init__(self, system: MassSpringSystem) -> None:
        self.why_not = WHY_NOT_EXACT if system.obstacles else ""
        self.state = None if system.obstacles else system.start
        self._took = 0.0

    def advance(self, system: MassSpringSystem, duration: float) -> None:
        """A moment on [s], with the parameters there are now."""
        if self.state is None:
            return
        begin = time.perf_counter()
        try:
            motion = exact(moved(system, self.state), duration, 1)
            self.state = State(self.state.time + duration, motion.positions[-1], motion.velocities[-1])
        except (SolverError, Stopped) as error:
            self.state, self.why_not = None, str(error)
        # slowly: the first time SciPy is imported, and others use the machine too
        self._took += 0.05 * (min(time.perf_counter() - begin, 0.1) - self._took)
        if self._took > BUDGET:
            self.state, self.why_not = None, TOO_SLOW
