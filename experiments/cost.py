"""What does accuracy cost, and what does a step?

Wall time of the stepping alone, on this machine: an engine's inside its own process, and nothing read in between.
Schemes run as compiled kernels where they can be (one thread), else step by step in Python. Those that treat only the
damping in a way of their own are left out: without damping they are kick_drift or drift_kick, semi-implicit Euler, to
the bit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, partial
from time import perf_counter

import numpy as np

from engines.engine import absence
from engines.process.isolation import EngineStepper, isolated
from engines.process.worker import FOR_SCHEMES, import_beforehand
from experiments.benchmark.timing import Speeds, Timing, engine_cost, least, seconds_per_step
from experiments.experiment import Experiment, Result, Table
from experiments.runs.claims import claimed
from experiments.runs.comparison import finite
from experiments.runs.environment import processor
from experiments.runs.progress import Progress
from experiments.runs.runner import current
from experiments.runs.steppers import steppers_here
from reference.compiled.kernels import advance, arrays_of, compiled, lists, loops_for
from reference.compiled.tracing import why_not_compiled
from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.motion import EquationsOf
from reference.outcome import Outcome
from reference.scenes import find
from reference.schemes.catalogue import Scheme
from reference.schemes.catalogue import find as find_scheme
from reference.simulate import simulate
from reference.state import Array
from reference.stepper import SchemeStepper, Stepper
from reference.system import MassSpringSystem
from reference.theory.exact import exact

#: How long the string swings [s], and the steps [s] that this is cut into.
DURATION = 0.48
DTS = (8e-3, 4e-3, 2e-3, 1e-3, 5e-4)

#: The masses of the strings whose steps are timed, at a dt [s]; kernels go on where engines stop.
MASSES = (10, 30, 100, 300, 1000)
MORE_MASSES = (3000, 10_000, 100_000)
DT = 1e-3

#: Strings of so many masses have all the kernels there are: of large systems (`reference.compiled.runs`), whose text is
#: longest, and of others.
COMPILED_FOR = (MORE_MASSES[-1], MASSES[0])

#: What ratios are to: its kernel on the same string in the same run.
ANCHOR = "kick_drift"

#: An error [m] to be met at the least cost.
GOAL = 1e-3


@dataclass(frozen=True)
class Point:
    """One run: its step [s], wall time [s], and how far its masses are from the true motion at the end, at most [m]."""

    dt: float
    seconds: float
    error: float


@dataclass(frozen=True)
class Cost:
    """What a stepper costs.

    Attributes:
        runs_as: kernel, Python or engine.
        identified_as: the scheme that an engine is known to be, if it is; of a scheme its own name.
        points: one for each of DTS; empty where it could not run.
        speeds: of the strings of MASSES, as far as it came.
        failure: why it could not run; empty if it could.
    """

    stepper: Stepper
    runs_as: str
    identified_as: str | None
    points: Sequence[Point]
    speeds: Speeds
    failure: str = ""

    @property
    def steps_per_second(self) -> list[tuple[int, float]]:
        """(masses, steps per second) of the strings that it came to."""
        return [(n, 1 / seconds) for n, seconds in zip((*MASSES, *MORE_MASSES), self.speeds.seconds, strict=False)]


def run(progress: Progress) -> Result:
    """All costs, one stepper after the other: what runs beside it would slow it down."""
    progress("kernels")
    compile_kernels()
    costs = []
    for stepper in steppers():
        progress(stepper.name)
        costs.append(engine(stepper) if isinstance(stepper, EngineStepper) else scheme(stepper))
    return result_of(costs)


def compile_kernels() -> None:
    """All kernels, side by side in processes of their own: from the disk this one then has them in no time."""
    import_beforehand(FOR_SCHEMES)
    compilable = [s.scheme.name for s in steppers() if isinstance(s, SchemeStepper) and not why_not_compiled(s.scheme)]
    with current().threads() as pool:
        each = [(name, masses) for masses in COMPILED_FOR for name in compilable]
        list(pool.map(partial(isolated, compile_kernel), *zip(*each, strict=True)))


def compile_kernel(name: str, masses: int) -> None:
    """A scheme's kernel on the string of so many masses, by its first step; it is run by one thread, as it is timed."""
    advance(string(masses), find_scheme(name), DT, 1, threads=1)


def result_of(costs: Sequence[Cost]) -> Result:
    """Costs as findings and tables; the anchor's is among them."""
    failures = [f"{c.stepper.name}: {c.failure}" for c in costs if c.failure]
    failures += [f"{c.stepper.name}: {c.speeds.reason}" for c in costs if c.speeds.reason]
    tables = [_summary(costs), _errors(costs), _speeds(costs)]
    return Result(_findings(costs), tables, {"costs": costs}, failures)


