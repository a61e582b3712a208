"""What theory says of a scheme over a plane: the boundary of stability, or how far every point is from it."""

from __future__ import annotations

import numpy as np

from experiments.limits.plane import Plane, Point
from reference.limit import Limit
from reference.state import Array
from reference.stepper import SchemeStepper
from reference.theory.equilibria import equilibrium_of
from reference.theory.limits import stability_limit

#: Points of the boundary.
BOUNDARY = 25

#: Points along each axis where no axis is dt, and every one needs a search.
FIELD = 13

#: Largest stable dt over dt, where there is no limit: unstable at any dt, and stable at any that was tried.
NEVER, ALWAYS = 0.0, 10.0


def predicted_boundary(scheme: SchemeStepper, plane: Plane) -> Array:
    """The points (x, y) of the limit in a plane with an axis dt, shape (p, 2).

    The limit is 0 where the scheme is unstable at any dt, infinite where it is stable at any, NaN where nobody knows.
    """
    dt_is_x = plane.x.name == "dt"
    other = plane.y if dt_is_x else plane.x
    found = []
    for value in other.values(BOUNDARY):
        limit = _step(_limit_at(scheme, plane, {other.name: float(value)}))
        found.append((limit, value) if dt_is_x else (value, limit))
    return np.array(found).reshape(-1, 2)


def predicted_field(scheme: SchemeStepper, plane: Plane) -> tuple[Array, Array, Array]:
    """In a plane without dt: x values, y values, and the largest stable dt over dt, which is 1 on the boundary."""
    xs, ys = plane.x.values(FIELD), plane.y.values(FIELD)
    limits = [_limit_at(scheme, plane, point) for point in plane.points(xs, ys)]
    return xs, ys, np.array([_over_dt(limit, plane.dt) for limit in limits]).reshape(len(ys), len(xs))


def _limit_at(scheme: SchemeStepper, plane: Plane, point: Point) -> Limit:
    return stability_limit(scheme.scheme, equilibrium_of(scheme.equations, plane.system(point)))


def _over_dt(limit: Limit, dt: float) -> float:
    return float(np.clip(_step(limit) / dt, NEVER, ALWAYS))


def _step(limit: Limit) -> float:
    """The largest stable dt [s]: 0 if none is, infinite if all are, NaN if it is not known."""
    if limit.dt is not None:
        return limit.dt
    return {"none": 0.0, "any": np.inf}.get(limit.stable_steps, np.nan)
