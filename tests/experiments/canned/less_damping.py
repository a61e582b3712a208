"""Strings that turn, and whose energy decays a little slower than small swings' would."""

from __future__ import annotations

import numpy as np

from experiments import less_damping
from experiments.experiment import Result
from experiments.less_damping import DRAGS, DT, DURATION, Swing
from tests.experiments.canned.motions import turning

MASS = 0.02

#: The decay time that is measured, over the predicted one.
SLOWER = 1.25

#: The decay time that is fitted, over the predicted one.
FITTED = 1.1

#: Energy at the start [J].
START = 1.5


def swing(drag: float) -> Swing:
    """With a drag [N s/m]: E = E0 exp(-t / (1.25 m/Cd)), of which the drag is said to have taken 1 % less."""
    times = DT * np.arange(round(DURATION / DT) + 1)
    predicted = MASS / drag
    measured = SLOWER * predicted if SLOWER * predicted < DURATION else None
    energies = START * np.exp(-times / (SLOWER * predicted))
    taken = float(energies[0] - energies[-1] - 0.01 * energies[0])
    return Swing(drag, turning(times, 1.0), energies, predicted, FITTED * predicted, measured, taken)


def usual() -> Result:
    """With each of the experiment's drags."""
    return less_damping.result_of([swing(drag) for drag in DRAGS])
