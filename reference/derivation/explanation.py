"""What a stepper computes, from the outside: its formulas, what follows from them, and its name where it has one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from reference.derivation.consequences import FAR, Consequences, Windows, consequences
from reference.derivation.difference_equation import DifferenceEquation, difference_equation
from reference.derivation.equal_parts import EqualParts
from reference.derivation.near import SAME_TABLEAU, begun_otherwise, name_of_parts, nearest_known, parts_of
from reference.derivation.nonlinear_order import nonlinear_order, order_of_two_masses
from reference.derivation.oscillators import ASIDE, Run, Runs, oscillator, runs_of
from reference.derivation.oscillators import DT as OSCILLATOR_DT
from reference.derivation.over_dts import OverDts, over_dts
from reference.derivation.pasts import Pasts, after_many, pasts
from reference.derivation.recording import LENGTHS
from reference.derivation.seen import NOTHING, Seen, beside_steps, forces_of, slopes_of, tried
from reference.derivation.step_matrix import SOFTER as STEP_SOFTER
from reference.derivation.step_matrix import StepMatrix, step_matrix
from reference.derivation.tableau import Tableau
from reference.derivation.updates import Updates
from reference.identification import Identification, identify
from reference.identification.scale import precision_of
from reference.outcome import Outcome
from reference.scenes import find as find_scene
from reference.stepper import Stepper
from reference.system import MassSpringSystem

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

#: Of one whose tableau has roots in it.
BY_TABLEAU = "its step matrix is not written out: it is that of its tableau, whose numbers are not all fractions"

#: Of one whose formulas were seen in part.
SOFTER = (
    f"its step matrix was seen with a up to {2 * STEP_SOFTER:g}, b and d up to {STEP_SOFTER:g} only: with stiffer "
    "springs it has no formulas, as where iterations do not converge"
)
COARSER = "its step matrix is this to about 1e-9 only: something in it is differenced, or solved to few digits"

#: Of one that returns nothing finer.
IN_SINGLE = "it computes in single precision: rounding is about 6e-08 of its numbers, which hides finer things"

#: Of one whose tableau and motion are at odds.
CONTRADICTION = (
    "a contradiction: its tableau, read off at dt = "
    + " and ".join(f"{h:g}" for h in LENGTHS)
    + f" s, is a known method's, but on a string at dt = {DT:g} s it does not move so: its rule changes with dt, "
    "or from call to call"
)

#: What a step matrix is of, as JSON says it.
OF_SPRINGS, OF_RODS = "the damped oscillator", "small swings of a rod, a = h^2 g/L"

#: Of one whose order is lower where masses move one another.
OF_ONE_MASS = "the order is that of two masses that move one another; what is derived of one mass has a higher one"


@dataclass(frozen=True, eq=False)
class Explanation:
    """All that is told of a stepper; None where something cannot be.

    Attributes:
        stepper: its name.
        identification: which scheme reproduces it, on a string.
        pasts: whether a step depends on the state alone.
        matrix: its step matrix.
        follows: what follows from that.
        seen: what it does with slopes and forces.
        nonlinear_order: the order seen on a spring that turns.
        nearest: where it has no name, the nearest scheme and in what it differs, in words.
        held: at which other dt it has its name, where it has one that is not its own.
        reasons: why something cannot be told, each a sentence without its stop.
        order_among_masses: the order seen on two masses that move one another, where slopes are not seen.
        difference: what positions obey step after step, of one that remembers earlier steps.
        parts: the equal sub-steps that its formulas are made of, where they are.
        begun: which method of several steps it is by its coefficients and how it begins, where it has no name.
    """

    stepper: str
    identification: Identification
    pasts: Pasts | None = None
    matrix: StepMatrix | None = None
    follows: Consequences | None = None
    seen: Seen = NOTHING
    nonlinear_order: int | None = None
    nearest: str = ""
    held: OverDts | None = None
    reasons: tuple[str, ...] = ()
    order_among_masses: int | None = None
    difference: DifferenceEquation | None = None
    parts: EqualParts | None = None
    begun: str = ""

    @property
    def updates(self) -> Updates | None:
        """Its update formulas, where it asks for slopes."""
        return self.seen.updates

    @property
    def tableau(self) -> Tableau | None:
        """Its Butcher tableau, where it is a Runge-Kutta method."""
        return self.seen.tableau

    @property
    def remarks(self) -> tuple[str, ...]:
        """What it does that a stepper should not."""
        return self.seen.remarks

    @property
    def failed(self) -> bool:
        """Whether nothing could be told, as no run came to an end."""
        return not self.identification.ranking and self.matrix is None and self.tableau is None

    @property
    def explicit(self) -> bool | None:
        """Whether a step is had without solving equations."""
        if self.tableau is not None:
            return self.tableau.explicit
        if self.seen.multistep is not None:
            return self.seen.multistep.explicit
        if self.updates is not None:
            return True
        # rods are held by equations that small swings do not show
        return None if self.matrix is None or self.matrix.of_swings else self.matrix.is_polynomial

    @property
    def changes_with_dt(self) -> bool:
        """Whether its rule is another at another dt: what is derived at one then holds there only."""
        by_matrix = self.matrix is not None and self.matrix.only_at is not None
        return by_matrix or (self.held is not None and self.held.is_another)

    def _rules(self) -> dict[str, Any]:
        """As JSON has what holds at some dt only: where it was derived, and what it is at which dt."""
        named = self.identification.identified_as
        rules: list[tuple[float, str | None]] = [(DT, named)] if named else []
        if self.held is not None:
            rules += [(dt, self.held.scheme) for dt in self.held.same]
            rules += list(zip(self.held.other, self.held.named_there, strict=True))
        of_slopes = self.updates is not None or self.seen.iterates
        return {
            "step_matrix_at_s": OSCILLATOR_DT if self.matrix else None,
            "slopes_at_s": list(LENGTHS) if of_slopes else None,
            "rules": [{"dt_s": dt, "identified_as": name} for dt, name in sorted(rules)],
        }

    @property
    def order(self) -> int | None:
        """The order of one mass, or the lower one that is seen on two."""
        return self.order_among_masses if self.lower_among_masses else self.order_of_one_mass

    @property
    def lower_among_masses(self) -> bool:
        """Whether one mass does not show all: its order is higher than that of two that move one another."""
        one, two = self.order_of_one_mass, self.order_among_masses
        return one is not None and two is not None and two < one

    @property
    def order_of_one_mass(self) -> int | None:
        """By its tableau or coefficients; else the lower of those on the oscillator and on a spring that turns.

        Both without damping, which may cost orders: `follows` has the order with damping, too.
        """
        if self.tableau is not None:
            return self.tableau.order
        if self.seen.multistep is not None:
            return self.seen.multistep.order
        known = [n for n in (self.order_on_oscillators, self.nonlinear_order) if n is not None]
        return min(known, default=None)

    @property
    def order_on_oscillators(self) -> int | None:
        """Without damping: by its step matrix; of one that remembers earlier steps, by its difference equation."""
        if not self.of_one_step:
            return self.difference.order if self.difference else None
        return self.follows.undamped_order if self.follows else None

    @property
    def limits(self) -> tuple[Windows | None, Windows | None]:
        """In which intervals of h w, and of h c/m or h Cd/m, oscillators do not grow; None of what is not known."""
        if self.changes_with_dt:
            return None, None
        found = self.follows if self.of_one_step else self.difference
        if found is not None:
            return found.imaginary_axis, found.real_axis
        return (self.tableau.stable_along(1j), self.tableau.stable_along(-1)) if self.tableau else (None, None)

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
        of_one = (OF_ONE_MASS,) if self.lower_among_masses else ()
        return "; ".join((*self.remarks, *self.reasons, *of_one))

    @property
    def document(self) -> dict[str, Any]:
        """As JSON has it: fractions and formulas as text."""
        follows = self.follows if self.of_one_step else None
        imaginary, real = self.limits
        multistep = self.seen.multistep
        return {
            "stepper": self.stepper,
            "identified_as": self.identification.identified_as,
            "one_step": self.pasts.one_step if self.pasts else None,
            "explicit": self.explicit,
            "deterministic": self.pasts.deterministic if self.pasts else None,
            "slope_evaluations": self.updates.calls if self.updates else None,
            "tableau": self.tableau.text() if self.tableau else None,
            "step_matrix": self.matrix.text() if self.matrix else None,
            "step_matrix_of": (OF_RODS if self.matrix.of_swings else OF_SPRINGS) if self.matrix else None,
            "substeps": self.matrix.substeps if self.matrix else None,
            "substep_scheme": (name_of_parts(self.parts) or None) if self.parts else None,
            "nearest": self.begun or self.nearest or None,
            "changes_with_dt": self._rules() if self.changes_with_dt else None,
            "order": self.order,
            "symplectic": self.symplectic,
            "reversible": follows.reversible if follows else None,
            "stability": {"real_axis": first_limit(real), "imaginary_axis": first_limit(imaginary)},
            "multistep": multistep.text() if multistep else None,
            "difference_equation": self.difference.text() if self.difference else None,
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
    places = (ASIDE, 0.0)
    first, rest = runs([Run(oscillator(0.5, 0.0, 0.0, x), OSCILLATOR_DT) for x in places])
    if first.ending in ("crashed", "timed out"):
        nothing = Identification(stepper.name, (), 0.0, first.reason)
        return Explanation(stepper.name, nothing, reasons=(first.reason,))
    tell("its slopes and forces")
    of_slopes: list[str] = []
    asked = slopes_of(stepper, of_slopes)
    parts = parts_of(asked.tableau, asked.updates)
    tell("its step matrix")
    count = parts.count if parts and not parts.undamped else 1
    matrix = tried(lambda: step_matrix(runs, precision, asked.iterates, count), reasons, "no step matrix: ")
    damped, dragged = (matrix.damped, matrix.dragged) if matrix else (False, False)
    swapped = _swapped(rest)
    if swapped:
        reasons.append(SWAPPED)
        matrix = None
    reasons += matrix.left_out if matrix else ()
    if matrix is not None and matrix.softer < 1:
        reasons.append(SOFTER)
    if matrix is not None and matrix.coarser > 1:
        reasons.append(COARSER)
    if matrix is not None and matrix.only_at is not None:
        reasons.append(f"{ONLY_AT}: no limits of stability follow")
    tell("its past")
    on_rods = matrix is not None and matrix.of_swings
    past = tried(lambda: pasts(runs, precision, damped, dragged, on_rods), reasons, "whether it looks back: ")
    if past is not None and not past.deterministic:
        reason = NOT_TWICE if getattr(stepper, "begins_anew", True) else f"{NOT_TWICE}, {OR_REMEMBERS}"
        nothing = Identification(stepper.name, (), 0.0, reason)
        return Explanation(stepper.name, nothing, past, reasons=(reason,))
    seen = beside_steps(asked, runs, of_slopes)
    if past is not None and past.one_step and seen.updates is not None and getattr(stepper, "kind", "") == "own":
        short = past
        past = tried(lambda: after_many(runs, precision, short), reasons, "") or short
    if matrix is None and seen.tableau is not None and not seen.tableau.exact:
        reasons[:] = [reason for reason in reasons if not reason.startswith("no step matrix: no small")]
        reasons.append(BY_TABLEAU)
    of_one_step = past is not None and past.one_step and precision == "double"
    if seen == NOTHING and of_one_step and matrix is not None and matrix.only_at is None and not on_rods:
        seen = forces_of(runs, matrix, of_slopes)
    # rounding, not the formulas, is why these are not found
    reasons += of_slopes if IN_SINGLE not in reasons else []
    tell("its order")
    order = None if precision == "single" or on_rods or asked.adapts else nonlinear_order(runs, False, False)
    among = order_of_two_masses(runs) if of_one_step and seen.updates is None and not on_rods else None
    tell("its name")
    identification = identified_on_a_string(stepper, damped, dragged)
    nearest, begun, held = "", "", None
    name = identification.identified_as
    if name is not None and name != stepper.name:
        tell("over which dt it has that name")
        string = _string(damped, dragged)
        held = over_dts(runs, name, string, precision, lambda on, dt: identify(stepper, on, dt, STEPS).identified_as)
        held = replace(held, iterates=seen.iterates)
        reasons += [str(held)] if held.other else []
    if identification.identified_as is None:
        reasons.append(f"not identified by its motion: {identification.reason}")
        parts = parts or parts_of(seen.tableau, seen.updates)
        begun = begun_otherwise(seen.updates, seen.multistep, seen.first)
        of_steps = None if past is not None and past.one_step is False else matrix
        nearest = nearest_known(seen.tableau, seen.updates, of_steps, parts)
        if nearest.startswith(SAME_TABLEAU):
            reasons.append(CONTRADICTION)
    difference = None
    if past is not None and past.one_step is False:
        reasons.append("it remembers earlier steps: its step matrix is that of a first step")
        difference = tried(lambda: difference_equation(runs, precision), reasons, "no difference equation: ")
    # formulas of solved equations tell nothing of where these are not solved
    follows = consequences(matrix) if matrix and matrix.only_at is None and matrix.softer == 1 else None
    return Explanation(
        stepper.name,
        identification,
        past,
        matrix,
        follows,
        seen,
        order,
        nearest,
        held,
        tuple(reasons),
        among,
        difference,
        parts,
        begun,
    )


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
    found = identify(stepper, _string(damped, dragged), DT, STEPS)
    if found.ranking:
        return found
    damping, drag = DAMPING if damped else 0.0, DRAG if dragged else 0.0
    hanging = find_scene("spring").system({"damping": damping, "drag": drag})
    return identify(stepper, hanging, DT, STEPS)


def _string(damped: bool, dragged: bool) -> MassSpringSystem:
    damping, drag = DAMPING if damped else 0.0, DRAG if dragged else 0.0
    return find_scene("string").system({"masses": MASSES, "damping": damping, "drag": drag, "angle": 0.5})
