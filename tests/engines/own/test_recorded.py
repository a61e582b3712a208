"""What is recorded of a step of one's own: whether it asks for slopes, and says at what times."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from engines.own.stepper import stepper_of
from reference.derivation.tableau import tableau_of
from reference.derivation.updates import updates_of
from reference.state import Array
from tests.reference.systems import label


def tells(f: Any, y: Array, t: float, dt: float) -> Array:
    """Heun."""
    first = f(y, t)
    return y + dt / 2 * (first + f(y + dt * first, t + dt))


def does_not_tell(f: Any, y: Array, t: float, dt: float) -> Array:
    """The same, without times."""
    first = f(y)
    return y + dt / 2 * (first + f(y + dt * first))


def has_no_time(f: Any, y: Array, dt: float) -> Array:
    """The same, where the times are always 0."""
    first = f(0.0, y)
    return y + dt / 2 * (first + f(0.0, y + dt * first))


def by_accelerations(a: Any, x: Array, v: Array, t: float, dt: float) -> tuple[Array, Array]:
    """The same, with a time that is of no use."""
    first = a(x, v)
    second = a(x + dt * v, v + dt * first)
    return x + dt * v + dt**2 / 2 * first, v + dt / 2 * (first + second)


@pytest.mark.parametrize(
    ("step", "timed"),
    [(tells, True), (does_not_tell, False), (has_no_time, False), (by_accelerations, False)],
    ids=label,
)
def test_times_are_a_steps_own_where_it_is_given_one_and_tells_it(step: Callable[..., Any], timed: bool) -> None:
    """Those of slopes are Heun: b = 1/2, 1/2."""
    recording = stepper_of(step).recording()
    assert recording is not None
    assert recording.timed is timed
    if step is not by_accelerations:
        tableau = tableau_of(updates_of(recording), timed)
        assert tableau is not None
        assert [float(part) for part in tableau.b] == [0.5, 0.5]


def free(x: Array, v: Array, dt: float, system: Any) -> tuple[Array, Array]:
    """No force at all."""
    return x + dt * v, v


def own_forces(x: Array, v: Array, dt: float, system: Any) -> tuple[Array, Array]:
    """Forces of its own."""
    return x + dt * v, v - dt * system.stiffness[0] * x


@pytest.mark.parametrize("step", [free, own_forces], ids=label)
def test_of_a_step_that_asks_for_nothing_there_is_no_recording(step: Callable[..., Any]) -> None:
    """Be it without forces, or with forces of its own."""
    assert stepper_of(step).recording() is None
