"""Euler's fastest mode grows by 2 % a step from 1e-8 m on, Heun's dies away."""

from __future__ import annotations

import numpy as np

from experiments import first_order_instability as instability
from experiments.experiment import Result
from experiments.first_order_instability import DT, DURATION, Fate
from reference.schemes.catalogue import find
from reference.state import Trajectory
from tests.experiments.canned.motions import turning

TIMES = DT * np.arange(round(DURATION / DT) + 1)

#: By scheme: growth in a step predicted, without drag, measured on the string at rest, and on the swinging one.
GROWTH: dict[str, tuple[float, float, float, float | None]] = {
    "euler": (1.02, 1.021, 1.0195, 1.0201),
    "heun": (0.999, 1.002, 0.9991, None),
}


def true() -> Trajectory:
    """The true motion."""
    return turning(TIMES, 1.0)


def fate(name: str, ends: float, rate: float) -> Fate:
    """A scheme whose string turns at another rate [rad/s], and whose distance grows to where it ends [m]."""
    growth = GROWTH[name]
    steps = np.arange(len(TIMES))
    mode = np.minimum(1e-8 * growth[0] ** steps, 1.0)
    return Fate(find(name), *growth, turning(TIMES, rate), ends * TIMES / TIMES[-1], mode)


def usual() -> Result:
    """Both schemes."""
    return instability.result_of([fate("euler", 2.0, 1.5), fate("heun", 3e-4, 1.01)], true())


def lost() -> Result:
    """Heun, which is nowhere in the end."""
    gone = fate("heun", 3e-4, 1.01)
    distance = np.where(TIMES > 0.5, np.inf, gone.distance)
    return instability.result_of([Fate(**{**vars(gone), "distance": distance})], true())
