"""A mass on the cursor, and masses pinned: on masses, springs and velocities that are all different."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.state import State
from reference.system import MassSpringSystem
from report.live.cursor import at_rest_where_fixed, hook, on_hook, pinned, with_cursor, without_last

#: Springs of 100, 400 and 900 N/m from the first mass to the second, third and fourth; the fifth has none.
SYSTEM = MassSpringSystem(
    positions=np.array([[0.0, 0.0], [1.0, 0.0], [0.0, -2.0], [0.0, 2.0], [-1.0, 0.0]]),
    velocities=np.array([[0.0, 0.0], [1.0, 2.0], [3.0, 4.0], [5.0, 6.0], [7.0, 8.0]]),
    springs=np.array([[0, 1], [0, 2], [3, 0]]),
    masses=np.array([1.0, 2.0, 3.0, 4.0, 5.0]),
    rest_lengths=np.array([1.0, 2.0, 2.5]),
    stiffness=np.array([100.0, 400.0, 900.0]),
    damping=np.array([0.1, 0.2, 0.3]),
    fixed=np.array([True, False, False, False, False]),
    pulls=np.arange(10.0).reshape(5, 2),
    broken=np.array([False, False, True]),
)
PLACE = np.array([0.5, 0.25])


@pytest.mark.parametrize(("mass", "stiffest"), [(1, 100.0), (2, 400.0), (3, 900.0), (0, 900.0), (4, 900.0)])
def test_the_cursors_spring_is_a_fifth_as_stiff_as_the_stiffest_on_the_mass(mass: int, stiffest: float) -> None:
    """Of all where the mass has none; undamped, to a fixed mass just above the place that is as heavy."""
    hung = with_cursor(SYSTEM, mass, PLACE)
    length = 0.02 * SYSTEM.size
    assert hung.positions.tolist() == [*SYSTEM.positions.tolist(), pytest.approx([0.5, 0.25 + length])]
    assert hung.velocities.tolist() == [*SYSTEM.velocities.tolist(), [0, 0]]
    assert hung.pulls.tolist() == [*SYSTEM.pulls.tolist(), [0, 0]]
    assert hung.masses.tolist() == [1, 2, 3, 4, 5, mass + 1]
    assert hung.fixed.tolist() == [True, False, False, False, False, True]
    assert hung.springs.tolist() == [[0, 1], [0, 2], [3, 0], [mass, 5]]
    assert hung.rest_lengths.tolist() == [1, 2, 2.5, pytest.approx(length)]
    assert hung.stiffness.tolist() == [100, 400, 900, pytest.approx(0.2 * stiffest)]
    assert hung.damping.tolist() == [0.1, 0.2, 0.3, 0]
    assert hung.broken.tolist() == [False, False, True, False]


def test_masses_without_any_spring_can_be_held_too() -> None:
    """By one of 0.2 N/m."""
    none = np.zeros(0)
    loose = replace(
        SYSTEM, springs=np.zeros((0, 2), int), rest_lengths=none, stiffness=none, damping=none, broken=none.astype(bool)
    )
    assert with_cursor(loose, 2, PLACE).stiffness.tolist() == [0.2]


def test_a_state_hangs_on_the_hook_at_rest_and_comes_off_again() -> None:
    """With its time; the rest of it is as it was."""
    state = State(1.5, SYSTEM.positions + 0.5, SYSTEM.velocities)
    end = hook(SYSTEM, PLACE)
    hung = on_hook(state, end)
    assert hung.positions.tolist() == [*state.positions.tolist(), end.tolist()]
    assert hung.velocities.tolist() == [*state.velocities.tolist(), [0, 0]]
    off = without_last(hung)
    assert (off.time, hung.time) == (1.5, 1.5)
    assert np.array_equal(off.positions, state.positions)
    assert np.array_equal(off.velocities, state.velocities)


def test_a_mass_is_pinned_where_it_is_and_let_go_of() -> None:
    """At rest while it is fixed; what was given is left alone."""
    fixed = pinned(SYSTEM, 2)
    assert fixed.fixed.tolist() == [True, False, True, False, False]
    assert fixed.velocities.tolist() == [[0, 0], [1, 2], [0, 0], [5, 6], [7, 8]]
    assert pinned(fixed, 2).fixed.tolist() == pinned(pinned(SYSTEM, 0), 0).fixed.tolist() == SYSTEM.fixed.tolist()
    assert SYSTEM.fixed.tolist() == [True, False, False, False, False]
    state = at_rest_where_fixed(fixed, State(2.5, SYSTEM.positions, 1 + SYSTEM.velocities))
    assert state.velocities.tolist() == [[0, 0], [2, 3], [0, 0], [6, 7], [8, 9]]
    assert (state.time, state.positions.tolist()) == (2.5, SYSTEM.positions.tolist())
