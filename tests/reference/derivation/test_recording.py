"""What a stepper that is recorded may do with what it is given."""

from __future__ import annotations

from fractions import Fraction

from reference.derivation.recording import Slopes, record
from reference.derivation.tableau import tableau_of
from reference.derivation.updates import updates_of
from reference.state import State


def in_place(slopes: Slopes, state: State, h: float) -> State:
    """Heun's step as `k *= h` has it: both slopes are multiplied where they stand, as many write it."""
    x, v = slopes(state.time, state.positions, state.velocities)
    x *= h
    v *= h
    x2, v2 = slopes(state.time + h, state.positions + x, state.velocities + v)
    x2 *= h
    v2 *= h
    return State(state.time + h, state.positions + (x + x2) / 2, state.velocities + (v + v2) / 2)


def test_slopes_multiplied_in_place_are_as_if_they_were_not() -> None:
    """What is handed out is the stepper's own: what is noted of it does not change. So this is Heun: b = 1/2, 1/2."""
    tableau = tableau_of(updates_of(record(lambda: in_place)))
    assert tableau is not None
    assert tableau.b == (Fraction(1, 2), Fraction(1, 2))
