"""Commands and files word by word, of segments made by hand: nothing has to run."""

from __future__ import annotations

import shlex
import tomllib
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from reference.scenes import find
from report.live.reproduction import ON_ONE_LINE, reproduction
from report.live.segment import Segment

SYSTEM = find("string").system({"masses": 3})
SETTINGS = {"masses": "3", "kind": "truss"}


def segment(settings: Mapping[str, str] | None = SETTINGS, steps: int = 4, **others: Any) -> Segment:
    """Heun twice and rk4 on a scene, half a second a step."""
    begin = (SYSTEM.start,) * 3
    made = Segment("string", settings, SYSTEM, ("heun", "rk4", "heun"), begin, 0.5, steps)
    return replace(made, **others)


COMMAND = "springlab compare string --stepper=heun --stepper=rk4 --dt=0.5 --duration="


def test_a_scene_its_settings_and_its_changes_are_one_line() -> None:
    """Each stepper once; changes at their times, those after the last step not; of nothing that moved one step."""
    changes = ((0, "mass", 0.25), (3, "drag", 1), (4, "mass", 7.0))
    found = reproduction(segment(changes=changes))
    assert found.commands == (
        f"{COMMAND}2.0 --set=masses=3 --set=kind=truss --change=0.0:mass=0.25 --change=1.5:drag=1",
    )
    assert (found.files, found.note) == ({}, "")
    still = reproduction(segment(steps=0, changes=((0, "mass", 0.25),)))
    assert still.commands == (f"{COMMAND}0.5 --set=masses=3 --set=kind=truss --change=0.0:mass=0.25",)
    assert still.note == "Nothing has moved yet: the command takes one step."


@pytest.mark.parametrize("many", [False, True])
def test_more_changes_or_longer_ones_are_in_a_file_that_names_the_scene(many: bool) -> None:
    """Numbers as they are, words in quotes; with its own dt and duration."""
    values: list[Any] = [1.0 + i for i in range(ON_ONE_LINE + 1)] if many else [(1.0, 2.0, 3.0)]
    changes = tuple((0, "stiffness", value) for value in values)
    on_a_line = reproduction(segment(changes=changes[: ON_ONE_LINE * many]))
    assert on_a_line.files == {}
    found = reproduction(segment(changes=changes))
    assert found.commands == (COMMAND.replace(" string ", " string-live.toml ") + "2.0",)
    ((name, text),) = found.files.items()
    said = tomllib.loads(text)
    assert (name, said["scene"], said["dt"], said["duration"]) == ("string-live.toml", "string", 0.5, 2.0)
    assert said["parameters"] == {"masses": 3, "kind": "truss"}
    wanted = [list(value) if isinstance(value, tuple) else value for value in values]
    assert said["changes"] == [{"time": 0.0, "parameter": "stiffness", "value": value} for value in wanted]


@pytest.mark.parametrize(
    ("off", "groups"),
    [
        ((0.0, 0.0), [["heun", "rk4"]]),
        ((0.1, 0.0), [["heun", "rk4"], ["heun"]]),
        ((0.0, 0.1), [["heun", "rk4"], ["heun"]]),
    ],
)
def test_what_no_command_can_name_is_written_out_for_all_that_began_alike(
    off: tuple[float, float], groups: list[list[str]]
) -> None:
    """In places and in speeds; it is said why; a file cannot name another."""
    there = SYSTEM.start
    elsewhere = replace(there, positions=there.positions + off[0], velocities=there.velocities + off[1])
    made = segment(None, scene="my/own.toml", begin=(there, there, elsewhere), changes=((3, "drag", 0.5),))
    found = reproduction(made)
    names = ["own-live.toml"] if len(groups) == 1 else ["own-live-1.toml", "own-live-2.toml"]
    assert [*found.files] == names
    for command, name, steppers in zip(found.commands, names, groups, strict=True):
        steps = [f"--stepper={stepper}" for stepper in steppers]
        assert shlex.split(command) == ["springlab", "compare", name, *steps, "--dt=0.5", "--duration=2.0"]
        said = tomllib.loads(found.files[name])
        began = elsewhere if steppers == ["heun"] else there
        assert said["system"]["positions"] == began.positions.tolist()
        assert said["system"]["velocities"] == began.velocities.tolist()
        assert said["system"]["fixed"] == np.flatnonzero(SYSTEM.fixed).tolist()
        assert said["changes"] == [{"time": 1.5, "parameter": "drag", "value": 0.5}]
    assert found.note.startswith("From the last thing on a command cannot say")
    assert "Nothing has moved" not in found.note
    assert reproduction(replace(made, steps=0)).note.endswith("Nothing has moved yet: the command takes one step.")


def test_a_file_s_own_changes_are_written_out_with_it() -> None:
    """On a line as long as they are few."""
    own = segment({}, scene="my/own.toml", changes=((0, "stiffness", (1.0, 2.0, 3.0)),))
    found = reproduction(own)
    assert [*found.files] == ["own-live.toml"]
    said = tomllib.loads(found.files["own-live.toml"])
    assert "scene" not in said
    assert said["changes"] == [{"time": 0.0, "parameter": "stiffness", "value": [1.0, 2.0, 3.0]}]
    assert found.note == ""
    few = reproduction(replace(own, changes=((0, "mass", 2.0),)))
    assert few.files == {}
    assert "my/own.toml" in few.commands[0]
