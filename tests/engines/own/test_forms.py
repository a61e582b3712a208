"""How a step's parameters are told by their names, and its slopes and accelerations by what they are asked with."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from engines.own.forms import form_of, roles_of
from engines.own.python_file import step_in
from engines.own.stepper import stepper_of
from engines.own.system import exercise_spring
from reference.errors import InputError
from reference.scenes import find as find_scene
from reference.stepper import catalogued

STRING = find_scene("string").system({"masses": 3, "angle": 30.0, "damping": 0.1})


@pytest.mark.parametrize(
    ("names", "roles", "form"),
    [
        ("f y t dt", "slope state time dt", "slope"),
        ("h u rhs", "dt state slope", "slope"),
        ("a x v dt", "acceleration positions velocities dt", "acceleration"),
        ("x v dt s", "positions velocities dt system", "system"),
        ("pos vel t h mesh", "positions velocities time dt system", "system"),
        ("q v string dt", "positions velocities string dt", "string"),
        ("y v spring dt", "state velocities spring dt", "spring"),
    ],
)
def test_roles_are_told_by_names(names: str, roles: str, form: str) -> None:
    """In any order, with the time or without."""
    found = roles_of("mine.py: step", names.split())
    assert found == tuple(roles.split())
    assert form_of(found) == form


@pytest.mark.parametrize("names", ["f y banana dt", "x q v dt system", "x v dt", "f y x dt", "", "t"])
def test_names_of_no_form_are_told(names: str) -> None:
    """An unknown one, two of one kind, one that is missing."""
    with pytest.raises(InputError, match=r"mine\.py: step\(.*\): expected step\(x, v, dt, system\)"):
        roles_of("mine.py: step", names.split())


@pytest.mark.parametrize("defaults", ["", ", tol=1e-6", ", tol=1e-6, rounds=3, *, quiet=True"])
def test_parameters_with_defaults_are_ones_own(defaults: str) -> None:
    """However many; one before a slash is like any other."""
    for first in ("f, y", "f, /, y"):
        source = f"def step({first}, t, dt{defaults}):\n    return y\n"
        assert step_in("mine.py", source, None) == ("step", ("slope", "state", "time", "dt"))


@pytest.mark.parametrize(
    ("call", "said"),
    [
        ("f(y, t, t)", "f is called with 3 arguments"),
        ("f(t)", "f is called with 1 arguments"),
        ("f(y, y)", "f is called with 2 arguments"),
        ("f(y[:2], t)", "f is called with 2 arguments"),
    ],
)
def test_a_slope_is_asked_with_y_and_perhaps_a_time(call: str, said: str) -> None:
    """In either order; with anything else it is told what was expected."""
    names: dict[str, Any] = {}
    exec(f"def step(f, y, t, dt):\n    return y + dt * {call}\n", names)
    outcome = stepper_of(names["step"]).run(STRING, 1e-3, 2)
    assert outcome.ending == "crashed"
    assert said in outcome.reason
    for right in ("f(y, t)", "f(t, y)", "f(y)"):
        exec(f"def step(f, y, t, dt):\n    return y + dt * {right}\n", names)
        run, euler = (
            each.run(STRING, 1e-3, 3).trajectory for each in (stepper_of(names["step"]), catalogued()["euler"])
        )
        assert run is not None
        assert euler is not None
        assert np.abs(run.positions - euler.positions).max() < 1e-14


@pytest.mark.parametrize("call", ["a()", "a(x, v, v)", "a(x, 1.0, 2.0)", "a(x[:1])", "a(x, v, t, 1.0)"])
def test_an_acceleration_is_asked_with_x_and_perhaps_v(call: str) -> None:
    """And a time, which it does not mind."""
    names: dict[str, Any] = {}
    exec(f"def step(a, x, v, dt, t):\n    return x + dt * v, v + dt * {call}\n", names)
    outcome = stepper_of(names["step"]).run(STRING, 1e-3, 2)
    assert outcome.ending == "crashed"
    assert "a is called with" in outcome.reason
    for right in ("a(x)", "a(x, v)", "a(x, v, t)"):
        exec(f"def step(a, x, v, dt, t):\n    return x + dt * v, v + dt * {right}\n", names)
        run, euler = (
            each.run(STRING, 1e-3, 3).trajectory for each in (stepper_of(names["step"]), catalogued()["euler"])
        )
        assert run is not None
        assert euler is not None
        assert np.abs(run.positions - euler.positions).max() < 1e-14


@pytest.mark.parametrize(
    ("returned", "said"),
    [
        ("x", "returns an array of float64 of shape (4, 2): expected positions and velocities"),
        ("x[:2]", "returns positions of shape (2,): expected (4, 2)"),
        ("(x, v, v)", "returns 3 things: expected positions and velocities"),
        ("(x, v[:2])", "returns velocities of shape (2, 2): expected (4, 2)"),
        ("(x, 1j * v)", "returns an array of complex128 of shape (4, 2) for velocities: expected real numbers"),
        ("5", "returns a int: expected positions and velocities"),
        ("None", "returns nothing: a return is missing"),
    ],
)
def test_a_step_returns_positions_and_velocities(returned: str, said: str) -> None:
    """As a tuple, a list or an array of both; else it is told what it returned."""
    names: dict[str, Any] = {}
    exec(f"def step(a, x, v, dt):\n    return {returned}\n", names)
    outcome = stepper_of(names["step"]).run(STRING, 1e-3, 2)
    assert outcome.ending == "crashed"
    assert said in outcome.reason
    for right in ("(x, v)", "[x, v]", "np.array([x, v])"):
        exec(f"import numpy as np\ndef step(a, x, v, dt):\n    return {right}\n", names)
        still = stepper_of(names["step"]).run(STRING, 1e-3, 2).trajectory
        assert still is not None
        assert np.array_equal(still.positions[-1], STRING.positions)


def test_the_numbers_of_one_hanging_mass_are_its_own() -> None:
    """Not the fixed one's."""
    system = find_scene("oscillator").system(
        {"stiffness": 40.0, "mass": 0.3, "damping": 0.7, "rest_length": 0.5, "gravity": 4.0}
    )
    given = exercise_spring(replace(system, masses=np.array([7.0, 0.3])))
    assert vars(given) == {"mass": 0.3, "stiffness": 40.0, "rest_length": 0.5, "damping": 0.7, "gravity": 4.0}


def test_what_a_step_of_one_height_does_not_move_stays_where_it_is() -> None:
    """A spring that hangs 2 m to the right of where scenes have it: to the side its mass does not move."""
    system = find_scene("spring").system({})
    system = replace(system, positions=system.positions + np.array([2.0, 0.0]))
    names: dict[str, Any] = {}
    exec("def step(y, v, spring, dt):\n    return y + dt * v, v - dt * spring.gravity\n", names)
    run = stepper_of(names["step"]).run(system, 1e-3, 3).trajectory
    assert run is not None
    assert np.array_equal(run.positions[..., 0], np.full((4, 2), 2.0))
    assert run.velocities[1, 1].tolist() == [0.0, -1e-3 * 9.81]
