"""A map of stability: growth over a plane of two parameters, measured, and the predicted boundary to draw over it."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from engines.process.isolation import EngineStepper
from experiments.limits.measured_growth import engine_growth, stepped_growth, swept_growth
from experiments.limits.plane import Axis, Plane, SystemAt
from experiments.limits.predicted_limits import predicted_boundary, predicted_field
from experiments.limits.predictions import IDENTIFYING_STEPS
from experiments.runs.progress import Progress
from reference.compiled.tracing import why_not_compiled
from reference.errors import InputError
from reference.identification import identify
from reference.state import Array
from reference.stepper import SchemeStepper, Stepper, stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import fastest_rate

#: Points along each axis where growth is measured: of a scheme that can be swept, and of what runs one by one.
SWEPT, ENGINE = 256, 16


@dataclass(frozen=True)
class StabilityMap:
    """A stepper's growth over a plane.

    Attributes:
        x, y: the axes, and their values where growth was measured.
        growth: per step, logarithmic (0.01 is 1 % a step), shape (y, x); NaN where nothing could be run.
        boundary: predicted: the points (x, y) of the limit where one axis is dt, shape (p, 2), whose dt is 0 where a
            scheme is unstable at any, infinite where it is stable at any; else empty.
        predicted_limit: predicted: (x values, y values, largest stable dt over dt), where no axis is dt; else None.
        predicted_by: the scheme the prediction is of.
    """

    stepper: str
    x: Axis
    y: Axis
    x_values: Array
    y_values: Array
    growth: Array
    boundary: Array
    predicted_limit: tuple[Array, Array, Array] | None
    predicted_by: str

    @property
    def line(self) -> Array:
        """The part of the boundary that can be drawn: where there is a limit."""
        dt = self.boundary[:, 0 if self.x.name == "dt" else 1]
        return self.boundary[np.isfinite(dt) & (dt > 0)]


def stability_map(
    stepper: Stepper,
    system_at: SystemAt,
    dt: float,
    x: Axis,
    y: Axis,
    progress: Progress = lambda _: None,
    resolution: int | None = None,
) -> StabilityMap:
    """Measure growth over a plane and predict its boundary.

    Args:
        stepper: a scheme or an engine.
        system_at: the system for given values of the axes.
        dt: the step where no axis is dt [s].
        resolution: points along each axis; left out, as many as the stepper's speed allows.

    Raises:
        InputError: for axes that make no sense, or a stepper that is neither a scheme nor an engine.
    """
    plane = Plane(x, y, system_at, dt)
    scheme = _scheme_of(stepper, plane.system(plane.middle))
    x_values, y_values, growth = _measured(stepper, plane, progress, resolution)
    boundary, limits = np.empty((0, 2)), None
    if scheme is not None and plane.has_dt:
        progress("predicted boundary")
        boundary = predicted_boundary(scheme, plane)
    elif scheme is not None:
        progress("predicted limits")
        limits = predicted_field(scheme, plane)
    named = scheme.name if scheme else "no scheme it is identified with"
    return StabilityMap(stepper.name, x, y, x_values, y_values, growth, boundary, limits, named)


def write_map(found: StabilityMap, file: Path) -> None:
    """A map as CSV, one row per point."""
    with file.open("w", newline="", encoding="utf-8") as opened:
        writer = csv.writer(opened)
        writer.writerow([found.x.heading, found.y.heading, "measured growth in a step [1]"])
        for b, row in zip(found.y_values, found.growth, strict=True):
            writer.writerows([a, b, value] for a, value in zip(found.x_values, row, strict=True))


def _scheme_of(stepper: Stepper, system: MassSpringSystem) -> SchemeStepper | None:
    """The scheme whose theory holds for a stepper: its own, or the one it is identified with."""
    if isinstance(stepper, SchemeStepper):
        return stepper
    dt = 0.1 / fastest_rate(spring_equilibrium(system))
    name = identify(stepper, system, dt, IDENTIFYING_STEPS).identified_as
    return stepper_named(name) if name else None


def _measured(stepper: Stepper, plane: Plane, progress: Progress, resolution: int | None) -> tuple[Array, Array, Array]:
    """Where growth was measured along x and y, and the growth, shape (y, x)."""
    can_be_swept = (
        isinstance(stepper, SchemeStepper) and not stepper.on_rods and why_not_compiled(stepper.scheme) is None
    )
    count = resolution or (SWEPT if can_be_swept else ENGINE)
    x_values, y_values = plane.x.values(count), plane.y.values(count)
    points = plane.points(x_values, y_values)
    if isinstance(stepper, SchemeStepper) and can_be_swept:
        growth = swept_growth(stepper.scheme, plane, points, progress)
    elif isinstance(stepper, EngineStepper):
        progress(f"{len(points)} runs")
        growth = engine_growth(stepper, plane, points)
    elif isinstance(stepper, SchemeStepper):
        growth = stepped_growth(stepper, plane, points, progress)
    else:
        raise InputError(f"stepper {stepper.name!r}: expected a scheme or an engine")
    return x_values, y_values, growth.reshape(len(y_values), len(x_values))
