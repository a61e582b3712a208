"""What options shared by commands do: a limit on an engine's time, and a stepper in a scene's place."""

from __future__ import annotations

import pytest

from engines.process.isolation import EngineStepper
from experiments.runs.steppers import find_steppers
from reference.errors import InputError
from report.commands.options import patient
from tests.report.commands.terminal import springlab


def test_a_limit_on_time_is_an_engines() -> None:
    """In seconds; a scheme is as it was, and so is everybody without one."""
    scheme, engine = find_steppers(["heun", "pymunk_springs"])
    assert isinstance(engine, EngineStepper)
    limited = patient(engine, 2.5)
    assert isinstance(limited, EngineStepper)
    assert (limited.time_limit, limited.engine) == (2.5, engine.engine)
    assert patient(scheme, 2.5) is scheme
    assert patient(engine, None) is engine
    for stepper in (scheme, engine):
        with pytest.raises(InputError, match="--time-limit inf: expected a finite number > 0"):
            patient(stepper, float("inf"))


@pytest.mark.parametrize("limit", ["0", "-1"])
def test_no_time_at_all_is_refused(limit: str) -> None:
    """In a line."""
    said = springlab("simulate", "--time-limit", limit)
    assert (said.code, said.err.count("\n")) == (2, 1)
    assert "is not in the range x>0" in said.err


def test_a_stepper_in_a_scenes_place_is_told_from_an_unknown_scene() -> None:
    """With what takes both."""
    said = springlab("simulate", "heun")
    assert said.err == "springlab: scene 'heun': that is a stepper: expected a scene; identify takes STEPPER SCENE\n"
    assert "unknown scene 'hen'" in springlab("simulate", "hen").err


def test_an_unknown_command_is_named_with_what_is_like_it() -> None:
    """Whatever follows it."""
    said = springlab("simulat", "string", "--json")
    assert (said.code, said.err) == (2, "springlab: unknown command 'simulat': did you mean 'simulate'?\n")
