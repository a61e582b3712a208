"""Does it matter how masses and springs are numbered?

Numbers are names, not physics: under other names a string moves as before. A stepper that says otherwise goes through
masses or springs one after the other, and looks at what it has already changed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from engines.process.isolation import EngineStepper
from engines.pymunk.springs import PymunkSprings
from experiments.experiment import Experiment, Result, Table
from experiments.runs.comparison import finite
from experiments.runs.permutation import CHANGES, Renamed, differences
from experiments.runs.runner import answer, current
from experiments.runs.side_by_side import Progress
from experiments.runs.steppers import default_steppers
from reference.identification import TOLERANCE
from reference.scenes import find
from reference.schemes.catalogue import Scheme
from reference.stepper import SchemeStepper, Stepper, catalogued
from reference.system import MassSpringSystem

DT, STEPS = 1e-3, 200

#: Of the springs [N s/m]: so much that in a step a spring alone gives up 0.39 of its lengthening rate; and none.
DAMPINGS = (5.0, 0.0)

#: Rounds of sequential impulses in a step of Pymunk, and the dampings they are tried with [N s/m].
ROUNDS = (1, 2, 3, 5, 7, 10, 12, 15, 20, 30, 50, 70, 100)
ROUNDS_DAMPINGS = (5.0, 20.0)

#: The schemes that go through the springs one after the other.
SPRING_AFTER_SPRING = ("drift_kick_sequential_damping",)

#: Below this part of the string's size a difference is rounding.
ROUNDING = TOLERANCE


@dataclass(frozen=True)
class Row:
    """One stepper on one string: whose order is predicted to show, and what each change of names changes.

    Attributes:
        damping: of the springs [N s/m].
        predicted: from the scheme that it is, or is known to step by; None where none is known.
    """

    stepper: Stepper
    damping: float
    predicted: frozenset[str] | None
    renamed: Renamed


@dataclass(frozen=True)
class Convergence:
    """What reversing the springs changes in Pymunk, against its rounds.

    Attributes:
        damping: of the springs [N s/m].
        distances: [m], one for each of ROUNDS; NaN where it could not run.
        predicted: what a round leaves of the difference, in the long run.
        measured: the same, fitted; None where there is nothing to fit.
    """

    damping: float
    distances: Sequence[float]
    predicted: float
    measured: float | None


def run(progress: Progress) -> Result:
    """Every stepper under other names, and Pymunk with more and more rounds."""
    with current().threads() as pool:
        rounds = pool.submit(_pymunk_rounds)
        engines = {s.name: pool.submit(renamed_by, s) for s in steppers() if isinstance(s, EngineStepper)}
        rows = []
        for stepper in steppers():
            progress(stepper.name)
            renamed = engines[stepper.name].result() if stepper.name in engines else renamed_by(stepper)
            rows += [Row(stepper, c, predicted(stepper, c), r) for c, r in zip(DAMPINGS, renamed, strict=True)]
        progress("Pymunk's rounds")
        convergences = rounds.result()
    return result_of(rows, convergences)


def result_of(rows: Sequence[Row], convergences: Sequence[Convergence]) -> Result:
    """Rows as findings and tables."""
    tables = [_table(c, [row for row in rows if row.damping == c]) for c in DAMPINGS]
    data = {"rows": rows, "convergences": convergences, "rounding": rounding()}
    return Result(_findings(rows, convergences), [*tables, _rounds_table(convergences)], data, _failures(rows))


def steppers() -> list[Stepper]:
    """Schemes and engines. The lecture's listings know nothing but links in their order."""
    return [stepper for stepper in default_steppers() if stepper.kind != "lecture"]


def string(damping: float) -> MassSpringSystem:
    """The default string with damped springs [N s/m]."""
    return find("string").system({"damping": damping})


def rounding() -> float:
    """A difference [m] that is none."""
    return ROUNDING * string(0.0).size


def renamed_by(stepper: Stepper) -> list[Renamed]:
    """A stepper under every change of names, for each of DAMPINGS."""
    return [differences(lambda s: stepper.run(s, DT, STEPS), string(damping)) for damping in DAMPINGS]


def predicted(stepper: Stepper, damping: float) -> frozenset[str] | None:
    """Whose order should show, by the scheme that a stepper is, or that an engine is known to step by."""
    scheme = _scheme(stepper, damping)
    if scheme is None:
        return None
    if scheme.kind == "in_place":
        return frozenset({"masses"})
    return frozenset({"springs"}) if scheme.name in SPRING_AFTER_SPRING and damping else frozenset()


def _scheme(stepper: Stepper, damping: float) -> Scheme | None:
    if isinstance(stepper, EngineStepper):
        named = stepper.engine.identified_as.get("damping" if damping else "plain")
        return None if named is None else catalogued()[named].scheme
    assert isinstance(stepper, SchemeStepper)
    return stepper.scheme


def _pymunk_rounds() -> list[Convergence]:
    steppers = [EngineStepper(PymunkSprings(rounds=n), isolate=answer) for n in ROUNDS]
    return [convergence(c, [reversal(stepper, c) for stepper in steppers]) for c in ROUNDS_DAMPINGS]


def reversal(stepper: Stepper, damping: float) -> float:
    """What reversing the springs of a string changes [m]; NaN where it cannot be run."""
    return differences(lambda s: stepper.run(s, DT, STEPS), string(damping)).distances.get("springs reversed", np.nan)


