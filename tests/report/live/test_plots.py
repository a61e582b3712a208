"""Numbers on the axes of plots: few figures, steady units, logarithms of what may be zero or unknown."""

from __future__ import annotations

import numpy as np
import pytest

from report.live.colours import LANE_COLOURS
from report.live.plots import DASHES, PREFIXES, logarithms, power
from report.live.stepping import MOST_LANES


@pytest.mark.parametrize("size", [3e-14, 2e-7, 5e-3, 0.7, 123.0, 4.5e4, 8e9])
def test_numbers_on_an_axis_have_at_most_three_figures(size: float) -> None:
    """Whatever was there before; and what will do stays as it is, so that the unit does not flicker."""
    values = np.array([[0.0, np.nan], [-size, size / 2]])
    for now in PREFIXES:
        chosen = power(values, now)
        assert size / 10.0**chosen < 1000
        assert size / 10.0**chosen >= 0.2 or chosen == min(PREFIXES)
        assert power(values, chosen) == chosen
        assert power(1e9 * values, now) > chosen or chosen == max(PREFIXES)
    assert power(np.array([1e99]), 0) == max(PREFIXES)


def test_prefixes_are_those_of_si() -> None:
    """Every third power of ten, by its letter."""
    assert dict(zip(range(-12, 12, 3), ["p", "n", "\N{MICRO SIGN}", "m", "", "k", "M", "G"], strict=True)) == PREFIXES
    assert len(set(DASHES)) == len(DASHES) == MOST_LANES <= len(LANE_COLOURS)
    assert DASHES[0] == ()


def test_of_logarithms_nothing_is_below_rounding() -> None:
    """A distance of 0, at the start, is as small as the smallest there is; what is unknown stays so."""
    found = logarithms(np.array([[0.0, np.nan], [1e-6, np.nan], [1e-3, np.nan]]))
    np.testing.assert_allclose(found[:, 0], [-6, -6, -3])
    assert np.isnan(found[:, 1]).all()
    assert np.isfinite(logarithms(np.zeros((3, 1)))).all()
