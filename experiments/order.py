"""How fast does each stepper's error fall with dt?

A method of order p has an error of C dt^p once dt is small: a straight line of slope p where both axes are logarithmic.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from engines.process.isolation import EngineStepper
from experiments.experiment import Experiment, Result, Table
from experiments.runs.comparison import finite
from experiments.runs.progress import Progress
from experiments.runs.side_by_side import side_by_side
from experiments.runs.step_size_series import engine_series
from experiments.runs.steppers import steppers_here
from reference.forces import SpringMotion
from reference.identification import candidates, identify_beginning, scheme_of
from reference.motion import EquationsOf
from reference.outcome import Outcome, outcome_of
from reference.scenes import find
from reference.state import Array, State, Trajectory
from reference.stepper import EQUATIONS, SchemeStepper, Stepper, catalogued
from reference.system import MassSpringSystem
from reference.theory.exact import TOLERANCE, exact

#: When errors are looked at [s], and after how many steps: dt from 4 ms to 1/16 ms. The largest dt w is 0.77.
DURATION = 0.064
STEPS = (16, 32, 64, 128, 256, 512, 1024)
DTS: Array = DURATION / np.array(STEPS)

#: The run by which steppers that are not of the catalogue are identified.
IDENTIFYING = STEPS.index(256)

#: The strings, by what resists their motion. A stepper runs on the first that it can: there, no two schemes are alike.
STRINGS: Mapping[str, Mapping[str, float]] = {
    "damping and drag": {"masses": 5, "angle": 30, "damping": 0.05, "drag": 0.02},
    "drag": {"masses": 5, "angle": 30, "drag": 0.02},
    "nothing": {"masses": 5, "angle": 30},
}

#: Slopes from one dt to the next that differ by no more than this are those of a straight line.
STRAIGHT = 0.03

#: A slope this near to an order shows it.
NEAR = 0.05


@dataclass(frozen=True)
class Bench:
    """A string to measure on.

    Attributes:
        name: what resists its motion.
        system: the string.
        true: where it truly is at the end, by each of the equations of motion.
        known: the catalogue's trajectories, to identify others by.
    """

    name: str
    system: MassSpringSystem
    true: Mapping[EquationsOf, State]
    known: Mapping[str, Trajectory]

    @property
    def rounding(self) -> float:
        """Errors [m] that may be those of the true motion."""
        return TOLERANCE * self.system.size


@dataclass(frozen=True)
class Row:
    """One stepper: what theory says of it, and what it was measured to do.

    Attributes:
        stepper: who stepped.
        string: the bench's name.
        scheme: what theory knows it as; None where it was not identified.
        errors: the largest distance of any mass from the true motion at the end [m], one for each of DTS; NaN where
            there is none.
        fitted: the range of DTS that the slope is fitted over; None where none is straight.
        outcome: of the first run that did not come to its end, or of any.
        reason: why there is no slope or no prediction, or why it is another string than others'; empty if all is well.
    """

    stepper: Stepper
    string: str
    scheme: SchemeStepper | None
    errors: Array
    fitted: slice | None
    outcome: Outcome
    reason: str = ""

    @property
    def predicted(self) -> int | None:
        """The order by theory."""
        return None if self.scheme is None else self.scheme.scheme.order

    @property
    def slope(self) -> float | None:
        """The measured order."""
        return None if self.fitted is None else fit(DTS[self.fitted], self.errors[self.fitted])

    @property
    def off(self) -> float | None:
        """Measured less predicted; None without either."""
        return None if self.slope is None or self.predicted is None else self.slope - self.predicted


def run(progress: Progress) -> Result:
    """Every stepper, dt after dt, against the true motion."""
    progress("true motion")
    benches = [bench(name) for name in STRINGS]
    measured = side_by_side(list(steppers_here().values()), partial(measure, benches=benches), progress)
    return result_of([row for _, row in measured])


def result_of(rows: Sequence[Row]) -> Result:
    """Rows as findings and tables."""
    return Result(_findings(rows), [_summary(rows), _errors(rows)], {"rows": rows}, _failures(rows))


def bench(name: str) -> Bench:
    """One of STRINGS, ready."""
    system = find("string").system(STRINGS[name])
    true = {e: exact(system, DURATION, 1, equations=e).states()[-1] for e in EQUATIONS}
    return Bench(name, system, true, candidates(system, float(DTS[IDENTIFYING]), STEPS[IDENTIFYING]))


def measure(stepper: Stepper, benches: Sequence[Bench]) -> Row:
    """One stepper on the first bench that it can run on."""
    refused = []
    for on in benches:
        outcomes = _series(stepper, on)
        if any(outcome.ending != "unsupported" for outcome in outcomes):
            break
        refused.append(outcomes[0].reason)
    identification = identify_beginning(stepper.name, outcomes[IDENTIFYING], on.system, on.known)
    scheme = scheme_of(stepper, identification)
    errors = _distances(outcomes, on.true[scheme.equations if scheme else SpringMotion])
    fitted = straight(errors, on.rounding)
    failed = next((outcome for outcome in outcomes if outcome.ending != "done"), None)
    reasons = [f"with {on.name} only: {reason}" for reason in refused if len(refused) < len(benches)]
    if failed is not None:
        reasons.append(failed.reason)
    elif scheme is None:
        reasons.append(str(identification))
    if failed is None and fitted is None:
        reasons.append(f"no three errors above {on.rounding:.0e} m are on a straight line")
    return Row(stepper, on.name, scheme, errors, fitted, failed or outcomes[0], "; ".join(reasons))


def straight(errors: Array, rounding: float) -> slice | None:
    """Where errors [m], of dt halved again and again, fall as a power of dt; None where they nowhere do.

    Errors up to `rounding` [m] are left out, and what is not finite. Of the rest it is the longest range of three
    neighbours or more whose slopes from one to the next (log2 of the ratio of their errors) are all within STRAIGHT of
    one another; of ranges as long, the one with the smallest dt. By theory an error is C dt^p (1 + D dt + ...):
    while D dt shows, and again once rounding does, slopes change from one to the next.
    """
    longest = None
    with np.errstate(divide="ignore", invalid="ignore"):
        slopes = np.log2(errors[:-1] / errors[1:])
    for begin in range(len(errors)):
        for end in range(begin + 3, len(errors) + 1):
            is_straight = (errors[begin:end] > rounding).all() and np.ptp(slopes[begin : end - 1]) <= STRAIGHT
            if is_straight and (longest is None or end - begin >= longest.stop - longest.start):
                longest = slice(begin, end)
    return longest


def fit(dts: Array, errors: Array) -> float:
    """The slope of log(error) over log(dt), by least squares."""
    return float(np.polyfit(np.log(dts), np.log(errors), 1)[0])


def _series(stepper: Stepper, on: Bench) -> list[Outcome]:
    """The outcomes with each of DTS; the run of a catalogued scheme that others are identified by is there already."""
    if isinstance(stepper, EngineStepper):
        return engine_series(stepper, on.system, DURATION, STEPS)
    known = on.known.get(stepper.name) if catalogued().get(stepper.name) == stepper else None
    made = {} if known is None else {STEPS[IDENTIFYING]: outcome_of(on.system, known)}
    return [made.get(n) or stepper.run(on.system, DURATION / n, n) for n in STEPS]


def _distances(outcomes: Sequence[Outcome], true: State) -> Array:
    """The largest distance of any mass from its true place at the end [m]; NaN for a run that did not get there."""
    ends = [o.trajectory.positions[-1] if o.ending == "done" and o.trajectory else np.nan for o in outcomes]
    return np.array([np.linalg.norm(end - true.positions, axis=1).max() for end in ends])


def _summary(rows: Sequence[Row]) -> Table:
    """One row per stepper: order by theory, slope, and the error with every other dt (all are in the other table)."""
    errors = [f"{milliseconds(dt)} [m]" for dt in DTS[::2]]
    columns = ["stepper", "predicted", "measured", *errors, "outcome", "reason"]
    cells = []
    for row in rows:
        distances = [finite(error) for error in row.errors[::2].tolist()]
        cells.append([row.stepper.name, row.predicted, row.slope, *distances, row.outcome.ending, row.reason or None])
    return Table("order", columns, cells)


def milliseconds(dt: float) -> str:
    """A dt [s] in words, like 4 ms and 1/4 ms."""
    return f"{1000 * dt:g} ms" if dt > 0.9e-3 else f"1/{1e-3 / dt:g} ms"


def _errors(rows: Sequence[Row]) -> Table:
    """One row per stepper and dt: what the figure draws, and what the slopes are fitted to."""
    cells = []
    for row in rows:
        named = row.scheme.name if row.scheme else None
        fitted = range(len(DTS))[row.fitted] if row.fitted else range(0)
        for i, (dt, error) in enumerate(zip(DTS.tolist(), row.errors.tolist(), strict=True)):
            cells.append([row.stepper.name, named, row.string, dt, finite(error), "yes" if i in fitted else "no"])
    columns = ["stepper", "identified as", "string with", "dt [s]", "error [m]", "in the fit"]
    return Table("order_errors", columns, cells)


def _findings(rows: Sequence[Row]) -> list[str]:
    compared = [row for row in rows if row.off is not None]
    if not compared:
        return ["No stepper has both a predicted order and a measured slope."]
    near = [row for row in compared if abs(row.off or 0.0) <= NEAR]
    furthest = max(compared, key=lambda row: abs(row.off or 0.0))
    sentences = [
        f"{len(near)} of {len(compared)} steppers have the order that theory gives them: their measured slopes are "
        f"within {NEAR:g} of it. The furthest off is {furthest.stepper.name}, {furthest.slope:.3f} where "
        f"{furthest.predicted} is predicted."
    ]
    for row in compared:
        if row not in near:
            sentences.append(f"Not as predicted: {row.stepper.name}, {row.slope:.2f} where it is {row.predicted}.")
    what = f"Errors are distances from the true motion after {DURATION:g} s, by dt in the table."
    return [*sentences, *_in_place_finding(compared), *_engines_finding(compared), what]


def _in_place_finding(rows: Sequence[Row]) -> list[str]:
    """What writing into the state that is still being read makes of the order."""
    in_place = [row for row in rows if row.stepper.kind == "in_place"]
    if not in_place:
        return []
    slopes = ", ".join(f"{row.stepper.name} {row.slope:.2f}" for row in in_place)
    return [f"Written in place, link after link, schemes have the slopes {slopes}, whatever they were meant to have."]


def _engines_finding(rows: Sequence[Row]) -> list[str]:
    """Engines lie on the lines of their schemes."""
    engines = [row for row in rows if row.stepper.kind == "engine"]
    if not engines:
        return []
    orders = sorted({row.predicted or 0 for row in engines})
    names = {p: ", ".join(row.stepper.name for row in engines if row.predicted == p) for p in orders}
    on_strings = {(row.stepper.name, row.string): row.errors for row in rows}
    distances = [
        float(np.nanmax(np.abs(row.errors - on_strings[row.scheme.name, row.string])))
        for row in engines
        if row.scheme is not None and (row.scheme.name, row.string) in on_strings
    ]
    sentences = [f"Engines of order {p}: {names[p]}." for p in orders]
    if distances:
        sentences.append(f"On the same string their errors are those of their schemes, to {max(distances):.1e} m.")
    return sentences


def _failures(rows: Sequence[Row]) -> list[str]:
    return [f"{r.stepper.name}: {r.outcome.ending}, {r.reason}" for r in rows if r.outcome.ending != "done"]


EXPERIMENT = Experiment(
    name="order",
    title="Order of accuracy",
    question="How fast does each stepper's error fall with dt?",
    slides="6-11",
    run=run,
)
