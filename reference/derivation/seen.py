"""What a stepper does with slopes and forces: those that it asks for, or where it takes them as seen from its steps."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeVar

import numpy as np

from reference.derivation.equal_parts import of_tableau
from reference.derivation.fit import Samples
from reference.derivation.force_jumps import Taken, forces_taken
from reference.derivation.implicit import implicit_multistep, implicit_tableau, tableau_by_points
from reference.derivation.multistep import Multistep, multistep_of
from reference.derivation.of_schemes import updates_of_scheme
from reference.derivation.oscillators import FEW, Runs, matrices_at, samples
from reference.derivation.recording import Recording, Solved
from reference.derivation.stages import MOST, tableau_by_jumps
from reference.derivation.step_matrix import SOFTER, StepMatrix
from reference.derivation.tableau import SAME, Tableau, tableau_of
from reference.derivation.updates import Updates, first_updates_of, updates_of
from reference.errors import Unsupported
from reference.stepper import SchemeStepper, Stepper

T = TypeVar("T")

#: How near steps have to be to those that a tableau makes, in their step matrices' entries.
AS_STEPS = 1e-5

#: A step that asks at more times than this makes steps of its own.
MOST_TIMES = 8


class Seen(NamedTuple):
    """What was seen; None, or nothing, where something was not.

    Attributes:
        updates: update formulas, where it asks for slopes.
        tableau: its Butcher tableau, where it is a Runge-Kutta method.
        multistep: its coefficients, where it solves equations and looks back.
        taken: where it takes forces, where it asks for no slopes, but only steps.
        remarks: what it does that a stepper should not.
        iterates: whether it asks more often than any explicit method: it solves equations, or makes steps of its own.
        adapts: whether it makes more steps of its own, or fewer, by what slopes are.
        first: the update formulas of a first step, of one that asks for slopes.
    """

    updates: Updates | None = None
    tableau: Tableau | None = None
    multistep: Multistep | None = None
    taken: tuple[Taken, ...] = ()
    remarks: tuple[str, ...] = ()
    iterates: bool = False
    adapts: bool = False
    first: Updates | None = None


#: Of what neither asks for slopes, nor was looked at from outside.
NOTHING = Seen()


def tried(find: Callable[[], T], reasons: list[str], words: str) -> T | None:
    """What is found; None where that cannot be, with the reason behind these words."""
    try:
        return find()
    except Unsupported as error:
        reasons.append(f"{words}{error}")
        return None


def slopes_of(stepper: Stepper, reasons: list[str]) -> Seen:
    """Of a stepper that asks for slopes."""
    if isinstance(stepper, SchemeStepper):
        if stepper.on_rods:
            return NOTHING
        scheme = stepper.scheme
        if scheme.needs != "accelerations":
            return Seen(tableau=implicit_tableau(scheme), multistep=implicit_multistep(scheme))
        updates = tried(lambda: updates_of_scheme(scheme), reasons, "no update formulas: ")
        return Seen(updates, tableau_of(updates) if updates else None)
    recorded: Callable[[], Recording | None] | None = getattr(stepper, "recording", None)
    recording = recorded() if recorded else None
    if recording is None:
        return NOTHING
    remarks: tuple[str, ...] = ("it writes into the state it is given",) if recording.overwrites else ()
    if recording.solved is not None:
        found = _of_solved(recording.solved, recording.timed, reasons)
        return found._replace(remarks=(*remarks, *found.remarks), iterates=True)
    updates = tried(lambda: updates_of(recording), reasons, "no update formulas: ")
    tableau = tableau_of(updates, recording.timed) if updates else None
    remarks += tableau.times_at_odds if tableau is not None else ()
    return Seen(updates, tableau, remarks=remarks, first=first_updates_of(recording))


def _of_solved(solved: Solved, timed: bool, reasons: list[str]) -> Seen:
    multistep = multistep_of(solved.h, solved.states, solved.rates)
    if multistep is not None:
        begun = tableau_by_points(solved.start, solved.end, solved.h, solved.points, solved.slopes)
        return Seen(multistep=multistep, first=of_tableau(begun) if begun is not None else None)
    times = len({round(part, 9) for part in solved.parts}) if timed else 0
    if times > MOST_TIMES:
        more, fewer = solved.calls
        depends = f", or {fewer} where slopes are a thousandth: it adapts its steps" if fewer != more else ""
        reasons.append(f"no tableau: it makes steps of its own; in one step it asks {more} times{depends}")
        return Seen(adapts=fewer != more)
    parts = solved.parts if timed else None
    found = tableau_by_points(solved.start, solved.end, solved.h, solved.points, solved.slopes, parts)
    if found is None:
        reasons.append("no tableau: it iterates, and its stages were not found among the points that it asks at")
        return NOTHING
    return Seen(tableau=found, remarks=found.times_at_odds)


def beside_steps(seen: Seen, runs: Runs, reasons: list[str]) -> Seen:
    """Without a tableau that was found among points, where steps of soft oscillators are not as it has them."""
    tableau = seen.tableau
    if tableau is None or tableau.within == SAME:
        return seen
    few = samples(False, False, FEW)
    at = Samples(few.a * SOFTER, few.b, few.d)
    measured = tried(lambda: matrices_at(runs, at), reasons, "its tableau was not held against its steps: ")
    if measured is None or np.abs(tableau.step_matrices(at.a) - measured).max() < AS_STEPS:
        return seen
    reasons.append(
        "no tableau: it iterates, and the points that it asks at fit one by which its steps of an oscillator would be "
        "others than they are, so these are not its stages"
    )
    return seen._replace(tableau=None)


def forces_of(runs: Runs, matrix: StepMatrix, reasons: list[str]) -> Seen:
    """Where a step takes forces, where it takes them explicitly; and its tableau, where it is a Runge-Kutta method."""
    if any(entry.divided_by("a") for entry in matrix.entries):
        return NOTHING
    taken = tried(lambda: forces_taken(runs), reasons, "where forces are taken was not seen: ")
    if not taken:
        return NOTHING
    if len(taken) > MOST:
        reasons.append(f"no tableau: {len(taken)} forces are taken in a step, and from outside {MOST} at most tell one")
    return Seen(taken=taken, tableau=tableau_by_jumps(taken, matrix))
