"""The report's maps: what they say of the agreement of measured and predicted is made from the two."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments.limits.plane import Axis
from experiments.limits.stability_map import StabilityMap
from experiments.maps import agreement, predicted_unstable


def made_up(offset: float) -> StabilityMap:
    """Growth of 10 % a step beyond dt = 1 + offset, none below; predicted at dt = 1."""
    x, y = Axis("dt", 0.0, 2.0), Axis("drag", 0.0, 1.0)
    xs, ys = x.values(41), y.values(11)
    growth = np.where(xs > 1 + offset, 0.1, -0.1) * np.ones((len(ys), 1))
    boundary = np.column_stack([np.ones(11), ys])
    return StabilityMap("made up", x, y, xs, ys, growth, boundary, None, "nobody")


def test_a_field_that_grows_where_predicted_agrees_everywhere() -> None:
    """All of it."""
    assert agreement(made_up(0.0)) == 1.0


@pytest.mark.parametrize("offset", [-0.5, 0.5])
def test_a_field_that_grows_elsewhere_does_not(offset: float) -> None:
    """A quarter of the plane is on the wrong side: 10 or 11 of 41 columns."""
    assert agreement(made_up(offset)) == pytest.approx(0.75, abs=0.02)


@pytest.mark.parametrize(("limit", "unstable"), [(0.0, True), (np.inf, False)])
def test_without_a_limit_all_is_predicted_unstable_or_nothing(limit: float, unstable: bool) -> None:
    """Unstable at any dt, a limit of 0; stable at any dt, an infinite one. dt 0 itself is neither."""
    found = made_up(0.0)
    predicted = predicted_unstable(replace(found, boundary=np.column_stack([np.full(11, limit), found.boundary[:, 1]])))
    assert (predicted[:, 1:] == unstable).all()


def test_where_only_a_part_has_a_limit_each_row_is_by_its_own() -> None:
    """Unstable at any dt in the lower half, stable at any in the upper: no number between 0 and infinity counts."""
    found = made_up(0.0)
    dt = np.where(found.y_values < 0.5, 0.0, np.inf)
    predicted = predicted_unstable(replace(found, boundary=np.column_stack([dt, found.y_values])))
    assert predicted[found.y_values < 0.5, 1:].all()
    assert not predicted[found.y_values >= 0.5].any()


def test_where_nothing_is_predicted_nothing_agrees() -> None:
    """No boundary."""
    assert agreement(replace(made_up(0.0), boundary=np.empty((0, 2)))) is None


def test_only_points_that_are_surely_one_or_the_other_count() -> None:
    """Growth of a third of a percent is neither: the rest of the field agrees; where all is unsure, nothing does."""
    found = made_up(0.0)
    unsure = found.growth.copy()
    unsure[:4] = 3e-3
    assert agreement(replace(found, growth=unsure)) == 1.0
    assert agreement(replace(found, growth=np.full_like(unsure, 3e-3))) is None
