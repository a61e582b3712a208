"""The growth factor of a step, of Jacobians whose eigenvalues are known."""

from __future__ import annotations

import numpy as np
import pytest

from reference.growth_factor import growth_factor
from reference.state import Array


@pytest.mark.parametrize(
    ("jacobian", "expected"),
    [
        (np.diag([0.5, 0.3, -0.2]), 0.999999),
        (np.diag([0.3, -1.2, 0.9]), 1.2),
        (1.1 * np.array([[0.6, -0.8], [0.8, 0.6]]), 1.1),
        (np.diag([1.0, 0.5]), 0.999999),
        (np.eye(2), 0.999999),
        (np.diag([1.00001, 0.5]), 1.00001),
        (np.array([[1.0, np.nan], [0.0, 0.5]]), np.inf),
        (np.array([[np.inf, 0.0], [0.0, 0.5]]), np.inf),
    ],
)
def test_it_is_the_largest_modulus_of_what_is_resisted(jacobian: Array, expected: float) -> None:
    """Of rotations and reflections, too; what nothing resists is left out; infinite where one entry is no number."""
    assert growth_factor(jacobian) == pytest.approx(expected, abs=1e-12)
