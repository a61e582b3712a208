"""Functions of this process as steppers: what they are called, how they are called, and what is said of them."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest

from engines.own.stepper import stepper_of
from engines.own.stepping import OwnStep
from engines.own.system import OwnSystem
from reference.derivation.explanation import OR_REMEMBERS
from reference.state import Array
from reference.stepper import catalogued
from tests.reference.systems import moving_string

STRING = moving_string(3, damping=0.4, drag=0.05)
DT, STEPS = 1e-3, 20


def euler(x: Array, v: Array, dt: float, system: Any) -> tuple[Array, Array]:
    """The slope here."""
    return x + dt * v, v + dt * system.acceleration(x, v)


def by_name(x: Array, v: Array, *, system: Any, dt: float) -> tuple[Array, Array]:
    """The same, asked for by name."""
    return euler(x, v, dt, system)


def scaled(scale: float, x: Array, v: Array, dt: float, system: Any) -> tuple[Array, Array]:
    """The same with a number of its own."""
    return euler(x, v, scale * dt, system)


class Object:
    """The same, as an object that is called."""

    def __call__(self, x: Array, v: Array, dt: float, system: Any) -> tuple[Array, Array]:
        """Step."""
        return euler(x, v, dt, system)


@pytest.mark.parametrize(
    ("function", "name"),
    [(euler, "euler"), (by_name, "by_name"), (partial(scaled, 1.0), "scaled"), (Object(), "Object")],
)
def test_whatever_is_called_is_a_stepper_by_its_name(function: Callable[..., Any], name: str) -> None:
    """And by another where it is given one: Euler's, to the bit."""
    assert stepper_of(function).name == name
    assert stepper_of(function, "mine").name == "mine"
    run = stepper_of(function).run(STRING, DT, STEPS).trajectory
    right = catalogued()["euler"].run(STRING, DT, STEPS).trajectory
    assert run is not None
    assert right is not None
    assert np.array_equal(run.positions, right.positions)
    assert np.array_equal(run.velocities, right.velocities)


def random(x: Array, v: Array, dt: float, system: Any) -> tuple[Array, Array]:
    """Dice."""
    return x, v + np.random.default_rng().normal()


def one_is_nan(x: Array, v: Array, dt: float, system: Any) -> tuple[Array, Array]:
    """One number of all positions is none."""
    x[1, 0] = np.nan
    return x, v


@pytest.mark.parametrize(
    ("function", "said"),
    [
        (euler, ()),
        (random, (f"random is random: the same step twice is not the same, {OR_REMEMBERS}",)),
        (
            one_is_nan,
            (
                "one_is_nan changes the arrays it is given: it was given copies",
                "one_is_nan returns NaN or infinity",
            ),
        ),
    ],
)
def test_what_is_said_of_a_function(function: Callable[..., Any], said: tuple[str, ...]) -> None:
    """Of one that is not the same twice, either; of a single number that is none; of one as it should be, nothing."""
    assert stepper_of(function).remarks() == said


@pytest.mark.parametrize(
    ("form", "roles"),
    [
        ("slope", ("slope", "state", "time", "dt")),
        ("arrays", ("positions", "velocities", "dt", "system")),
    ],
)
def test_who_returns_what_is_not_a_number_as_it_was_has_changed_nothing(form: str, roles: tuple[str, ...]) -> None:
    """NaN is no other than NaN here."""
    x, v = STRING.positions.copy(), STRING.velocities.copy()
    x[2, 1] = np.nan
    if form == "slope":
        own = OwnStep("mine", lambda f, y, t, dt: y, roles, STRING)
    else:
        own = OwnStep("mine", lambda x, v, dt, system: (x, v), roles, STRING)
    own(x, v, 0.0, DT)
    assert not own.changes_input


def test_a_system_is_given_as_arrays_of_ones_own() -> None:
    """Who writes into them changes no system, and no other step."""
    before, given = STRING.to_dict(), OwnSystem(STRING)
    expected = given.acceleration(STRING.positions, STRING.velocities)
    for name in ("masses", "fixed", "gravity", "positions", "springs", "rest_lengths", "stiffness", "damping"):
        np.testing.assert_array_equal(getattr(given, name), getattr(STRING, name))
        getattr(given, name)[...] = 0
    assert STRING.to_dict() == before
    np.testing.assert_array_equal(given.acceleration(STRING.positions, STRING.velocities), expected)
    np.testing.assert_array_equal(given.forces(STRING.positions, STRING.velocities), STRING.masses[:, None] * expected)
