"""Does it matter how masses and springs are numbered?

Numbers are labels, not physics: numbered otherwise a string moves as before. A stepper that says otherwise goes through
masses or springs one after the other, and looks at what it has already changed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from engines.process.isolation import EngineStepper
from engines.pymunk.springs import PymunkSprings
from experiments.experiment import Experiment, Result, Table
from experiments.runs.claims import claimed
from experiments.runs.comparison import finite
from experiments.runs.permutation import CHANGES, PermutationEffects, permutation_effects
from experiments.runs.progress import Progress
from experiments.runs.runner import answer, current
from experiments.runs.side_by_side import side_by_side
from experiments.runs.steppers import default_steppers
from reference.identification import TOLERANCE
from reference.scenes import find
from reference.schemes.catalogue import Scheme
from reference.stepper import SchemeStepper, Stepper
from reference.system import MassSpringSystem
from reference.theory.gauss_seidel import convergence_factor

DT, STEPS = 1e-3, 200

#: Of the springs [N s/m]: with 5, a spring alone gives up 0.39 of its elongation rate in a step; and none.
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
    """One stepper on one string: whose order is predicted to show, and what each permutation changes.

    Attributes:
        damping: of the springs [N s/m].
        predicted: from the scheme that it is, or is known to step by; None where none is known.
    """

    stepper: Stepper
    damping: float
    predicted: frozenset[str] | None
    effects: PermutationEffects


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
    """Every stepper on the string numbered otherwise, and Pymunk with more and more rounds."""
    with current().threads() as pool:
        rounds = pool.submit(_pymunk_rounds)
        rows = [
            Row(stepper, damping, predicted(stepper, damping), of_damping)
            for stepper, effects in side_by_side(steppers(), effects_on, progress)
            for damping, of_damping in zip(DAMPINGS, effects, strict=True)
        ]
        progress("Pymunk's rounds")
        convergences = rounds.result()
    return result_of(rows, convergences)


def result_of(rows: Sequence[Row], convergences: Sequence[Convergence]) -> Result:
    """Rows as findings and tables."""
    tables = [_table(c, [row for row in rows if row.damping == c]) for c in DAMPINGS]
    data = {"rows": rows, "convergences": convergences, "rounding": rounding()}
    return Result(_findings(rows, convergences), [*tables, _rounds_table(convergences)], data, _failures(rows))


def steppers() -> list[Stepper]:
    """Schemes and engines. The lecture's listings know only links in their order."""
    return [stepper for stepper in default_steppers() if stepper.kind != "lecture"]


def string(damping: float) -> MassSpringSystem:
    """The default string with damped springs [N s/m]."""
    return find("string").system({"damping": damping})


def rounding() -> float:
    """A difference [m] that may be rounding."""
    return ROUNDING * string(0.0).size


def effects_on(stepper: Stepper) -> list[PermutationEffects]:
    """What every permutation changes for a stepper, for each of DAMPINGS."""
    return [permutation_effects(lambda s: stepper.run(s, DT, STEPS), string(damping)) for damping in DAMPINGS]


def predicted(stepper: Stepper, damping: float) -> frozenset[str] | None:
    """Whose order should show, by the scheme that a stepper is, or that an engine is known to step by."""
    scheme = _scheme(stepper, damping)
    if scheme is None:
        return None
    if scheme.kind == "in_place":
        return frozenset({"masses"})
    return frozenset({"springs"}) if scheme.step.__name__ in SPRING_AFTER_SPRING and damping else frozenset()


def _scheme(stepper: Stepper, damping: float) -> Scheme | None:
    if isinstance(stepper, EngineStepper):
        known = claimed(stepper.engine, "damping" if damping else "plain")
        return None if known is None else known.scheme
    assert isinstance(stepper, SchemeStepper)
    return stepper.scheme


def _pymunk_rounds() -> list[Convergence]:
    steppers = [EngineStepper(PymunkSprings(rounds=n), isolate=answer) for n in ROUNDS]
    return [convergence(c, [reversal(stepper, c) for stepper in steppers]) for c in ROUNDS_DAMPINGS]


def reversal(stepper: Stepper, damping: float) -> float:
    """What reversing the springs of a string changes [m]; NaN where it cannot be run."""
    effects = permutation_effects(lambda s: stepper.run(s, DT, STEPS), string(damping))
    return effects.distances.get("springs reversed", np.nan)


