"""Springs as oscillators: the frequency and the damping ratio of the two masses a spring joins. Needs NumPy only.

With the effective mass m = 1 / (1/m_a + 1/m_b), w = (k/m)^(1/2): f = w / (2 pi), zeta = c / (2 m w).
"""

from __future__ import annotations

import numpy as np

from reference.state import Array
from reference.system import MassSpringSystem


def frequencies(system: MassSpringSystem) -> tuple[Array, Array, Array]:
    """Effective masses [kg], frequencies f [Hz] and damping ratios of all springs alone, shape (s,) each.

    A fixed mass counts as infinite. Between two fixed masses, and without stiffness, frequency and ratio are 0.
    """
    inverse = np.where(system.fixed, 0.0, 1 / system.masses)
    a, b = system.springs.T
    both = inverse[a] + inverse[b]
    mass = np.divide(1.0, both, out=np.zeros_like(both), where=both > 0)
    omega = np.sqrt(system.stiffness * both)
    ratio = np.divide(system.damping * both, 2 * omega, out=np.zeros_like(both), where=omega > 0)
    return mass, omega / (2 * np.pi), ratio
