"""What a stepper computes, from the outside: its formulas, what follows from them, and its name where it has one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from reference.derivation.consequences import FAR, Consequences, Windows, consequences
from reference.derivation.force_jumps import Taken, forces_taken
from reference.derivation.implicit import implicit_tableau, tableau_by_points
from reference.derivation.near import SAME_TABLEAU, nearest_known
from reference.derivation.nonlinear_order import nonlinear_order
from reference.derivation.of_schemes import updates_of_scheme
from reference.derivation.oscillators import ASIDE, Run, Runs, oscillator, runs_of
from reference.derivation.oscillators import DT as OSCILLATOR_DT
from reference.derivation.pasts import Pasts, pasts
from reference.derivation.recording import LENGTHS, Recording
from reference.derivation.stages import tableau_by_jumps
from reference.derivation.step_matrix import StepMatrix, step_matrix
from reference.derivation.tableau import Tableau, tableau_of
from reference.derivation.updates import Updates, updates_of
from reference.errors import Unsupported
from reference.identification import Identification, identify
from reference.identification.scale import precision_of
from reference.outcome import Outcome
from reference.scenes import find as find_scene
from reference.stepper import SchemeStepper, Stepper

#: What it is identified on: a string of few masses, so many steps of dt [s], with damping and drag where it can.
MASSES, DT, STEPS, DAMPING, DRAG = 4, 2e-3, 60, 2.0, 0.1

#: Nothing, beside a metre.
SMALL = 1e-6

#: What is said of one that is not the same twice; and of a function, whose memory of other runs nobody ends.
NOT_TWICE = "it is random: the same step twice is not the same"
OR_REMEMBERS = "or it remembers other runs: a function is not begun anew with each run, as a file is"

#: What is said of a step that brings what is at rest elsewhere, its position and velocity exchanged.
SWAPPED = "no step matrix: velocity stands where position is, as if they were returned in the other order"

#: Of one whose matrix is another at another h.
ONLY_AT = f"h stands in its step matrix by itself, beside a, b and d: it is this at h = {OSCILLATOR_DT:g} s only"

#: Of one that returns nothing finer.
IN_SINGLE = "it computes in single precision: rounding is about 6e-08 of its numbers, which hides finer things"

#: Of one whose tableau and motion are at odds.
CONTRADICTION = (
    "a contradiction: its tableau, read off at dt = "
    + " and ".join(f"{h:g}" for h in LENGTHS)
    + f" s, is a known method's, but on a string at dt = {DT:g} s it does not move so: its rule changes with dt, "
    "or from call to call"
)


@dataclass(frozen=True, eq=False)
class Explanation:
    """All that is told of a stepper; None where something cannot be.

    Attributes:
        stepper: its name.
        identification: which scheme reproduces it, on a string.
        pasts: whether a step depends on the state alone.
        matrix: its step matrix.
        follows: what follows from that.
        updates: its update formulas, where it asks for slopes.
        tableau: its Butcher tableau, where it is a Runge-Kutta method.
        taken: where it takes forces, of a stepper that asks for no slopes, but only steps.
        nonlinear_order: the order seen on a spring that turns.
        nearest: where it has no name, the nearest scheme and in what it differs, in words.
        reasons: why something cannot be told, each a sentence without its stop.
        remarks: what it does that a stepper should not.
    """

    stepper: str
    identification: Identification
    pasts: Pasts | None = None
    matrix: StepMatrix | None = None
    follows: Consequences | None = None
    updates: Updates | None = None
    tableau: Tableau | None = None
    taken: tuple[Taken, ...] = ()
    nonlinear_order: int | None = None
    nearest: str = ""
    reasons: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()

    @property
    def failed(self) -> bool:
        """Whether nothing could be told, as no run came to an end."""
        return not self.identification.ranking and self.matrix is None and self.tableau is None

    @property
    def explicit(self) -> bool | None:
        """Whether a step is had without solving equations."""
        if self.tableau is not None:
            return self.tableau.explicit
        if self.updates is not None:
            return True
        return None if self.matrix is None else self.matrix.is_polynomial

    @property
    def order(self) -> int | None:
        """By the conditions on its tableau; else the lower of those on the oscillator and on a spring that turns.

        Both without damping, which may cost orders: `follows` has the order with damping, too.
        """
        if self.tableau is not None:
            return self.tableau.order
        if self.pasts is not None and self.pasts.one_step is False:
            return self.nonlinear_order
        known = [
            n for n in (self.follows.undamped_order if self.follows else None, self.nonlinear_order) if n is not None
        ]
        return min(known, default=None)

    @property
    def symplectic(self) -> bool | None:
        """By its tableau, which tells it of any motion; else by its determinant on the oscillator."""
        if self.tableau is not None:
            return self.tableau.symplectic
        return self.follows.symplectic if self.follows and self.of_one_step else None

    @property
    def of_one_step(self) -> bool:
        """Whether the step matrix tells all steps."""
        return self.pasts is None or self.pasts.one_step is True

    @property
    def reason(self) -> str:
        """What cannot be told and why, and what it does that it should not, in a line."""
        return "; ".join((*self.remarks, *self.reasons))

    @property
    def document(self) -> dict[str, Any]:
        """As JSON has it: fractions and formulas as text."""
        follows = self.follows if self.of_one_step else None
        return {
            "stepper": self.stepper,
            "identified_as": self.identification.identified_as,
            "one_step": self.pasts.one_step if self.pasts else None,
            "explicit": self.explicit,
            "deterministic": self.pasts.deterministic if self.pasts else None,
            "slope_evaluations": self.updates.calls if self.updates else None,
            "tableau": self.tableau.text() if self.tableau else None,
            "step_matrix": self.matrix.text() if self.matrix else None,
            "order": self.order,
            "symplectic": self.symplectic,
            "reversible": follows.reversible if follows else None,
            "stability": {
                "real_axis": first_limit(follows.real_axis) if follows else None,
                "imaginary_axis": first_limit(follows.imaginary_axis) if follows else None,
            },
            "reason": self.reason,
        }


def first_limit(windows: Windows | None) -> float | str | None:
    """Where the first interval ends; "unlimited" where it does not as far as is looked."""
    if windows is None:
        return None
    return "unlimited" if windows[0][1] >= FAR else round(windows[0][1], 9)


def explain(stepper: Stepper, tell: Callable[[str], None] = lambda what: None) -> Explanation:
    """Find out all of it.

    Args:
        stepper: a scheme, an engine, a user's own.
        tell: is told what is being done.
    """
    reasons: list[str] = []
    runs, precision = runs_of(stepper), precision_of(stepper)
    if precision == "double" and _rounds_to_single(runs):
        precision = "single"
        reasons.append(IN_SINGLE)
    begun = (ASIDE, 0.0)
    first, rest = runs([Run(oscillator(0.5, 0.0, 0.0, x), OSCILLATOR_DT) for x in begun])
    if first.ending in ("crashed", "timed out"):
        nothing = Identification(stepper.name, (), 0.0, first.reason)
        return Explanation(stepper.name, nothing, reasons=(first.reason,))
    tell("its step matrix")
    matrix = _tried(lambda: step_matrix(runs, precision), reasons, "no step matrix: ")
    damped, dragged = (matrix.damped, matrix.dragged) if matrix else (False, False)
    swapped = _swapped(rest)
    if swapped:
        reasons.append(SWAPPED)
        matrix = None
    if matrix is not None and matrix.only_at is not None:
        reasons.append(f"{ONLY_AT}: no limits of stability follow")
    tell("its past")
    past = _tried(lambda: pasts(runs, precision, damped, dragged), reasons, "whether it looks back: ")
    if past is not None and not past.deterministic:
        reason = NOT_TWICE if getattr(stepper, "begins_anew", True) else f"{NOT_TWICE}, {OR_REMEMBERS}"
        nothing = Identification(stepper.name, (), 0.0, reason)
        return Explanation(stepper.name, nothing, past, reasons=(reason,))
    tell("its slopes")
    of_slopes: list[str] = []
    updates, tableau, remarks = _asked(stepper, of_slopes)
    taken: tuple[Taken, ...] = ()
    only_steps = updates is None and tableau is None and matrix is not None and matrix.only_at is None
    if only_steps and past is not None and past.one_step and precision == "double":
        tell("where it takes forces")
        taken, tableau = _forces(runs, matrix, of_slopes)
    # rounding, not the formulas, is why these are not found
    reasons += of_slopes if IN_SINGLE not in reasons else []
    tell("its order")
    seen = None if precision == "single" else nonlinear_order(runs, False, False)
    tell("its name")
    identification = identified_on_a_string(stepper, damped, dragged)
    nearest = ""
    if identification.identified_as is None:
        reasons.append(f"not identified by its motion: {identification.reason}")
        nearest = nearest_known(tableau, updates, None if past is not None and past.one_step is False else matrix)
        if nearest.startswith(SAME_TABLEAU):
            reasons.append(CONTRADICTION)
    if past is not None and past.one_step is False:
        reasons.append("it remembers earlier steps: its step matrix is that of a first step")
    follows = consequences(matrix) if matrix and matrix.only_at is None else None
    return Explanation(
        stepper.name,
        identification,
        past,
        matrix,
        follows,
        updates,
        tableau,
        taken,
        seen,
        nearest,
        tuple(reasons),
        remarks,
    )


def _forces(runs: Runs, matrix: StepMatrix, reasons: list[str]) -> tuple[tuple[Taken, ...], Tableau | None]:
    """Where a step takes forces, where it takes them explicitly; and its tableau, where it is a Runge-Kutta method."""
    if any(entry.divided_by("a") for entry in matrix.entries):
        return (), None
    taken: tuple[Taken, ...] | None = _tried(
        lambda: forces_taken(runs), reasons, "where forces are taken was not seen: "
    )
    return (taken, tableau_by_jumps(taken, matrix)) if taken else ((), None)


def _rounds_to_single(runs: Runs) -> bool:
    """Whether numbers that a step comes to, of a system whose own are not round, are all of single precision."""
    (outcome,) = runs([Run(oscillator(0.31, 0.0, 0.0, 0.0371, 0.7123), OSCILLATOR_DT)])
    run = outcome.trajectory
    if run is None or len(run) < 2:
        return False
    ends = np.array([run.positions[-1][1, 0], run.velocities[-1][1, 0]])
    return bool(ends.all() and np.array_equal(ends, ends.astype(np.float32)))


def _swapped(rest: Outcome) -> bool:
    """Whether a step from rest at -1 m comes to 0 m, at -1 m/s."""
    run = rest.trajectory
    if run is None or len(run) < 2:
        return False
    return bool(abs(run.positions[-1][1, 0]) < SMALL and abs(run.velocities[-1][1, 0] + 1) < SMALL)


def identified_on_a_string(stepper: Stepper, damped: bool, dragged: bool) -> Identification:
    """Which scheme it is, with damping and drag or without, on a string; of what knows one mass, on an oscillator."""
    damping, drag = DAMPING if damped else 0.0, DRAG if dragged else 0.0
    string = find_scene("string").system({"masses": MASSES, "damping": damping, "drag": drag, "angle": 0.5})
    found = identify(stepper, string, DT, STEPS)
    if found.ranking:
        return found
    hanging = find_scene("spring").system({"damping": damping, "drag": drag})
    return identify(stepper, hanging, DT, STEPS)


def _tried(find: Callable[[], Any], reasons: list[str], words: str) -> Any:
    try:
        return find()
    except Unsupported as error:
        reasons.append(f"{words}{error}")
        return None


def _asked(stepper: Stepper, reasons: list[str]) -> tuple[Updates | None, Tableau | None, tuple[str, ...]]:
    """What is seen of a stepper that asks for slopes: its formulas, its tableau, what it does that it should not."""
    if isinstance(stepper, SchemeStepper):
        if stepper.on_rods or stepper.scheme.needs != "accelerations":
            return None, None if stepper.on_rods else implicit_tableau(stepper.scheme), ()
        updates = _tried(lambda: updates_of_scheme(stepper.scheme), reasons, "no update formulas: ")
        return updates, tableau_of(updates) if updates else None, ()
    recorded: Callable[[], Recording | None] | None = getattr(stepper, "recording", None)
    recording = recorded() if recorded else None
    if recording is None:
        return None, None, ()
    remarks: tuple[str, ...] = ("it writes into the state it is given",) if recording.overwrites else ()
    solved = recording.solved
    if solved is not None:
        found = tableau_by_points(solved.start, solved.end, solved.h, solved.points, solved.slopes)
        if found is None:
            reasons.append("no tableau: it iterates, and its stages were not found among the points that it asks at")
        return None, found, remarks
    updates = _tried(lambda: updates_of(recording), reasons, "no update formulas: ")
    tableau = tableau_of(updates, recording.timed) if updates else None
    if tableau is not None and tableau.times_at_odds:
        remarks += (tableau.times_at_odds,)
    return updates, tableau, remarks
