"""What does each stepper do to energy and momentum, which physics keeps?

An undamped string swings for a long time: its energy should stay. A free string without gravity should keep its
momentum and its angular momentum.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from experiments.experiment import Experiment, Result, Table
from experiments.runs.comparison import finite
from experiments.runs.progress import Progress
from experiments.runs.side_by_side import side_by_side
from experiments.runs.steppers import steppers_here
from reference.conserved import angular_momentum, energies, energy, momentum
from reference.identification import candidates, identify_beginning, scheme_of
from reference.motion import EquationsOf
from reference.outcome import Outcome, first_blown_up_frame
from reference.pendulum import PendulumMotion
from reference.scenes import find
from reference.state import Array, State, Trajectory
from reference.stepper import EQUATIONS, SchemeStepper, Stepper
from reference.system import MassSpringSystem
from reference.theory.energy_trend import TRENDS, EnergyTrend, predicted_energy_trend
from reference.theory.equilibria import Equilibrium, equilibrium_of
from reference.theory.equilibrium import hanging_string

#: A soft string: with this dt [s], dt w is from 0.02 to 0.20, so that slow growth and decay are slow.
STRING: Mapping[str, float] = {"masses": 3, "stiffness": 10, "angle": 60}
DT, DURATION = 5e-3, 20.0

#: The table over time has one row in this many steps. All else is told from every step.
EVERY = 8

#: How many parts the run is cut into, to see a trend in.
PARTS = 10

#: How many steps tell which scheme a stepper is.
IDENTIFYING_STEPS = 200

#: How long the free string flies [s], and how fast its masses are thrown [m/s].
FREE_DURATION, SPEED = 1.0, 0.2


@dataclass(frozen=True, eq=False)
class Row:
    """One stepper: what theory says of its energy, and what was measured.

    Attributes:
        stepper: who stepped.
        scheme: what theory knows it as; None where it was not identified.
        alike: the first scheme of the catalogue that does the same without damping; None where there is none.
        predicted: by theory; None without a scheme.
        measured: None where the run was too short to tell.
        times: of the errors [s].
        errors: energy less that at the start, as a part of what the string can give away by falling, shape (m,).
        outcome: of the long run.
        momentum: how far it gets from its start on the free string, as a part of sum m |v|; None where it did not run.
        angular_momentum: the same, as a part of sum m |v| times the size.
        free_outcome: of the run on the free string.
    """

    stepper: Stepper
    scheme: SchemeStepper | None
    alike: str | None
    predicted: EnergyTrend | None
    measured: EnergyTrend | None
    times: Array
    errors: Array
    outcome: Outcome
    momentum: float | None
    angular_momentum: float | None
    free_outcome: Outcome

    @property
    def error(self) -> float | None:
        """The largest energy error."""
        return float(np.abs(self.errors).max()) if len(self.errors) else None


@dataclass(frozen=True)
class Bench:
    """What all steppers are measured on.

    Attributes:
        system: the undamped string.
        at_rest: how it would hang still, by each of the equations of motion.
        known: the catalogue's trajectories, to identify others by.
        free: the string that nothing holds.
    """

    system: MassSpringSystem
    at_rest: Mapping[EquationsOf, Equilibrium]
    known: Mapping[str, Trajectory]
    free: MassSpringSystem


def run(progress: Progress) -> Result:
    """Every stepper on the undamped string, and on the free one."""
    progress("catalogue of schemes")
    measured = side_by_side(list(steppers_here().values()), partial(measure, on=bench()), progress)
    return result_of([row for _, row in measured])


def result_of(rows: Sequence[Row]) -> Result:
    """Rows as findings and tables."""
    data = {"rows": rows, "rounding": rounding()}
    return Result(_findings(rows), [_summary(rows), _over_time(rows)], data, _failures(rows))


def bench() -> Bench:
    """Both strings, ready."""
    system = find("string").system(STRING)
    at_rest = {equations: equilibrium_of(equations, system) for equations in EQUATIONS}
    return Bench(system, at_rest, candidates(system, DT, IDENTIFYING_STEPS), free_string(system))


def free_string(system: MassSpringSystem) -> MassSpringSystem:
    """The same springs and masses, thrown at random speeds, with nothing that holds them and no gravity."""
    velocities = np.random.default_rng(1).normal(scale=SPEED, size=system.positions.shape)
    return replace(system, fixed=np.array(False), gravity=np.array(0.0), velocities=velocities)


def measure(stepper: Stepper, on: Bench) -> Row:
    """One stepper on both strings."""
    outcome = stepper.run(on.system, DT, round(DURATION / DT))
    identification = identify_beginning(stepper.name, outcome, on.system, on.known)
    scheme = scheme_of(stepper, identification)
    predicted = None if scheme is None else predicted_energy_trend(scheme.scheme, on.at_rest[scheme.equations], DT)
    times, errors = energy_errors(on.system, outcome.trajectory)
    free = stepper.run(on.free, DT, round(FREE_DURATION / DT))
    ran = free.trajectory if free.ending == "done" else None
    return Row(
        stepper=stepper,
        scheme=scheme,
        alike=identification.identified_as,
        predicted=predicted,
        measured=measured_trend(errors),
        times=times,
        errors=errors,
        outcome=outcome,
        momentum=None if ran is None else change(on.free, ran, momentum),
        angular_momentum=None if ran is None else change(on.free, ran, angular_momentum) / on.free.size,
        free_outcome=free,
    )


def energy_errors(system: MassSpringSystem, trajectory: Trajectory | None) -> tuple[Array, Array]:
    """Times [s], and energies less that at the start, as a part of the energy that falling to rest would release.

    At every step, up to where it diverges: what comes after is not the motion of a string any more.
    """
    if trajectory is None:
        return np.zeros(0), np.zeros(0)
    whole = slice(0, first_blown_up_frame(system, trajectory))
    with np.errstate(over="ignore"):
        found = energies(system, trajectory.frames(whole))
    released = energy(system, system.start) - energy(system, hanging_string(system))
    return trajectory.times[whole], (found - energy(system, system.start)) / released


def measured_trend(errors: Array) -> EnergyTrend | None:
    """What energy errors do, evenly spaced in time: growing if their mean is larger in each of PARTS parts than before.

    Decaying if it is smaller each time. Growing, too, if an error ever exceeds what falling can release. What has no
    such trend is bounded. None for too few errors to tell.
    """
    if len(errors) < 2 * PARTS:
        return None
    trend = np.diff([part.mean() for part in np.array_split(errors, PARTS)])
    if (trend > 0).all() or errors.max() > 1:
        return "growing"
    return "decaying" if (trend < 0).all() else "bounded"


def change(
    system: MassSpringSystem, trajectory: Trajectory, quantity: Callable[[MassSpringSystem, State], Array]
) -> float:
    """How far a quantity gets from its start, as a part of sum m |v| there."""
    values = np.array([quantity(system, state) for state in trajectory.states()])
    scale = float(system.masses @ np.linalg.norm(system.velocities, axis=1))
    return float(np.abs(values - values[0]).max()) / scale


def rounding() -> float:
    """What the roundings of the free run can add up to: one per step, all in the same direction."""
    return round(FREE_DURATION / DT) * float(np.finfo(float).eps)


def _summary(rows: Sequence[Row]) -> Table:
    columns = ["stepper", "predicted", "measured", "largest energy error [1]", "momentum [1]", "angular [1]"]
    cells = []
    for row in rows:
        errors = [finite(value) for value in (row.error, row.momentum, row.angular_momentum)]
        cells.append([row.stepper.name, row.predicted, row.measured, *errors, row.outcome.ending, _reason(row)])
    return Table("energy", [*columns, "outcome", "reason"], cells)


def _reason(row: Row) -> str | None:
    reasons = [row.outcome.reason] if row.outcome.reason else []
    if row.free_outcome.reason and row.free_outcome.reason != row.outcome.reason:
        reasons.append(f"free string: {row.free_outcome.reason}")
    return "; ".join(reasons) or None


def _over_time(rows: Sequence[Row]) -> Table:
    columns = ["stepper", "identified as", "time [s]", "energy error [1]"]
    cells = [
        [row.stepper.name, row.alike, time, finite(error)]
        for row in rows
        for time, error in zip(row.times[::EVERY].tolist(), row.errors[::EVERY].tolist(), strict=True)
    ]
    return Table("energy_over_time", columns, cells)


def _findings(rows: Sequence[Row]) -> list[str]:
    compared = [row for row in rows if row.predicted and row.measured]
    if not compared:
        return ["No stepper has both a predicted and a measured kind of energy."]
    alike = [row for row in compared if row.predicted == row.measured]
    counts = ", ".join(f"{kind} in {n}" for kind in TRENDS if (n := sum(row.measured == kind for row in compared)))
    return [
        f"In {DURATION:g} s the energy of an undamped string is {counts} steppers: as predicted in {len(alike)} of "
        f"{len(compared)}.",
        *_exceptions(compared),
        *_engines(compared),
        *_momentum("momentum", {row: row.momentum for row in rows if row.momentum is not None}),
        *_in_place(rows),
        *_momentum("angular momentum", {row: row.angular_momentum for row in rows if row.angular_momentum is not None}),
        "In the table energy errors, the largest of all steps, are parts of what falling to rest would release; those "
        "of the free string's momentum are parts of sum m |v|, and of angular momentum of that times its size.",
    ]


def _exceptions(rows: Sequence[Row]) -> list[str]:
    """Those whose energy does something else than predicted."""
    sentences = []
    for predicted in TRENDS:
        for measured in TRENDS:
            found = [row for row in rows if (row.predicted, row.measured) == (predicted, measured) and row.scheme]
            if not found or predicted == measured:
                continue
            on_rods = all(row.scheme and row.scheme.equations is PendulumMotion for row in found)
            why = (
                " These really drift: the prediction is for small swings, and in large ones the mass matrix of a "
                "pendulum's angles depends on the angles, so that accelerations depend on velocities; to such "
                "equations kick-drift, drift-kick and Verlet are not symplectic."
                if on_rods and predicted == "bounded"
                else ""
            )
            sentences.append(f"Predicted {predicted}, measured {measured}: {_names(found)}.{why}")
    return sentences


def _engines(rows: Sequence[Row]) -> list[str]:
    engines = [row for row in rows if row.stepper.kind == "engine"]
    by_kind = {kind: [row for row in engines if row.measured == kind] for kind in TRENDS}
    parts = [f"{kind} in {_names(found)}" for kind, found in by_kind.items() if found]
    return [f"Of the engines, energy is {'; '.join(parts)}."] if parts else []


def _momentum(what: str, lost: Mapping[Row, float]) -> list[str]:
    """Who keeps it on the free string, and who does not."""
    if not lost:
        return []
    kept = [error for error in lost.values() if error <= rounding()]
    losers = {row: error for row, error in lost.items() if error > rounding()}
    sentences = [f"{len(kept)} of {len(lost)} steppers keep a free string's {what} to {max(kept, default=0.0):.1e}."]
    if losers:
        amounts = ", ".join(f"{row.stepper.name} {error:.1e}" for row, error in losers.items())
        sentences.append(f"The others are off by as much of it: {amounts}.")
    return sentences


def _in_place(rows: Sequence[Row]) -> list[str]:
    """The price of writing into the state that is still being read."""
    losers = [row for row in rows if row.stepper.kind == "in_place" and (row.momentum or 0.0) > rounding()]
    if not losers:
        return []
    return [
        f"In-place variants do not conserve momentum ({_names(losers)}): they take the two forces of a spring from two "
        "different states, and so the forces do not cancel."
    ]


def _names(rows: Sequence[Row]) -> str:
    return ", ".join(row.stepper.name for row in rows)


def _failures(rows: Sequence[Row]) -> list[str]:
    runs = [(row.stepper.name, row.outcome) for row in rows]
    runs += [(f"{row.stepper.name} on the free string", row.free_outcome) for row in rows]
    return [f"{name}: {outcome.ending}, {outcome.reason}" for name, outcome in runs if outcome.ending != "done"]


EXPERIMENT = Experiment(
    name="energy",
    title="Energy and momentum",
    question="What does each stepper do to energy and momentum, which physics keeps?",
    slides="7-11, 14-15",
    run=run,
)
