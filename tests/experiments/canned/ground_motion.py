"""A bridge that sways about 1.31 Hz, and trucks that take its middle off the influence line."""

from __future__ import annotations

import numpy as np

from experiments import ground_motion
from experiments.experiment import Result
from experiments.ground_motion import DT, SPEEDS, SWEEP, Ran
from reference.state import Array

#: Positions of the truck [m], and how far the middle is down [m].
LINE = (np.array([0.0, 12.0, 24.0]), np.array([0.0, 0.08, 0.0]))

#: Where the linear bridge sways most [Hz], how far [m], and its natural frequency [Hz].
PEAK, HIGH, NATURAL = 1.31, 0.010, 1.22

#: How long it takes to and fro [steps].
SWING = 100


def sway(frequency: float, high: float) -> Array:
    """To and fro, most at a frequency [Hz], by so much [m]."""
    steps = np.arange(round(SWEEP.duration / DT) + 1)
    envelope = np.exp(-((SWEEP.frequency(steps * DT) - frequency) ** 2) / 2e-2)
    return high * envelope * np.cos(2 * np.pi * steps / SWING)


def ran(frequency: float, high: float, off: float, distance: float | None = None) -> Ran:
    """Sways most at a frequency [Hz]; sags by the influence line and a part of its largest more, for every 10 m/s."""
    crossed = {}
    for speed in SPEEDS:
        places = speed * DT * np.arange(round(24 / speed / DT) + 1)
        crossed[speed] = np.interp(places, *LINE) + off * 0.08 * speed / 10
    return Ran(sway(frequency, high), crossed, distance)


def usual() -> Result:
    """A scheme and the engine that is it."""
    rows = {"kick_drift": ran(1.29, 0.011, 0.05), "mujoco_tendons": ran(1.33, 0.012, 0.06, 2e-13)}
    return ground_motion.result_of(rows, np.array([NATURAL]), sway(PEAK, HIGH), LINE)


def nobody() -> Result:
    """Only what is predicted."""
    return ground_motion.result_of({}, np.array([NATURAL]), sway(PEAK, HIGH), LINE)
