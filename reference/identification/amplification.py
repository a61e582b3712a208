"""Where the motion multiplies rounding: how much more than rounding a scheme itself makes of a small perturbation.

Cloth that buckles, and any scheme that blows up, multiply rounding: two who do the same arithmetic in another order
then part by more than TOLERANCE. How far is measured, and never allowed beyond AMPLIFIED.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from reference.changes import Change
from reference.identification.ranking import TOLERANCE, identify_run
from reference.outcome import outcome_of
from reference.state import Trajectory
from reference.stepper import Stepper
from reference.system import MassSpringSystem

#: A motion that multiplies rounding may deviate by what it makes of a perturbation of PERTURBATION of the size, but not
#: by more than AMPLIFIED: the first is what steps in another order add up to, and some to spare.
PERTURBATION, AMPLIFIED = 1e-14, 1e-9


def amplified(
    stepper: Stepper,
    trajectory: Trajectory,
    system: MassSpringSystem,
    dt: float,
    steps: int,
    changes: Sequence[Change] = (),
) -> float:
    """How far a perturbation of all free masses, in random directions, takes a stepper from its trajectory.

    Both the perturbation, up to PERTURBATION, and the distance are parts of the run's scale. A stable scheme takes it
    2e-14 to 6e-13 far in some hundred steps on the default string; RK4 that blows up multiplies it by 2e7 in ten steps
    of 0.02 s.
    """
    aside = PERTURBATION * system.scale * np.random.default_rng(0).uniform(-1, 1, system.positions.shape)
    perturbed = replace(system, positions=system.positions + np.where(system.fixed[:, None], 0.0, aside))
    other = stepper.run(perturbed, dt, steps, changes).trajectory
    if other is None:
        return 0.0
    found = identify_run(stepper.name, outcome_of(system, trajectory), system, {"perturbed": other})
    return TOLERANCE * found.error / found.tolerance
