"""Whether a step depends on more than the state: on earlier steps, or on chance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.derivation.oscillators import ASIDE, DT, Run, Runs, oscillator, row_of
from reference.derivation.swings import swing
from reference.errors import Unsupported
from reference.identification.scale import ROUNDING, Precision
from reference.outcome import Outcome
from reference.state import State, Trajectory

#: Steps in a row; and after which of them it is begun anew from where it came to.
STEPS = 5

#: Steps in a row after which a step is looked at again, of what steps fast; and the oscillator's a then, so that what
#: grows does not grow far.
MANY, SLOW = 1000, 1e-4

#: a, b and d of the oscillator.
WHERE = (0.3, 0.1, 0.1)

#: Two steps from one state may differ by so many roundings.
ROUNDINGS = 1000


@dataclass(frozen=True)
class Pasts:
    """What was found.

    Attributes:
        one_step: whether from a state with a past it steps as from the same state without; None where it is random.
        deterministic: whether it does the same twice.
        apart: how far the steps with a past and without are apart, as a part of the displacement.
        steps: how many in a row were looked at.
    """

    one_step: bool | None
    deterministic: bool
    apart: float
    steps: int = STEPS


def pasts(runs: Runs, precision: Precision, damped: bool, dragged: bool, of_swings: bool = False) -> Pasts:
    """A few steps of an oscillator in a row, twice; and again one by one, begun from every state on the way.

    Args:
        damped, dragged: whether with damping, and with drag.
        of_swings: whether it is a rod that swings.

    Raises:
        Unsupported: where it cannot, with the reason.
    """
    a, b, d = WHERE
    if of_swings:
        system = swing(a, d * dragged, ASIDE, ASIDE / DT / 2)
    else:
        system = oscillator(a, b * damped, d * dragged, ASIDE, ASIDE / DT / 2)
    first, second = (_trajectory(outcome, STEPS) for outcome in runs([Run(system, DT, STEPS)] * 2))
    same = np.array_equal(first.positions, second.positions) and np.array_equal(first.velocities, second.velocities)
    states = [State(0.0, first.positions[i], first.velocities[i]) for i in range(1, STEPS)]
    ends = [_trajectory(outcome) for outcome in runs([Run(system.at(state), DT) for state in states])]
    apart = max(
        max(
            float(np.abs(end.positions[1] - first.positions[i]).max()),
            DT * float(np.abs(end.velocities[1] - first.velocities[i]).max()),
        )
        for i, end in enumerate(ends, start=2)
    )
    return Pasts(apart <= ROUNDINGS * ROUNDING[precision] if same else None, same, apart / ASIDE)


def after_many(runs: Runs, precision: Precision, found: Pasts) -> Pasts:
    """The same after a step that follows MANY others, where that is told from one that follows none.

    Raises:
        Unsupported: where the stepper cannot, with its reason.
    """
    system = oscillator(SLOW, 0.0, 0.0, ASIDE)
    (outcome,) = runs([Run(system, DT, MANY)])
    row = _trajectory(outcome)
    if len(row) <= MANY or not np.abs(row.positions[-2] + [[0.0], [1.0]]).max() < 1.0:
        return found
    (outcome,) = runs([Run(system.at(State(0.0, row.positions[-2], row.velocities[-2])), DT)])
    again = _trajectory(outcome)
    off = max(
        float(np.abs(again.positions[1] - row.positions[-1]).max()),
        DT * float(np.abs(again.velocities[1] - row.velocities[-1]).max()),
    )
    same = off <= ROUNDINGS * ROUNDING[precision]
    return Pasts(same, True, found.apart if same else off / ASIDE, MANY)


def _trajectory(outcome: Outcome, steps: int = 1) -> Trajectory:
    """What a run of so many steps left at least, all of it numbers. Raises Unsupported, with its reason, elsewhere."""
    row_of(outcome, steps)
    run = outcome.trajectory
    if run is None or not np.isfinite(run.velocities).all():
        raise Unsupported(outcome.reason or "it tells no velocities")
    return run
