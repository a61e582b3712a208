"""What a function that is given as a stepper is called, and what is taken once."""

from __future__ import annotations

from typing import Any

import pytest
from springlab.steppers import all_of, stepper_of, steppers_of

from engines.engine import registry
from engines.process.isolation import EngineStepper
from reference.errors import InputError


def function(name: str) -> Any:
    """Kick, then drift, by a name."""

    def step(a: Any, x: Any, v: Any, dt: float) -> Any:
        v = v + dt * a(x, v)
        return x + dt * v, v

    step.__name__ = name
    return step


def test_a_function_has_a_name_that_nothing_else_has() -> None:
    """Neither a scheme, nor an engine, nor another function beside it."""
    engine = next(iter(registry()))
    assert stepper_of(function("mine")).name == "mine"
    assert stepper_of(function("heun")).name == "heun (function)"
    assert stepper_of(function(engine)).name == f"{engine} (function)"
    assert stepper_of(function("mine"), taken=["mine", "mine (2)", "other"]).name == "mine (3)"
    assert stepper_of(function("heun"), taken=["heun (function)"]).name == "heun (function) (2)"


def test_each_stepper_is_taken_once_also_from_lists() -> None:
    """By its name, or as the same function; another function of the same name is another stepper."""
    one, other = function("mine"), function("mine")
    found = steppers_of(["rk4", [one, "euler", "rk4"], one, (other,)])
    assert [stepper.name for stepper in found] == ["rk4", "mine", "euler", "mine (2)"]
    assert all_of(["a"], ()) == ("a",)
    assert all_of(["a"], ["b", "c"]) == ("a", ["b", "c"])
    assert all_of([], None) == (None,)


def test_a_limit_is_of_engines_and_is_said_to_do_nothing_to_a_function() -> None:
    """A scheme needs none; what is no time is refused."""
    engine = stepper_of("pymunk_springs", 2.5)
    assert isinstance(engine, EngineStepper)
    assert engine.time_limit == 2.5
    assert stepper_of("heun", 2.5).name == "heun"
    with pytest.warns(UserWarning, match="mine is a function, and runs in this process without one") as warned:
        stepper_of(function("mine"), 2.5)
    assert [warning.filename for warning in warned] == [__file__]
    for limit in (0.0, -1.0, float("inf"), float("nan")):
        with pytest.raises(InputError, match=f"time_limit = {limit:g}: expected a finite number > 0"):
            stepper_of("heun", limit)


@pytest.mark.parametrize(("given", "shown"), [(7, "7"), ([1] * 20, repr([1] * 20)), ([1] * 21, "of type list")])
def test_what_is_no_stepper_is_shown_where_it_is_short(given: Any, shown: str) -> None:
    """Up to sixty characters; else by its type."""
    with pytest.raises(InputError) as refused:
        stepper_of(given)
    assert str(refused.value).startswith(f"stepper {shown}: expected a name")