def steppers() -> Iterator[SchemeStepper | EngineStepper]:
    """The right schemes and the engines."""
    for stepper in steppers_here().values():
        if isinstance(stepper, SchemeStepper | EngineStepper) and stepper.kind in ("scheme", "engine"):
            yield stepper


@cache
def string(masses: int = MASSES[0]) -> MassSpringSystem:
    """The default string, of a number of masses."""
    return find("string").system({"masses": masses})


def scheme(stepper: SchemeStepper) -> Cost:
    """A scheme's cost: its kernel's, or that of stepping in Python."""
    if why_not_compiled(stepper.scheme):
        try:
            timings = least([partial(_time_in_python, stepper.scheme, dt) for dt in DTS])
        except SolverError as error:
            return Cost(stepper, "Python", stepper.name, [], Speeds([]), f"diverged, {error}")
        return Cost(stepper, "Python", stepper.name, points(timings, SpringMotion), Speeds([]))
    timings = [_time_kernel(stepper.scheme, dt) for dt in DTS]
    speeds = [seconds_per_step(kernel(string(n), stepper.scheme, DT)) for n in (*MASSES, *MORE_MASSES)]
    return Cost(stepper, "kernel", stepper.name, points(timings, SpringMotion), Speeds(speeds))


def engine(stepper: EngineStepper) -> Cost:
    """An engine's cost, measured in a process of its own."""
    scheme = claimed(stepper.engine)
    cost = partial(Cost, stepper, "engine", None if scheme is None else scheme.name)
    if stepper.version is None:
        return cost([], Speeds([]), f"unsupported, {absence(stepper.engine)}")
    runs = [(dt, _steps(dt)) for dt in DTS]
    strings = [string(n) for n in MASSES]
    answer = isolated(engine_cost, stepper.engine, string(), runs, strings, DT, time_limit=stepper.time_limit)
    if isinstance(answer, Outcome):
        return cost([], Speeds([]), f"{answer.ending}, {answer.reason}")
    timings, speeds = answer
    return cost(points(timings, SpringMotion if scheme is None else scheme.equations), speeds)


def _steps(dt: float) -> int:
    return round(DURATION / dt)


def kernel(system: MassSpringSystem, scheme: Scheme, dt: float) -> Callable[[int], None]:
    """What advances a system by a number of steps, as `kernels.advance` does, but for setting up: that is done here."""
    loops = loops_for(scheme, system)
    arrays, joined = arrays_of(system, loops), lists(system, loops)
    values = [arrays[name] for name in (*loops.arrays, "drag")]
    function, numbers = compiled(loops).advance, loops.program.numbers(dt)
    return lambda steps: function(*values, *numbers, *joined, steps)


def _time_kernel(scheme: Scheme, dt: float) -> Timing:
    """A run is over in no time at all: what a step takes is measured on many more."""
    per_step = seconds_per_step(kernel(string(), scheme, dt))
    return Timing(_steps(dt) * per_step, advance(string(), scheme, dt, _steps(dt)).positions)


def _time_in_python(scheme: Scheme, dt: float) -> Timing:
    begin = perf_counter()
    trajectory = simulate(string(), scheme, dt, DURATION)
    return Timing(perf_counter() - begin, trajectory.positions[-1])


def points(timings: Sequence[Timing], equations: EquationsOf) -> list[Point]:
    """Runs of DTS as points, the error taken from the true motion of a string of springs, or of rods."""
    found = []
    for dt, timing in zip(DTS, timings, strict=True):
        with np.errstate(over="ignore", invalid="ignore"):
            error = float(np.linalg.norm(timing.positions - true_end(equations), axis=1).max())
        # Further off than the string is long, or not finite: it has blown up.
        found.append(Point(dt, timing.seconds, error if error < string().size else np.inf))
    return found


@cache
def true_end(equations: EquationsOf) -> Array:
    """Where the string is at the end [m]; that of rods where an engine's segments are rigid."""
    return exact(string(), DURATION, 1, equations=equations).positions[-1]


def _summary(costs: Sequence[Cost]) -> Table:
    """One row per stepper: the speed of the smallest string, and the error of a common step."""
    columns = ["stepper", "runs as", "same as", "steps/s [1/s]", "step / anchor's", f"error, dt {1e3 * DT:g} ms [m]"]
    columns += [f"time to {1e3 * GOAL:g} mm [s]", "processor"]
    rows = []
    for cost in costs:
        point = next((p for p in cost.points if p.dt == DT), None)
        if point is None:
            continue
        per_step = point.seconds / _steps(DT)
        cheapest = min((p.seconds for p in cost.points if p.error <= GOAL), default=None)
        slower = per_step / anchor(costs)
        row = [cost.stepper.name, cost.runs_as, cost.identified_as, 1 / per_step, slower, finite(point.error), cheapest]
        rows.append([*row, processor()])
    return Table("cost", columns, rows)


