"""Flat cloths with six folds in their shadows."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from experiments import drape
from experiments.experiment import Result
from reference.scenes.drape import disc

#: The amplitude of the folds [m].
AMPLITUDE = 0.01


def cloth(by: str, length: float, spacing: float, sample: int, coefficient: float) -> dict[str, Any]:
    """A cloth as the experiment keeps it."""
    turn = np.linspace(-math.pi, math.pi, drape.DIRECTIONS, endpoint=False)
    known = {"by": by, "length": length, "spacing": spacing, "sample": sample, "coefficient": coefficient}
    outline = 0.12 + AMPLITUDE * np.cos(6 * turn)
    return {
        **known,
        "time": 1.0,
        "speed": 5e-4,
        "positions": disc(drape.RADIUS, spacing, sample).positions,
        "outline": outline,
    }


def coefficient(length: float) -> float:
    """Of the first sample with a bending length [m]; of the second it is a hundredth more."""
    return 0.05 + 18 * length


def usual(engine: bool = True) -> Result:
    """Two samples of each bending length, one of a coarser mesh, and in an engine a twentieth less."""
    cloths = [
        cloth("kick_drift", c, drape.SPACING, i, coefficient(c) + 0.01 * i) for c in drape.LENGTHS for i in (0, 1)
    ]
    cloths += [cloth("kick_drift", 0.017, drape.COARSE, 0, 0.30)]
    cloths += [cloth("an_engine", 0.017, drape.COARSE, 0, 0.25)] * engine
    return drape.result_of(cloths)
