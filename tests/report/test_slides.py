"""The table of slides: every command in it is one that runs."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from engines.engine import demands, registry
from experiments.experiment import NAMES
from experiments.runs.steppers import all_steppers
from reference.files.setup import setup_for
from reference.scenes import scenes
from report.commands.arguments import parse_changes, parse_settings

SLIDES = Path(__file__).parents[2] / "report" / "docs" / "slides.md"
COMMANDS = re.findall(r"`springlab ([^`]+)`", SLIDES.read_text(encoding="utf-8"))


def check_command(command: str) -> None:
    """Its scene takes what is set, its steppers and experiments are there."""
    what, *words = shlex.split(command)
    options: dict[str, list[str]] = {"--set": [], "--change": [], "--stepper": []}
    names = []
    while words:
        word = words.pop(0)
        if word in options:
            options[word].append(words.pop(0))
        else:
            assert not word.startswith("-"), word
            names.append(word)
    if what == "run":
        assert set(names) <= set(NAMES)
        return
    if what == "identify":
        options["--stepper"].append(names.pop(0))
    assert what in ("compare", "identify", "list")
    assert set(options["--stepper"]) <= set(all_steppers())
    for scene in names:
        setup_for(scene, settings=parse_settings(options["--set"]), changes=parse_changes(options["--change"]))


@pytest.mark.parametrize("command", [c for c in COMMANDS if c != "list"])
def test_every_command_of_the_table_is_one_that_runs(command: str) -> None:
    """Parsed and built, not run: that the scenes run is shown elsewhere."""
    check_command(command)


@pytest.mark.parametrize(
    "command",
    ["compare clooth", "compare cloth --set pinned=sides", "compare --stepper huen", "run ordre", "compare --sett x=1"],
)
def test_a_command_that_would_not_run_is_caught(command: str) -> None:
    """A slip in a name, a word, an option."""
    with pytest.raises((AssertionError, ValueError)):
        check_command(command)


def test_every_scene_is_in_the_table_and_some_engine_can_take_it() -> None:
    """By its name after `compare`."""
    for name, scene in scenes().items():
        assert any(re.match(rf"compare {name}\b", command) for command in COMMANDS), name
        asked = set(demands(scene.system({})))
        assert any(asked <= engine.capabilities for engine in registry().values()), name