def convergence(damping: float, distances: Sequence[float]) -> Convergence:
    """Differences [m] against the rounds. What a round leaves is fitted once all springs have heard of one another."""
    system = string(damping)
    settled = [(n, d) for n, d in zip(ROUNDS, distances, strict=True) if n >= len(system.springs) and d > rounding()]
    measured = None
    if len(settled) > 1:
        n, d = np.array(settled).T
        measured = float(np.exp(np.polyfit(n, np.log(d), 1)[0]))
    return Convergence(damping, distances, convergence_factor(system, DT), measured)


def _table(damping: float, rows: Sequence[Row]) -> Table:
    """One row per stepper, on a string of one damping."""
    columns = ["stepper", "predicted: order shows of", "measured: order shows of", *(f"{c} [m]" for c in CHANGES)]
    cells = []
    for row in rows:
        seen = None if row.effects.reasons else names(row.effects.depends_on(rounding()))
        distances = [finite(row.effects.distances.get(change)) for change in CHANGES]
        cells.append([row.stepper.name, names(row.predicted), seen, *distances])
    return Table(f"numbering_damping_{damping:g}", columns, cells)


def names(orders: frozenset[str] | None) -> str | None:
    """Whose order shows, in words; None where that is not known."""
    if orders is None:
        return None
    return " and ".join(name for name in CHANGES.values() if name in orders) or "none"


def _rounds_table(convergences: Sequence[Convergence]) -> Table:
    columns = ["damping [N s/m]", "rounds", "springs reversed [m]", "predicted: a round leaves [1]", "fitted [1]"]
    rows = [
        [c.damping, n, finite(distance), c.predicted, c.measured]
        for c in convergences
        for n, distance in zip(ROUNDS, c.distances, strict=True)
    ]
    return Table("numbering_rounds", columns, rows)


def _findings(rows: Sequence[Row], convergences: Sequence[Convergence]) -> list[str]:
    ran = [row for row in rows if not row.effects.reasons]
    blind = [row for row in ran if not row.effects.depends_on(rounding())]
    sentences = [
        f"In {len(blind)} of {len(ran)} runs it does not matter how masses and springs are numbered: other numbers "
        f"change the motion by {_largest(blind):.1e} m at most, which is rounding."
    ]
    for change, whose in CHANGES.items():
        seen = [row for row in ran if whose in row.effects.depends_on(rounding())]
        if seen:
            distances = [row.effects.distances[change] for row in seen]
            sentences.append(f"With {change} {_list(seen)} differ by {min(distances):.1e} to {max(distances):.1e} m.")
    known = [row for row in ran if row.predicted is not None]
    wrong = [row for row in known if row.effects.depends_on(rounding()) != row.predicted]
    sentences.append(
        f"Whose order shows is as predicted from the scheme in {len(known) - len(wrong)} of {len(known)} runs"
        + (f"; not for {_list(wrong)}." if wrong else ".")
    )
    partly = [row for row in rows if row.effects.reasons and row.effects.permuted]
    if partly:
        sentences.append(
            f"{_list(partly)} take a string in its own order only; what they can run numbered otherwise "
            f"({_tried(partly)}) differs by {_largest(partly):.1e} m."
        )
    return sentences + [_rounds_finding(c) for c in convergences if c.measured is not None]


def _list(rows: Sequence[Row]) -> str:
    return ", ".join(dict.fromkeys(row.stepper.name for row in rows))


def _tried(rows: Sequence[Row]) -> str:
    return ", ".join(dict.fromkeys(change for row in rows for change in row.effects.distances))


def _largest(rows: Sequence[Row]) -> float:
    return max((d for row in rows for d in row.effects.distances.values()), default=0.0)


def _rounds_finding(c: Convergence) -> str:
    few, default = ROUNDS[0], PymunkSprings().rounds
    first, usual = c.distances[0], c.distances[ROUNDS.index(default)]
    return (
        f"Damped with {c.damping:g} N s/m, Pymunk's string with its springs reversed differs by {first:.1e} m with "
        f"{few} round in a step and by {usual:.1e} m with the default of {default}. From as many rounds as "
        f"springs on, each further one leaves {c.measured:.2f} of that, fitted (predicted in the long run: "
        f"{c.predicted:.2f})."
    )


def _failures(rows: Sequence[Row]) -> list[str]:
    failures = [f"{row.stepper.name}, {what}: {why}" for row in rows for what, why in row.effects.reasons.items()]
    return list(dict.fromkeys(failures))


EXPERIMENT = Experiment(
    name="numbering",
    title="Numbers are names",
    question="Does it matter in which order masses and springs are numbered?",
    slides="7-11",
    run=run,
)
