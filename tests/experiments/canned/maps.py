"""Growth over planes, with the predicted limit on the border or beside it."""

from __future__ import annotations

import numpy as np

from experiments import maps
from experiments.experiment import Result
from experiments.limits.plane import Axis
from experiments.limits.stability_map import StabilityMap


def field(stepper: str = "heun", other: str = "drag", limit: float = 0.01, offset: float = 0.0) -> StabilityMap:
    """10 % growth a step beyond dt = limit + offset [s], 10 % decay below; predicted at the limit."""
    x, y = Axis("dt", 0.0, 2 * limit), Axis(other, 0.1, 1.0)
    xs, ys = x.values(40), y.values(10)
    growth = np.where(xs > limit + offset, 0.1, -0.1) * np.ones((len(ys), 1))
    boundary = np.column_stack([np.full(10, limit), ys])
    return StabilityMap(stepper, x, y, xs, ys, growth, boundary, None, stepper)


def plane() -> StabilityMap:
    """Drag over masses: no axis is dt; 1 % growth where drag is small; predicted by a field that is 1 at 0.5 N s/m."""
    x, y = Axis("masses", 2, 6), Axis("drag", 0.0, 1.0)
    xs, ys = x.values(5), y.values(10)
    growth = np.where(ys[:, None] < 0.5, 0.01, -0.01) * np.ones((1, len(xs)))
    limit = (xs, ys, 2 * ys[:, None] * np.ones((1, len(xs))))
    return StabilityMap("rk4", x, y, xs, ys, growth, np.empty((0, 2)), limit, "rk4")


def usual() -> Result:
    """Three maps; the limit of the last is predicted a quarter of the plane too low."""
    return maps.result_of(
        [field(), field("rk4", "damping", 0.02), field("pymunk_springs", "damping", 0.03, offset=0.015)],
        ["mujoco_flex crashed: killed by SIGSEGV"],
    )
