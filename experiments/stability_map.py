"""Growth over a plane of two parameters: the measured field, and the predicted boundary to draw over it."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from engines.measured_limit import growths_of_engine
from engines.process.isolation import EngineStepper
from experiments.runs.side_by_side import Progress
from experiments.stability import IDENTIFYING_STEPS, at_rest_and_pushed, rest_of_engine
from reference.compiled.sweep import CHUNK, sweep
from reference.compiled.tracing import why_not_compiled
from reference.errors import InputError
from reference.identification import identify
from reference.measured_stability import GROWN, PUSH
from reference.outcome import Outcome
from reference.schemes.catalogue import Scheme
from reference.state import Array
from reference.stepper import SchemeStepper, Stepper, catalogued
from reference.system import PARAMETERS, MassSpringSystem
from reference.theory.equilibria import equilibrium_of, spring_equilibrium
from reference.theory.limits import fastest_rate, stability_limit

#: Points along each axis: of a scheme that can be swept, of an engine (and any other scheme), of the prediction.
SWEPT, ENGINE, PREDICTED = 256, 16, 25

#: The same of the prediction where no axis is dt, and every point needs a search.
PREDICTED_PLANE = 13

#: Steps of every point's run, for a scheme and for an engine.
SWEPT_STEPS, ENGINE_STEPS = 2000, 400

#: Systems swept at once: what fits the processor's caches, and how often progress is told.
STRIPE = 8192

#: Makes the system at a point of the plane, from the values of the axes (dt aside).
SystemAt = Callable[[Mapping[str, float]], MassSpringSystem]


@dataclass(frozen=True)
class Axis:
    """One axis of a map.

    Attributes:
        name: "dt", one of reference.system.PARAMETERS, or "masses" (how many).
        low, high: its range, in SI units.
    """

    name: str
    low: float
    high: float

    def values(self, count: int) -> Array:
        """Evenly spaced, from low to high; whole numbers for masses, as many as there are."""
        values = np.linspace(self.low, self.high, count)
        return np.unique(np.round(values)) if self.name == "masses" else values


@dataclass(frozen=True)
class StabilityMap:
    """A stepper's growth over a plane.

    Attributes:
        x, y: the axes, and their values where growth was measured.
        growth: per step, logarithmic (0.01 is 1 % a step), shape (y, x); not a number where nothing could be run.
        boundary: predicted: the points (x, y) of the limit where one axis is dt, shape (p, 2); else empty.
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
        InputError: for axes that make no sense, or a stepper that is neither scheme nor engine.
    """
    for axis in (x, y):
        if axis.name not in ("dt", "masses", *PARAMETERS):
            raise InputError(f"map axis {axis.name!r}: expected dt, masses, {', '.join(PARAMETERS)}")
        if not (np.isfinite([axis.low, axis.high]).all() and axis.low < axis.high):
            raise InputError(f"map axis {axis.name} from {axis.low:g} to {axis.high:g}: expected a rising range")
    # In the middle of the plane, where nothing that an axis is about is switched off.
    middle = {axis.name: (axis.low + axis.high) / 2 for axis in (x, y) if axis.name != "dt"}
    known = _scheme_of(stepper, system_at(middle))
    swept = isinstance(stepper, SchemeStepper) and not stepper.on_rods and why_not_compiled(stepper.scheme) is None
    count = resolution or (SWEPT if swept else ENGINE)
    xs, ys = x.values(count), y.values(count)
    points = [{x.name: float(a), y.name: float(b)} for b in ys for a in xs]
    if swept:
        assert isinstance(stepper, SchemeStepper)
        field = _swept(stepper.scheme, system_at, dt, points, progress)
    else:
        progress(f"{len(points)} runs")
        field = _run_one_by_one(stepper, system_at, dt, points)
    boundary, predicted = np.empty((0, 2)), None
    if known is not None and "dt" in (x.name, y.name):
        progress("predicted boundary")
        boundary = _boundary(known, system_at, x, y)
    elif known is not None:
        progress("predicted limits")
        predicted = _predicted_field(known, system_at, dt, x, y)
    named = known.scheme.name if known else "no scheme it is identified with"
    return StabilityMap(stepper.name, x, y, xs, ys, field.reshape(len(ys), len(xs)), boundary, predicted, named)


def write_map(found: StabilityMap, file: Path) -> None:
    """A map as CSV, one row per point."""
    with file.open("w", newline="", encoding="utf-8") as opened:
        writer = csv.writer(opened)
        writer.writerow([found.x.name, found.y.name, "growth per step"])
        for b, row in zip(found.y_values, found.growth, strict=True):
            writer.writerows([a, b, value] for a, value in zip(found.x_values, row, strict=True))


def _scheme_of(stepper: Stepper, system: MassSpringSystem) -> SchemeStepper | None:
    """The scheme whose theory holds for a stepper: its own, or the one it is identified with."""
    if isinstance(stepper, SchemeStepper):
        return stepper
    dt = 0.1 / fastest_rate(spring_equilibrium(system))
    name = identify(stepper, system, dt, IDENTIFYING_STEPS).identified_as
    return catalogued()[name] if name else None


def _swept(
    scheme: Scheme, system_at: SystemAt, dt: float, points: Sequence[Mapping[str, float]], progress: Progress
) -> Array:
    """The growth at every point, by sweeps of systems with equally many masses."""
    field = np.full(len(points), np.nan)
    done = 0
    for stripe in _stripes(points):
        systems = _systems(system_at, [points[i] for i in stripe])
        steps = np.array([points[i].get("dt", dt) for i in stripe])
        field[stripe] = _growth_of_sweep(scheme, systems, steps)
        done += len(stripe)
        progress(f"{done} of {len(points)} runs")
    return field


def _stripes(points: Sequence[Mapping[str, float]]) -> Iterator[list[int]]:
    """The points' numbers, in stripes of equally many masses."""
    by_size: dict[float, list[int]] = {}
    for i, point in enumerate(points):
        by_size.setdefault(point.get("masses", 0.0), []).append(i)
    for numbers in by_size.values():
        yield from (numbers[k : k + STRIPE] for k in range(0, len(numbers), STRIPE))


