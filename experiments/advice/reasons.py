"""Why a scheme's limit is where it is on a scene, and how much stiffer its springs could be: predicted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from experiments.limits.predictions import Predictions
from reference.bisection import bisect
from reference.errors import SolverError
from reference.limit import Limit
from reference.schemes.catalogue import Scheme
from reference.system import MassSpringSystem
from reference.theory.critical_mode import CriticalMode, critical_mode
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit

#: Springs are tried from so much softer to so much stiffer than they are; the factor is found to this part of itself.
SOFTEST, STIFFEST, PRECISION = 1e-4, 1e6, 1e-3

#: Systems of more masses than that are not tried with other stiffness: each trial needs its own equilibrium.
MOST_MASSES = 60


@dataclass(frozen=True, eq=False)
class Reasons:
    """Of one scheme on one scene.

    Attributes:
        mode: the mode that grows first; None without a limit.
        stiffest: so many times as stiff all springs could be at the scene's dt; infinite where any could, 0 where none
            could, None where that was not looked for.
        system: whose springs they are.
    """

    mode: CriticalMode | None
    stiffest: float | None
    system: MassSpringSystem


def reasons_of(scheme: Scheme, predictions: Predictions, predicted: Limit, dt: float) -> Reasons:
    """Of a scheme whose limit is predicted, for a scene's dt [s]."""
    system = predictions.system
    mode = None
    linear = predictions.rest.linear
    if predicted.dt and linear is not None and len(system.springs):
        mode = critical_mode(scheme, linear, predicted.dt)
    small = len(system.masses) <= MOST_MASSES and len(system.springs) > 0
    return Reasons(mode, largest_stiffness(scheme, system, dt) if small else None, system)


def largest_stiffness(scheme: Scheme, system: MassSpringSystem, dt: float) -> float | None:
    """By what all stiffnesses can be multiplied for a dt [s] to be the limit; infinite where any can, 0 where none can.

    None where a system so changed has no equilibrium.
    """

    def too_stiff(power: float) -> bool:
        changed = system.with_parameter("stiffness", (np.exp(power) * system.stiffness).tolist())
        limit = stability_limit(scheme, spring_equilibrium(changed))
        return limit.growth is not None if limit.dt is None else limit.dt < dt

    low, high = np.log(SOFTEST), np.log(STIFFEST)
    try:
        if too_stiff(low):
            return 0.0
        if not too_stiff(high):
            return float(np.inf)
        power, _ = bisect(too_stiff, low, high, lambda low, high: high - low <= PRECISION)
    except SolverError:
        return None
    return float(np.exp(power))
