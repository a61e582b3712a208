"""How perturbations of rest grow at the points of a plane: measured, in a run of a stepper at each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from engines.measured_limit import growths_of_engine
from engines.process.isolation import EngineStepper
from experiments.limits.perturbed import perturbed, rest_of_engine
from experiments.limits.plane import Plane, Point
from experiments.runs.progress import Progress
from reference.compiled.sweep import CHUNK, sweep
from reference.errors import InputError, SolverError
from reference.measured_stability import GROWN, PERTURBATION, random_growth
from reference.outcome import Outcome
from reference.schemes.catalogue import Scheme
from reference.simulate import simulate
from reference.state import Array
from reference.stepper import SchemeStepper
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, equilibrium_of, spring_equilibrium

#: Steps of every point's run, for a scheme and for an engine.
SWEPT_STEPS, ENGINE_STEPS = 2000, 400

#: Fewer points are swept by one thread before loops for many, which take twice as long to compile, are there.
THREADS_FROM = 32_768

#: Systems swept at once: what fits the processor's caches, and how often progress is told.
STRIPE = 8192

#: A system, and where its masses are at rest [m], shape (n, d).
AtRest = tuple[MassSpringSystem, Array]


def swept_growth(scheme: Scheme, plane: Plane, points: Sequence[Point], progress: Progress) -> Array:
    """The growth of a scheme per step at every point, by sweeps of systems with equally many masses."""
    growth = np.full(len(points), np.nan)
    threads = 1 if len(points) < THREADS_FROM else None
    done = 0
    for stripe in _stripes(points):
        chosen = [points[i] for i in stripe]
        dt = np.array([plane.step(point) for point in chosen])
        growth[stripe] = _growth_of_sweep(scheme, _at_rest(plane, chosen), dt, threads)
        done += len(stripe)
        progress(f"{done} of {len(points)} runs")
    return growth


def engine_growth(stepper: EngineStepper, plane: Plane, points: Sequence[Point]) -> Array:
    """The growth of an engine per step at every point, each from a run of its own: all in one process, to start once.

    Raises:
        InputError: where the engine cannot do it, with its reason.
    """
    cases = []
    for point in points:
        system = plane.system(point)
        rest = rest_of_engine(stepper.engine, system, spring_equilibrium(system))
        if isinstance(rest, Outcome):
            raise InputError(rest.reason)
        cases.append((*perturbed(system, rest), plane.step(point)))
    answer = stepper.isolate(growths_of_engine, stepper.engine, cases, ENGINE_STEPS, time_limit=5 * stepper.time_limit)
    if isinstance(answer, Outcome):
        raise InputError(f"{stepper.name} {answer.ending}: {answer.reason}")
    return answer["growth"]


def stepped_growth(stepper: SchemeStepper, plane: Plane, points: Sequence[Point], progress: Progress) -> Array:
    """The growth per step at every point of a scheme that is not compiled: each from a run of its own function."""
    growth = np.full(len(points), np.inf)
    for i, point in enumerate(points):
        progress(f"{i} of {len(points)} runs")
        rest, start = perturbed(*_system_and_rest(stepper, plane, point))
        dt = plane.step(point)
        try:
            run = simulate(start, stepper.scheme, dt, ENGINE_STEPS * dt, equations=stepper.equations)
        except SolverError:
            continue
        growth[i] = random_growth(run.positions - rest)
    return growth


def _system_and_rest(stepper: SchemeStepper, plane: Plane, point: Point) -> tuple[MassSpringSystem, Equilibrium]:
    system = plane.system(point)
    return system, equilibrium_of(stepper.equations, system)


def _stripes(points: Sequence[Point]) -> Iterator[list[int]]:
    """The points' numbers, in stripes of equally many masses."""
    by_size: dict[float, list[int]] = {}
    for i, point in enumerate(points):
        by_size.setdefault(point.get("masses", 0.0), []).append(i)
    for numbers in by_size.values():
        yield from (numbers[k : k + STRIPE] for k in range(0, len(numbers), STRIPE))


def _at_rest(plane: Plane, points: Sequence[Point]) -> list[AtRest]:
    """The system at every point and where it is at rest; points that differ in dt alone share theirs."""
    made: dict[tuple[tuple[str, float], ...], AtRest] = {}
    result = []
    for point in points:
        key = tuple(plane.parameters(point).items())
        if key not in made:
            system = plane.system(point)
            made[key] = system, spring_equilibrium(system).state.positions
        result.append(made[key])
    return result


def _growth_of_sweep(scheme: Scheme, systems: Sequence[AtRest], dt: Array, threads: int | None) -> Array:
    """All systems perturbed alike, swept, and how each perturbation grew."""
    first = systems[0][0]
    rest = np.array([positions for _, positions in systems])
    size = PERTURBATION * first.shortest
    offset = size * np.random.default_rng(0).standard_normal(first.positions.shape)
    offset[first.fixed] = 0.0
    start = float(np.linalg.norm(offset, axis=1).max())
    varied = _varied([system for system, _ in systems])
    run = sweep(first, scheme, dt, SWEPT_STEPS, varied, rest + offset, rest, limit=GROWN * start, threads=threads)
    return _growth(run.distances, start)


def _varied(systems: Sequence[MassSpringSystem]) -> dict[str, Array]:
    """The parameters in which systems differ, each of shape (m,): within a system all masses and springs are alike."""
    parameters = {
        "mass": np.array([system.masses[-1] for system in systems]),
        "rest_length": np.array([system.rest_lengths[0] for system in systems]),
        "stiffness": np.array([system.stiffness[0] for system in systems]),
        "damping": np.array([system.damping[0] for system in systems]),
        "drag": np.array([system.drag for system in systems]),
        "gravity": np.array([-system.gravity[system.vertical_axis] for system in systems]),
    }
    return {name: values for name, values in parameters.items() if np.ptp(values) > 0}


@np.errstate(divide="ignore", invalid="ignore", over="ignore")
def _growth(distances: Array, start: float) -> Array:
    """Growth per step of each system, logarithmic, shape (m,).

    Slow growth is told from the mean squares in the first and the last quarter of the run; growth that takes a system
    out of reach, from when it does.

    Args:
        distances: of the mass furthest from rest after every CHUNK of steps [m], shape (chunks, m).
        start: the same at the start [m].
    """
    quarter = len(distances) // 4
    power = distances**2
    slow = 0.5 * np.log(power[-quarter:].mean(axis=0) / power[:quarter].mean(axis=0)) / (0.75 * SWEPT_STEPS)
    beyond = ~(distances <= GROWN * start)
    when = np.argmax(beyond, axis=0)
    reached = np.nan_to_num(distances[when, np.arange(distances.shape[1])], nan=np.inf)
    fast = np.log(np.minimum(reached, 1e300) / start) / ((when + 1) * CHUNK)
    return np.where(beyond.any(axis=0), fast, slow)