def convergence(damping: float, distances: Sequence[float]) -> Convergence:
    """Differences [m] against the rounds. What a round leaves is fitted once all springs have heard of one another."""
    system = string(damping)
    settled = [(n, d) for n, d in zip(ROUNDS, distances, strict=True) if n >= len(system.springs) and d > rounding()]
    measured = None
    if len(settled) > 1:
        n, d = np.array(settled).T
        measured = float(np.exp(np.polyfit(n, np.log(d), 1)[0]))
    return Convergence(damping, distances, gauss_seidel(system, DT), measured)


def gauss_seidel(system: MassSpringSystem, dt: float) -> float:
    """What a round of sequential impulses leaves of what is missing, while the springs point as they do at the start.

    A round is one of Gauss and Seidel's iteration for the springs' impulses p, (A + D) p = -J v. A = J M^-1 J^T is what
    they do to one another's lengthening rates; with its damping D the diagonal is 1 / (m' (1 - exp(-dt c / m'))), m' a
    spring's effective mass. Springs in line do most to one another. (Golub and Van Loan, *Matrix Computations*, 11.2.)
    """
    from reference.schemes.implicit_damping import effective_masses, spring_directions

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


def _table(damping: float, rows: Sequence[Row]) -> Table:
    """One row per stepper, on a string of one damping."""
    columns = ["stepper", "predicted: order shows of", "measured: order shows of", *(f"{c} [m]" for c in CHANGES)]
    cells = []
    for row in rows:
        seen = None if row.renamed.reasons else names(row.renamed.sees(rounding()))
        distances = [finite(row.renamed.distances.get(change)) for change in CHANGES]
        cells.append([row.stepper.name, names(row.predicted), seen, *distances])
    return Table(f"numbering_damping_{damping:g}", columns, cells)


def names(orders: frozenset[str] | None) -> str | None:
    """Whose order shows, in words; None where that is not known."""
    if orders is None:
        return None
    return " and ".join(name for name in CHANGES.values() if name in orders) or "none"


def _rounds_table(convergences: Sequence[Convergence]) -> Table:
    columns = ["damping [N s/m]", "rounds", "springs reversed [m]", "predicted: a round leaves", "measured"]
    rows = [
        [c.damping, n, finite(distance), c.predicted, c.measured]
        for c in convergences
        for n, distance in zip(ROUNDS, c.distances, strict=True)
    ]
    return Table("numbering_rounds", columns, rows)


def _findings(rows: Sequence[Row], convergences: Sequence[Convergence]) -> list[str]:
    ran = [row for row in rows if not row.renamed.reasons]
    blind = [row for row in ran if not row.renamed.sees(rounding())]
    sentences = [
        f"In {len(blind)} of {len(ran)} runs it does not matter how masses and springs are numbered: other names "
        f"change the motion by {_largest(blind):.1e} m at most, which is rounding."
    ]
    for change, whose in CHANGES.items():
        seen = [row for row in ran if whose in row.renamed.sees(rounding())]
        if seen:
            distances = [row.renamed.distances[change] for row in seen]
            sentences.append(f"With {change} {_list(seen)} differ by {min(distances):.1e} to {max(distances):.1e} m.")
    known = [row for row in ran if row.predicted is not None]
    wrong = [row for row in known if row.renamed.sees(rounding()) != row.predicted]
    sentences.append(
        f"Whose order shows is as predicted from the scheme in {len(known) - len(wrong)} of {len(known)} runs"
        + (f"; not for {_list(wrong)}." if wrong else ".")
    )
    partly = [row for row in rows if row.renamed.reasons and row.renamed.tried]
    if partly:
        sentences.append(
            f"{_list(partly)} take a string in its own order only; what they can run under other names "
            f"({_tried(partly)}) differs by {_largest(partly):.1e} m."
        )
    return sentences + [_rounds_finding(c) for c in convergences if c.measured is not None]


def _list(rows: Sequence[Row]) -> str:
    return ", ".join(dict.fromkeys(row.stepper.name for row in rows))


def _tried(rows: Sequence[Row]) -> str:
    return ", ".join(dict.fromkeys(change for row in rows for change in row.renamed.distances))


def _largest(rows: Sequence[Row]) -> float:
    return max((d for row in rows for d in row.renamed.distances.values()), default=0.0)


def _rounds_finding(c: Convergence) -> str:
    few, default = ROUNDS[0], PymunkSprings().rounds
    first, usual = c.distances[0], c.distances[ROUNDS.index(default)]
    return (
        f"Damped with {c.damping:g} N s/m, Pymunk's string with its springs reversed differs by {first:.1e} m with "
        f"{few} round in a step and by {usual:.1e} m with the default of {default}; each further round leaves "
        f"{c.measured:.2f} of that (predicted in the long run: {c.predicted:.2f})."
    )


def _failures(rows: Sequence[Row]) -> list[str]:
    failures = [f"{row.stepper.name}, {what}: {why}" for row in rows for what, why in row.renamed.reasons.items()]
    return list(dict.fromkeys(failures))


EXPERIMENT = Experiment(
    name="numbering",
    title="Numbers are names",
    question="Does it matter in which order masses and springs are numbered?",
    slides="7-11",
    run=run,
)