def _systems(system_at: SystemAt, points: Sequence[Mapping[str, float]]) -> list[tuple[MassSpringSystem, Array]]:
    """The system at every point and where it is at rest, made once for all steps."""
    made: dict[tuple[tuple[str, float], ...], tuple[MassSpringSystem, Array]] = {}
    result = []
    for point in points:
        key = tuple((name, value) for name, value in point.items() if name != "dt")
        if key not in made:
            system = system_at(dict(key))
            made[key] = system, spring_equilibrium(system).state.positions
        result.append(made[key])
    return result


def _growth_of_sweep(scheme: Scheme, systems: list[tuple[MassSpringSystem, Array]], dt: Array) -> Array:
    first = systems[0][0]
    push = PUSH * float(first.rest_lengths.min())
    still = np.array([rest for _, rest in systems])
    offset = push * np.random.default_rng(0).standard_normal(first.positions.shape)
    offset[first.fixed] = 0.0
    parameters = {
        "mass": np.array([s.masses[-1] for s, _ in systems]),
        "rest_length": np.array([s.rest_lengths[0] for s, _ in systems]),
        "stiffness": np.array([s.stiffness[0] for s, _ in systems]),
        "damping": np.array([s.damping[0] for s, _ in systems]),
        "drag": np.array([s.drag for s, _ in systems]),
        "gravity": np.array([-s.gravity[1] for s, _ in systems]),
    }
    varied = {name: values for name, values in parameters.items() if np.ptp(values) > 0}
    size = float(np.linalg.norm(offset, axis=1).max())
    run = sweep(first, scheme, dt, SWEPT_STEPS, varied, still + offset, still, limit=GROWN * size)
    return _growth(run.distances, size)


def _growth(distances: Array, start: float) -> Array:
    """Growth per step, from the distances after every chunk of steps, shape (chunks, m)."""
    quarter = len(distances) // 4
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        power = distances**2
        slow = 0.5 * np.log(power[-quarter:].mean(axis=0) / power[:quarter].mean(axis=0)) / (0.75 * SWEPT_STEPS)
        beyond = ~(distances <= GROWN * start)
        when = np.argmax(beyond, axis=0)
        reached = np.nan_to_num(distances[when, np.arange(distances.shape[1])], nan=np.inf)
        fast = np.log(np.minimum(reached, 1e300) / start) / ((when + 1) * CHUNK)
    return np.where(beyond.any(axis=0), fast, slow)


def _run_one_by_one(stepper: Stepper, system_at: SystemAt, dt: float, points: Sequence[Mapping[str, float]]) -> Array:
    """The growth at every point from a run of its own: an engine's all in one process, for its start takes time."""
    if not isinstance(stepper, EngineStepper):
        raise InputError(f"stepper {stepper.name!r}: expected an explicit scheme of the whole state, or an engine")
    cases = []
    for point in points:
        system = system_at({name: value for name, value in point.items() if name != "dt"})
        rest = rest_of_engine(stepper.engine, system, spring_equilibrium(system))
        if isinstance(rest, Outcome):
            raise InputError(rest.reason)
        cases.append((*at_rest_and_pushed(system, rest), point.get("dt", dt)))
    answer = stepper.isolate(growths_of_engine, stepper.engine, cases, ENGINE_STEPS, time_limit=5 * stepper.time_limit)
    if isinstance(answer, Outcome):
        raise InputError(f"{stepper.name} {answer.ending}: {answer.reason}")
    return answer["growth"]


def _boundary(known: SchemeStepper, system_at: SystemAt, x: Axis, y: Axis) -> Array:
    """The predicted limit along the axis that is not dt."""
    other = y if x.name == "dt" else x
    found = []
    for value in other.values(PREDICTED):
        system = system_at({other.name: float(value)})
        limit = stability_limit(known.scheme, equilibrium_of(known.equations, system))
        if limit.dt is not None:
            found.append((limit.dt, value) if x.name == "dt" else (value, limit.dt))
    return np.array(found).reshape(-1, 2)


def _predicted_field(
    known: SchemeStepper, system_at: SystemAt, dt: float, x: Axis, y: Axis
) -> tuple[Array, Array, Array]:
    """The largest stable dt over dt, 1 on the boundary; 0 stands for unstable and 10 for stable at any dt."""
    xs, ys = x.values(PREDICTED_PLANE), y.values(PREDICTED_PLANE)
    field = np.empty((len(ys), len(xs)))
    for j, b in enumerate(ys):
        for i, a in enumerate(xs):
            system = system_at({x.name: float(a), y.name: float(b)})
            limit = stability_limit(known.scheme, equilibrium_of(known.equations, system))
            never = 0.0 if limit.growth is not None else 10.0
            field[j, i] = never if limit.dt is None else min(limit.dt / dt, 10.0)
    return xs, ys, field
