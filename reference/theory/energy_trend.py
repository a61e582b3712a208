"""What a scheme does to the energy of an undamped system in the long run, predicted: keeps it, or lets it go."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np

from reference.schemes.catalogue import Scheme
from reference.theory.equilibria import Equilibrium
from reference.theory.step_map import step_jacobian

#: What an energy does in the long run.
EnergyTrend = Literal["bounded", "growing", "decaying"]
TRENDS: tuple[EnergyTrend, ...] = get_args(EnergyTrend)

#: An eigenvalue this far off the real axis is an oscillation's: its dt w is larger.
TURNING = 1e-3

#: Eigenvalues this near to the unit circle are on it: differences and rounding leave some 1e-12.
ON_THE_CIRCLE = 1e-10


def predicted_energy_trend(scheme: Scheme, rest: Equilibrium, dt: float) -> EnergyTrend:
    """The trend near an equilibrium, where an undamped system is a set of undamped oscillators.

    One step multiplies a mode by an eigenvalue of the step's Jacobian, and its energy by the eigenvalue's modulus
    squared: any beyond the unit circle grows; else any within decays; else all stay. Real eigenvalues are of no
    oscillation, but of rods that are brought back to their lengths.

    Args:
        dt: the step [s]; TURNING/w or more for the slowest mode w.
    """
    values = np.linalg.eigvals(step_jacobian(scheme, rest, dt))
    moduli = np.abs(values[np.abs(values.imag) > TURNING])
    if moduli.max() > 1 + ON_THE_CIRCLE:
        return "growing"
    return "decaying" if moduli.min() < 1 - ON_THE_CIRCLE else "bounded"
