"""What an engine really does with what was typed: its snippet run as it is printed, and read off its elongations.

Elongations s steps apart obey y[i + 2s] = T y[i + s] - D y[i], with T and D the trace and determinant of s steps; s is
such that the spring turns by about a radian, where rounding of single precision matters least.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from engines.process.available import interpreter
from engines.process.isolation import isolated
from engines.translation.translation import Spring, Translation
from experiments.translation.oscillation import STRETCH, spring_of_values
from reference.outcome import Outcome
from reference.state import Array

#: An engine may take this long, with its start [s].
TIME_LIMIT = 240.0

#: Elongations below this part of the first are left out: rounding is a larger part of them.
SEEN = 1e-3

#: Fewer of them say too little.
FEWEST = 4


def steps_to_watch(spring: Spring, dt: float) -> int:
    """Two periods, or two decay times, of the spring; 40 to 3,000 steps."""
    slow = max(2 * np.pi / spring.omega, 2 * spring.damping / spring.stiffness)
    return int(np.clip(round(2 * slow / dt), 40, 3000))


def measured_spring(
    translation: Translation, snippet: str, spring: Spring, dt: float, python: Path | None = None
) -> tuple[float, float] | str:
    """The k [N/m] and c [N s/m] of the first spring in a snippet that is run; or why there are none.

    Args:
        python: of an environment with the engine; left out, that of the one which is kept, or the lab's own.
    """
    if python is None and translation.package:
        python = interpreter(translation.package)
    answer = isolated(translation.run, snippet, python=python, time_limit=TIME_LIMIT)
    if isinstance(answer, Outcome):
        return f"the snippet {answer.ending}: {answer.reason}"
    found = spring_of_elongations(answer, spring, dt)
    return found if found is not None else "its run shows no spring"


def spring_of_elongations(elongations: Array, spring: Spring, dt: float) -> tuple[float, float] | None:
    """The k and c of a run; None where it blew up, or died away before it showed any."""
    if not np.isfinite(elongations).all() or np.abs(elongations).max() > 10 * STRETCH:
        return None
    stride = max(1, round(1 / (spring.omega * dt)))
    seen = np.flatnonzero(np.abs(elongations) > SEEN * np.abs(elongations[0]))
    y = elongations[: seen[-1] + 1]
    before, middle, after = y[: -2 * stride], y[stride:-stride], y[2 * stride :]
    if len(after) < FEWEST:
        return None
    (trace, determinant), _, rank, _ = np.linalg.lstsq(np.stack([middle, -before], axis=1), after)
    if rank < 2:
        return None
    return spring_of_values(np.roots([1.0, -trace, determinant]).astype(complex), spring.effective_mass, stride * dt)
