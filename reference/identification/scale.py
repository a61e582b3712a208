"""How large the numbers of a run are, and so how large its rounding: a length, and never zero."""

from __future__ import annotations

from typing import Literal

import numpy as np

from reference.state import Trajectory
from reference.system import MassSpringSystem

#: In which floating-point numbers a stepper keeps positions and velocities.
Precision = Literal["double", "single"]

#: The relative rounding of these numbers: half the distance from 1 to the next.
ROUNDING = {"double": float(np.finfo(np.float64).eps) / 2, "single": float(np.finfo(np.float32).eps) / 2}


def precision_of(stepper: object) -> Precision:
    """A stepper's: double, unless it says otherwise."""
    found: Precision = getattr(stepper, "precision", "double")
    return found


def scale(system: MassSpringSystem, run: Trajectory) -> float:
    """The system's scale [m] (`MassSpringSystem.scale`), or the largest coordinate that a run comes to, if larger."""
    finite = np.abs(run.positions[np.isfinite(run.positions)])
    return max(system.scale, float(finite.max(initial=0.0)))


def fastest_rate_bound(system: MassSpringSystem) -> float:
    """A bound on the rates [1/s] of all modes, by springs, their damping and drag: 0 where there are none.

    With K the stiffness matrix, w^2 is at most the largest row sum of |M^-1 K|, which for each mass is at most twice
    the stiffness on it over its mass (Gershgorin); of damping and drag likewise.
    """
    free = ~system.fixed
    if not free.any():
        return 0.0
    on_mass = np.zeros((2, len(system.masses)))
    for total, values in zip(on_mass, (system.stiffness, system.damping), strict=True):
        for end in system.springs.T:
            np.add.at(total, end, values)
    stiffness, damping = (2 * on_mass / system.masses)[:, free].max(axis=1)
    drag = system.drag / system.masses[free].min()
    return float(max(np.sqrt(stiffness), damping + drag))