def anchor(costs: Sequence[Cost], masses: int | None = None) -> float:
    """Wall time of a step of the anchor [s]: on the string of the runs, or on one of that many masses."""
    (cost,) = [c for c in costs if c.stepper.name == ANCHOR]
    if masses is not None:
        return 1 / dict(cost.steps_per_second)[masses]
    (point,) = [p for p in cost.points if p.dt == DT]
    return point.seconds / _steps(DT)


def _errors(costs: Sequence[Cost]) -> Table:
    columns = ["stepper", "runs as", "dt [s]", "steps", "wall time [s]", "error [m]", "processor"]
    rows = [
        [cost.stepper.name, cost.runs_as, p.dt, _steps(p.dt), p.seconds, finite(p.error), processor()]
        for cost in costs
        for p in cost.points
    ]
    return Table("cost_error", columns, rows)


def _speeds(costs: Sequence[Cost]) -> Table:
    columns = ["stepper", "runs as", "masses", "steps/s [1/s]", "step / anchor's", "processor"]
    rows = [
        [cost.stepper.name, cost.runs_as, masses, speed, 1 / speed / anchor(costs, masses), processor()]
        for cost in costs
        for masses, speed in cost.steps_per_second
    ]
    return Table("cost_masses", columns, rows)


def _findings(costs: Sequence[Cost]) -> list[str]:
    sentences = []
    for what, runs_as in (("scheme", ("kernel", "Python")), ("engine", ("engine",))):
        met = [(p.seconds, p.dt, c) for c in costs if c.runs_as in runs_as for p in c.points if p.error <= GOAL]
        if met:
            seconds, dt, cost = min(met, key=lambda m: m[:2])
            sentences.append(
                f"The cheapest {what} that ends within {GOAL:g} m of the true motion is {cost.stepper.name}, with "
                f"dt = {dt:g} s: {1e3 * seconds:.2g} ms for {DURATION:g} s of motion."
            )
    sentences.append(
        f"On {processor()}, a step of the string of {MASSES[0]} masses takes the {ANCHOR} kernel "
        f"{1e9 * anchor(costs):.0f} ns."
    )
    return [*sentences, *_speed_findings(costs), *_twin_findings(costs)]


def _speed_findings(costs: Sequence[Cost]) -> list[str]:
    """How engines compare with the anchor, on the smallest string and on the largest that they all came to."""
    engines = [c for c in costs if c.runs_as == "engine" and c.speeds.seconds]
    if not engines:
        return ["No engine ran."]
    sentences = []
    shared = [n for n in MASSES if all(n in dict(c.steps_per_second) for c in engines)]
    for masses in dict.fromkeys((shared[0], shared[-1])):
        slower = {c.stepper.name: 1 / dict(c.steps_per_second)[masses] / anchor(costs, masses) for c in engines}
        quickest, slowest = min(slower, key=slower.__getitem__), max(slower, key=slower.__getitem__)
        sentences.append(
            f"With {masses} masses engines take {rounded(slower[quickest])} ({quickest}) to "
            f"{rounded(slower[slowest])} ({slowest}) times as long as that kernel."
        )
    return sentences


def _twin_findings(costs: Sequence[Cost]) -> list[str]:
    """How far the errors of engines are from those of the schemes that they claim to be."""
    schemes = {c.stepper.name: c for c in costs if c.runs_as != "engine" and c.points}
    pairs = [
        (p.error, q.error)
        for c in costs
        if c.runs_as == "engine" and c.points and c.identified_as in schemes
        for p, q in zip(c.points, schemes[c.identified_as].points, strict=True)
        if np.isfinite([p.error, q.error]).all()
    ]
    if not pairs:
        return []
    apart = max(abs(p - q) / q for p, q in pairs)
    return [
        f"An engine's errors differ from those of the scheme that it claims to step by, by {apart:.0e} of them "
        f"at most in {len(pairs)} runs."
    ]


def rounded(ratio: float) -> str:
    """To two figures, as people write it."""
    return f"{float(f'{ratio:.2g}'):,g}"


EXPERIMENT = Experiment(
    name="cost",
    title="What accuracy costs",
    question="What does an error cost in wall time, and how fast is each stepper on larger strings?",
    slides="6-8, 13",
    run=run,
    timed=True,
)
