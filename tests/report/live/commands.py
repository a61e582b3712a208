"""Where the commands of the page come to: their words understood as `springlab compare` understands them."""

from __future__ import annotations

import shlex
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from click.testing import CliRunner

from experiments.runs.steppers import find_steppers
from reference.changes import whole_steps
from reference.files.setup import setup_for
from reference.state import State
from report.commands.compare import compare_command
from report.live.reproduction import Reproduction


def ends(found: Reproduction, folder: Path) -> Mapping[str, State]:
    """The last state of every stepper that the commands run, in a folder with their files."""
    for name, text in found.files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return {name: state for line in found.commands for name, state in ends_of(line, folder).items()}


def ends_of(line: str, folder: Path) -> Mapping[str, State]:
    """The last state of every stepper of one command."""
    program, command, *words = shlex.split(line)
    assert (program, command) == ("springlab", "compare")
    with compare_command.make_context("compare", words) as context:
        asked = context.params
    scene = str(folder / asked["scene"]) if asked["scene"].endswith(".toml") else asked["scene"]
    setup = setup_for(scene, asked["dt"], asked["duration"], asked["settings"], asked["changes"])
    steps = whole_steps(setup.dt, setup.duration)
    last = {}
    for stepper in find_steppers(asked["names"]):
        trajectory = stepper.run(setup.system, setup.dt, steps, setup.changes).trajectory
        assert trajectory is not None
        last[stepper.name] = trajectory.states()[-1]
    return last


def begins(line: str, folder: Path) -> Any:
    """Where the masses are at first in the file of a command [m]."""
    file = folder / shlex.split(line)[2]
    return tomllib.loads(file.read_text(encoding="utf-8"))["system"]["positions"]


def run(line: str) -> str:
    """What a command prints, run as it stands in the present folder; it has to come to its end."""
    done = CliRunner().invoke(compare_command, shlex.split(line)[2:])
    assert done.exit_code == 0, done.output
    return done.output
