"""Each spring as an oscillator of its own, against closed forms."""

from __future__ import annotations

import numpy as np

from reference.spring_frequencies import frequencies
from reference.system import MassSpringSystem


def test_masses_frequencies_and_ratios_are_those_of_closed_forms() -> None:
    """1/m = 1/m_a + 1/m_b, f = (k/m)^(1/2) / (2 pi), zeta = c / (2 (k m)^(1/2)); to rounding.

    Springs: free at both ends, fixed at one end, between two fixed masses, and without stiffness.
    """
    system = MassSpringSystem(
        positions=np.arange(5.0)[:, None] * [1.0, 0.0],
        masses=np.array([2.0, 3.0, 4.0, 1.0, 1.0]),
        springs=np.array([[0, 1], [1, 3], [3, 4], [0, 2]]),
        stiffness=np.array([30.0, 7.0, 5.0, 0.0]),
        damping=np.array([0.6, 0.5, 0.4, 0.3]),
        rest_lengths=np.array([1.0, 2.0, 1.0, 2.0]),
        fixed=np.array([False, False, False, True, True]),
    )
    masses, found, ratios = frequencies(system)
    np.testing.assert_allclose(masses, [6 / 5, 3.0, 0.0, 4 / 3], rtol=1e-15)
    np.testing.assert_allclose(found, [25**0.5 / (2 * np.pi), (7 / 3) ** 0.5 / (2 * np.pi), 0.0, 0.0], rtol=1e-15)
    np.testing.assert_allclose(ratios, [0.6 / (2 * 36**0.5), 0.5 / (2 * 21**0.5), 0.0, 0.0], rtol=1e-15)
