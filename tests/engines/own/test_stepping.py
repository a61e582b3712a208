"""What a step of the user's own is given, and what it asks with, are copies."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from engines.own.stepping import OwnStep
from reference.scenes import find as find_scene
from reference.state import Array

SYSTEM = find_scene("string").system({"masses": 2})


@pytest.mark.parametrize("both", [True, False])
def test_what_accelerations_are_asked_at_stays_as_it_was_asked(both: bool) -> None:
    """Also where the step writes into its arrays afterwards: who keeps them has what they were."""
    asked: list[tuple[Array, Array]] = []

    def acceleration(x: Array, v: Array) -> Array:
        asked.append((x, v))
        return 0 * x

    def step(x: Array, v: Array, dt: float, a: Any) -> tuple[Array, Array]:
        here, rate = x + 1, v + 1
        a(here, rate) if both else a(here)
        here += 100
        rate += 100
        v += 100
        return x, v

    own = OwnStep("mine", step, ("positions", "velocities", "dt", "acceleration"), SYSTEM)
    x, v = SYSTEM.start.positions, SYSTEM.start.velocities
    end = own.after_pair(x, v, 0.0, 1e-3, acceleration, None)
    ((where, how_fast),) = asked
    assert np.array_equal(where, x + 1)
    assert np.array_equal(how_fast, v + 1 if both else v)
    assert np.array_equal(end[1], v + 100)
    assert own.changes_input


def test_what_slopes_are_asked_at_stays_as_it_was_asked() -> None:
    """The same of y, with a time or without; a time is noticed."""
    asked: list[Array] = []

    def slope(t: float, y: Array) -> Array:
        asked.append(y)
        return 0 * y

    def step(f: Any, y: Array, t: float, dt: float) -> Array:
        there = y + 1
        f(there)
        there += 100
        f(t + dt, there)
        return y

    own = OwnStep("mine", step, ("slope", "state", "time", "dt"), SYSTEM)
    y = np.arange(12.0)
    assert np.array_equal(own.after(y, 0.5, 1e-3, slope), y)
    assert np.array_equal(asked, [y + 1, y + 101])
    assert (own.changes_input, own.tells_time) == (False, True)
