"""Which eigenvalues of a step are motion that nothing resists."""

from __future__ import annotations

import numpy as np
import pytest

from reference.theory.step_map import resisted


@pytest.mark.parametrize(
    ("off", "unit", "kept"),
    [(2e-6, 1.0, 1), (1e-5, 1.0, 3), (2e-5, 10.0, 1), (1e-4, 10.0, 3), (2e-6, 1e-3, 1)],
)
def test_a_pair_that_rounding_tears_apart_is_left_out_and_growth_of_one_in_a_hundred_thousand_is_not(
    off: float, unit: float, kept: int
) -> None:
    """A double eigenvalue 1 moves by the root of rounding, 1e-8, times what its vectors are worth; at most 3e-6.

    In steps longer than 1/w, by so many times more.
    """
    values = np.array([0.5, 1 + off, 1 - off], dtype=complex)
    found = resisted(values, 2, unit)
    assert len(found) == kept
    assert 0.5 in found


def test_no_more_are_left_out_than_nothing_resists() -> None:
    """The others near 1 are slow motion."""
    assert len(resisted(np.array([1, 1, 1 + 1e-7, 0.5], dtype=complex), 2, 1.0)) == 2
