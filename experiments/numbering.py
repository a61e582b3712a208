"""Does it matter how masses and springs are numbered?

`python -m experiments.numbering`

Numbers are names, not physics: under other names a string moves as before. A stepper that says otherwise goes through
masses or springs one after the other, and looks at what it has already changed.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from engines.engine import Engine
from engines.isolation import EngineStepper, isolated, run_engine
from engines.pymunk_springs import PymunkSprings
from experiments.comparison import Progress, finite
from experiments.experiment import Experiment, Result, Table
from experiments.steppers import default_steppers
from reference.catalogue import Scheme
from reference.damping_schemes import effective_masses, spring_directions
from reference.identify import TOLERANCE
from reference.outcome import Outcome
from reference.scenes import find
from reference.stepper import SchemeStepper, Stepper, catalogued
from reference.system import IntArray, MassSpringSystem

DT, STEPS = 1e-3, 200

#: Of the springs [N s/m]: none, and so much that in a step a spring alone gives up 0.39 of its lengthening rate.
DAMPINGS = (0.0, 5.0)

#: Rounds of sequential impulses in a step of Pymunk (10 is its default), and the dampings they are tried with [N s/m].
ROUNDS = (1, 2, 3, 5, 7, 10, 12, 15, 20, 30, 50, 100)
ROUNDS_DAMPINGS = (5.0, 20.0)

#: The schemes that go through the springs one after the other.
SPRING_AFTER_SPRING = ("drift_kick_sequential_damping",)

#: What is done to the names, and whose order it changes.
CHANGES = {"masses renumbered": "masses", "springs reversed": "springs", "ends swapped": "ends"}


@dataclass(frozen=True)
class Renamed:
    """What a stepper makes of other names for the same string.

    Attributes:
        distances: for each change that it could run, the largest distance of any mass at any time [m].
        reasons: for each change that it could not run, why.
    """

    distances: Mapping[str, float]
    reasons: Mapping[str, str]

    def sees(self, rounding: float) -> frozenset[str]:
        """Whose order changes the motion by more than rounding [m]."""
        return frozenset(CHANGES[change] for change, distance in self.distances.items() if distance > rounding)

    @property
    def tried(self) -> frozenset[str]:
        """Whose order was changed."""
        return frozenset(CHANGES[change] for change in self.distances)


@dataclass(frozen=True)
class Row:
    """One stepper on one string: whose order is predicted to show, and what each change of names changes.

    Attributes:
        damping: of the springs [N s/m].
        predicted: from the scheme that it is, or is known to step by.
    """

    stepper: Stepper
    damping: float
    predicted: frozenset[str]
    renamed: Renamed


@dataclass(frozen=True)
class Convergence:
    """What reversing the springs changes in Pymunk, against its rounds.

    Attributes:
        damping: of the springs [N s/m].
        distances: [m], one for each of ROUNDS; NaN where it could not run.
        predicted: by what a round multiplies the difference in the long run.
        measured: the same, fitted; None where there is nothing to fit.
    """

    damping: float
    distances: Sequence[float]
    predicted: float
    measured: float | None


def run(progress: Progress) -> Result:
    """Every stepper under other names, and Pymunk with more and more rounds."""
    rounding = TOLERANCE * string(0.0).size
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        cases = [(stepper, damping) for damping in DAMPINGS for stepper in steppers()]
        engines = {
            (stepper.name, damping): pool.submit(renamed_by, stepper, string(damping))
            for stepper, damping in cases
            if isinstance(stepper, EngineStepper)
        }
        rounds = [
            [pool.submit(renamed_by, EngineStepper(PymunkSprings(rounds=n)), string(damping)) for n in ROUNDS]
            for damping in ROUNDS_DAMPINGS
        ]
        rows = []
        for stepper, damping in cases:
            progress(f"{stepper.name}, damping {damping:g} N s/m")
            pending = engines.get((stepper.name, damping))
            renamed = pending.result() if pending else renamed_by(stepper, string(damping))
            rows.append(Row(stepper, damping, predicted(stepper, damping), renamed))
        progress("Pymunk's rounds")
        convergences = [
            convergence(damping, [run.result() for run in runs], rounding)
            for damping, runs in zip(ROUNDS_DAMPINGS, rounds, strict=True)
        ]
    data = {"rows": rows, "convergences": convergences, "rounding": rounding}
    tables = [_table(rows, rounding), _rounds_table(convergences)]
    return Result(_findings(rows, convergences, rounding), tables, data, _failures(rows))


def steppers() -> list[Stepper]:
    """Schemes and engines; the lecture's listings know no names but one after the other along the string."""
    return [stepper for stepper in default_steppers() if stepper.kind != "lecture"]


