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


def test_without_a_limit_all_is_predicted_unstable() -> None:
    """An empty boundary."""
    assert predicted_unstable(replace(made_up(0.0), boundary=np.empty((0, 2)))).all()
