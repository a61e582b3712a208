"""Which scheme a stepper is: run it and the catalogue, rank, and allow for rounding that the motion multiplies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from reference.changes import Change
from reference.identification.amplification import AMPLIFIED, amplified
from reference.identification.ranking import TOLERANCE, identify_run
from reference.identification.result import Identification
from reference.identification.search import candidates_for
from reference.outcome import Outcome
from reference.state import Trajectory
from reference.stepper import SchemeStepper, Stepper, stepper_named
from reference.system import MassSpringSystem


def identify(
    stepper: Stepper, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()
) -> Identification:
    """Run a stepper and the catalogue, and say which scheme it is.

    Args:
        dt: the step [s].
        steps: how many; a few hundred tell schemes apart well and keep rounding small.
    """
    outcome = stepper.run(system, dt, steps, changes)
    known = candidates_for([(stepper, outcome)], system, dt, steps, changes)
    return identify_by_rounding(stepper.name, outcome, system, known, dt, steps, changes)


def identify_by_rounding(
    name: str,
    outcome: Outcome,
    system: MassSpringSystem,
    known: Mapping[str, Trajectory],
    dt: float,
    steps: int,
    changes: Sequence[Change] = (),
) -> Identification:
    """As `identify_run`; where nothing is within the tolerance, that is what the nearest scheme makes of rounding."""
    found = identify_run(name, outcome, system, known)
    if found.identified_as is not None or not found.error <= AMPLIFIED * system.size:
        return found
    nearest = stepper_named(found.ranking[0].scheme)
    allowed = min(AMPLIFIED, amplified(nearest, known[nearest.name], system, dt, steps, changes))
    return identify_run(name, outcome, system, known, max(TOLERANCE, allowed))


def scheme_of(stepper: Stepper, identification: Identification) -> SchemeStepper | None:
    """What theory knows a stepper as: a scheme is itself, another is what it was identified as, if it was."""
    if isinstance(stepper, SchemeStepper):
        return stepper
    named = identification.identified_as
    return None if named is None else stepper_named(named)