def string(damping: float) -> MassSpringSystem:
    """The default string with damped springs [N s/m]."""
    return find("string").system({"damping": damping})


def renamings(system: MassSpringSystem) -> dict[str, tuple[MassSpringSystem, IntArray]]:
    """The system under other names, and for each mass its number in the original. The anchor stays mass 0."""
    n = len(system.masses)
    same = np.arange(n)
    shuffled = np.concatenate([[0], 1 + np.random.default_rng(1).permutation(n - 1)])
    systems = [
        (system.renumbered(shuffled), shuffled),
        (system.with_springs_reversed(), same),
        (system.with_ends_swapped(), same),
    ]
    return dict(zip(CHANGES, systems, strict=True))


def renamed_by(stepper: Stepper, system: MassSpringSystem) -> Renamed:
    """A stepper under every change of names; an engine in one process of its own."""
    if not isinstance(stepper, EngineStepper):
        return differences(lambda system: stepper.run(system, DT, STEPS), system)
    if stepper.version is None:
        return _nothing(f"{stepper.engine.package} is not installed")
    answer = isolated(renamed_in_engine, stepper.engine, system, time_limit=stepper.time_limit)
    return answer if isinstance(answer, Renamed) else _nothing(f"{answer.ending}, {answer.reason}")


def renamed_in_engine(engine: Engine, system: MassSpringSystem) -> Renamed:
    """An engine under every change of names, in this very process."""
    return differences(lambda system: run_engine(engine, system, DT, STEPS), system)


def differences(run: Callable[[MassSpringSystem], Outcome], system: MassSpringSystem) -> Renamed:
    """How far apart the runs of a system and of the same system under other names are."""
    original = run(system)
    if original.ending != "done" or original.trajectory is None:
        return _nothing(f"{original.ending}, {original.reason}")
    distances, reasons = {}, {}
    for change, (other, order) in renamings(system).items():
        outcome = run(other)
        if outcome.ending == "done" and outcome.trajectory is not None:
            gap = outcome.trajectory.positions - original.trajectory.positions[:, order]
            distances[change] = float(np.linalg.norm(gap, axis=2).max())
        else:
            reasons[change] = f"{outcome.ending}, {outcome.reason}"
    return Renamed(distances, reasons)


def _nothing(reason: str) -> Renamed:
    return Renamed({}, dict.fromkeys(CHANGES, reason))


def predicted(stepper: Stepper, damping: float) -> frozenset[str]:
    """Whose order should show, by the scheme that a stepper is, or that an engine is known to step by."""
    scheme = _scheme(stepper, damping)
    if scheme.kind == "in_place":
        return frozenset({"masses"})
    return frozenset({"springs"}) if scheme.name in SPRING_AFTER_SPRING and damping else frozenset()


def _scheme(stepper: Stepper, damping: float) -> Scheme:
    if isinstance(stepper, EngineStepper):
        return catalogued()[stepper.engine.identified_as["damping" if damping else "plain"]].scheme
    assert isinstance(stepper, SchemeStepper)
    return stepper.scheme


def convergence(damping: float, runs: Sequence[Renamed], rounding: float) -> Convergence:
    """The difference against the rounds; the factor is fitted once all springs have heard of one another."""
    system = string(damping)
    distances = [renamed.distances.get("springs reversed", np.nan) for renamed in runs]
    settled = [(n, d) for n, d in zip(ROUNDS, distances, strict=True) if n >= len(system.springs) and d > rounding]
    measured = None
    if len(settled) > 1:
        n, d = np.array(settled).T
        measured = float(np.exp(np.polyfit(n, np.log(d), 1)[0]))
    return Convergence(damping, distances, gauss_seidel(system, DT), measured)


def gauss_seidel(system: MassSpringSystem, dt: float) -> float:
    """By what a round of sequential impulses multiplies what is still missing, while the springs point as at the start.

    A round is one of Gauss and Seidel's iteration for the springs' impulses p, (A + D) p = -J v. A = J J^T / m is what
    they do to one another's lengthening rates, and the damping makes its diagonal 1 / (m' (1 - exp(-dt c / m'))), m' a
    spring's effective mass. Springs in line do most to one another. (Golub and Van Loan, *Matrix Computations*, 11.2.)
    """
    count, (a, b) = np.arange(len(system.springs)), system.springs.T
    rates = np.zeros((len(system.springs), *system.positions.shape))
    rates[count, b] = spring_directions(system, system.start)
    rates[count, a] = -rates[count, b]
    rates[:, system.fixed] = 0.0
    mutual = np.einsum("jnd,knd,n->jk", rates, rates, 1 / system.masses)
    mass = effective_masses(system)
    mutual[count, count] = -1 / (mass * np.expm1(-dt * system.damping / mass))
    lower = np.tril(mutual)
    return float(np.abs(np.linalg.eigvals(np.linalg.solve(lower, lower - mutual))).max())


def _table(rows: Sequence[Row], rounding: float) -> Table:
    columns = ["stepper", "damping [N s/m]", "predicted: order that shows", "measured: order that shows"]
    columns += [*(f"{change} [m]" for change in CHANGES), "reason"]
    cells = []
    for row in rows:
        seen = row.renamed.sees(rounding) if row.renamed.tried else None
        distances = [row.renamed.distances.get(change) for change in CHANGES]
        reason = "; ".join(dict.fromkeys(row.renamed.reasons.values()))
        cells.append([row.stepper.name, row.damping, _names(row.predicted), _names(seen), *map(finite, distances), reason])
    return Table("numbering", columns, cells)


def _names(orders: frozenset[str] | None) -> str | None:
    if orders is None:
        return None
    return " and ".join(name for name in CHANGES.values() if name in orders) or "none"


def _rounds_table(convergences: Sequence[Convergence]) -> Table:
    columns = ["damping [N s/m]", "rounds", "springs reversed [m]", "predicted factor per round", "measured factor"]
    rows = [
        [c.damping, n, finite(distance), c.predicted, c.measured]
        for c in convergences
        for n, distance in zip(ROUNDS, c.distances, strict=True)
    ]
    return Table("numbering_rounds", columns, rows)


def _findings(rows: Sequence[Row], convergences: Sequence[Convergence], rounding: float) -> list[str]:
    ran = [row for row in rows if row.renamed.tried]
    blind = [row for row in ran if not row.renamed.sees(rounding)]
    largest = max((d for row in blind for d in row.renamed.distances.values()), default=0.0)
    sentences = [
        f"In {len(blind)} of {len(ran)} runs it does not matter how masses and springs are numbered: other names "
        f"change the motion by {largest:.1e} m at most, which is rounding."
    ]
    for change, whose in CHANGES.items():
        seen = [row for row in ran if whose in row.renamed.sees(rounding)]
        if seen:
            names = ", ".join(dict.fromkeys(row.stepper.name for row in seen))
            distances = [row.renamed.distances[change] for row in seen]
            sentences.append(
                f"With {change} there is a difference of {min(distances):.1e} to {max(distances):.1e} m in {names}."
            )
    wrong = [row for row in ran if row.renamed.sees(rounding) != row.predicted & row.renamed.tried]
    sentences.append(
        f"Whose order shows was predicted from the scheme in {len(ran) - len(wrong)} of {len(ran)} runs"
        + (f", but not for {', '.join(dict.fromkeys(row.stepper.name for row in wrong))}." if wrong else ".")
    )
    for c in convergences:
        if c.measured is not None:
            sentences.append(
                f"With damping {c.damping:g} N s/m the order of the springs changes Pymunk's motion by "
                f"{c.distances[0]:.1e} m with {ROUNDS[0]} round in a step, by {c.distances[ROUNDS.index(10)]:.1e} m "
                f"with its default of 10, and each further round leaves {c.measured:.2f} of that (predicted for the "
                f"straight string: {c.predicted:.2f})."
            )
    return sentences


def _failures(rows: Sequence[Row]) -> list[str]:
    return list(
        dict.fromkeys(
            f"{row.stepper.name}, {change}: {reason}" for row in rows for change, reason in row.renamed.reasons.items()
        )
    )


EXPERIMENT = Experiment(
    name="numbering",
    title="Numbers are names",
    question="Does it matter in which order masses and springs are numbered?",
    slides="7-11",
    run=run,
)

if __name__ == "__main__":
    from experiments.console import main

    main(EXPERIMENT)
