"""Command lines: commands, options and scenes as they are meant, with numbers, names and files that nobody means."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from contextlib import chdir, contextmanager
from pathlib import Path
from random import Random
from typing import Any

import pytest

from engines.process.supervisor import stop_supervisors
from reference.printable import printable
from reference.scenes import find, scenes
from reference.system import PARAMETERS
from tests.fuzz import wild
from tests.fuzz.doors import Enter
from tests.report.commands.terminal import Said, springlab

#: Commands that answer at once where they are not refused, and how often they are called.
COMMANDS = ["compare"] * 6 + ["identify"] * 3 + ["sweep", "results", "results", "stability", "live", "list"]

#: Called with what they refuse only: they would run for minutes.
REFUSING = ["run", "report", "versions"]

STEPPERS = ["heun", "euler", "kick_drift", "rk4"]


def make(random: Random) -> list[str]:
    """The words after `springlab`."""
    if random.random() < 0.1:
        return [_word(random) for _ in range(random.randint(1, 3))]
    if random.random() < 0.05:
        return [wild.one_of(random, REFUSING), f"nobody{_word(random)}", *_wild_options(random)]
    command = wild.one_of(random, COMMANDS)
    return [command, *_words_of(random, command)]


def _words_of(random: Random, command: str) -> list[str]:
    scene = _scene(random)
    if command == "list":
        return wild.one_of(random, [["--json"], [_word(random)]])
    if command == "results":
        filters = [f"{wild.one_of(random, ['dt', 'outcome', _word(random)])}={_word(random)}" for _ in range(2)]
        return [*filters[: random.randint(0, 2)], *wild.one_of(random, [[], ["--csv"], ["--json"], ["--all"]])]
    if command == "live":  # it is served to nobody: a port that nobody can have
        return [scene, "--no-open", "--port", wild.one_of(random, ["-1", "70000", "x", "1e3"]), *_wild_options(random)]
    options = [*_run_options(random, scene)]
    if command == "identify":
        return [wild.one_of(random, [*STEPPERS, _word(random)]), scene, *options]
    stepper = ["--stepper", wild.one_of(random, [*STEPPERS] * 5 + [_word(random)])]
    if command == "sweep":
        axis = f"{wild.one_of(random, [*PARAMETERS, 'dt'])}={_axis(random)}"
        options = [o for o in options if not o.startswith("--change")] + [f"--over={axis}", "--jobs", _jobs(random)]
    if command == "stability":  # what is not refused takes seconds
        options = [f"--set={_setting(random, scene)}", f"--range={_word(random)}={wild.number_text(random)}"]
    return [scene, *stepper, *options]


def _run_options(random: Random, scene: str) -> Iterator[str]:
    """A short run, unless what is wild makes another of it."""
    if random.random() < 0.8:
        yield "--duration=0.004"
    for _ in range(random.choice((0, 1, 1, 2))):
        yield f"--set={_setting(random, scene)}"
    if random.random() < 0.3:
        yield f"--dt={wild.number_text(random)}"
    if random.random() < 0.2:
        text = wild.number_text(random)
        yield f"--duration={'1e-3' if is_long(text) else text}"
    if random.random() < 0.3:
        name = wild.one_of(random, [*PARAMETERS, _word(random)])
        time = wild.one_of(random, ["0", "0.002", wild.number_text(random)])
        yield f"--change={time}:{name}={wild.number_text(random)}"


def is_long(text: str) -> bool:
    """Whether it is a duration [s] that takes minutes, and is meant so: up to the most steps that there may be."""
    try:
        return 0.1 < float(text) < 1e6
    except ValueError:
        return False


def _wild_options(random: Random) -> list[str]:
    return [f"--{wild.one_of(random, ['dt', 'set', 'host', 'out', _word(random)])}={_word(random)}"]


def _setting(random: Random, scene: str) -> str:
    names = [*find(scene).parameters] if scene in scenes() else []
    name = wild.one_of(random, [*names, *names, *PARAMETERS, _word(random)])
    if random.random() < 0.8 and names and name in names and isinstance(find(scene).parameters[name], int):
        return f"{name}={wild.one_of(random, ['0', '-1', '2', '3', '1e12', str(10**18), str(10**30), '2.5', 'nan'])}"
    return f"{name}={wild.number_text(random)}"


def _axis(random: Random) -> str:
    if random.random() < 0.4:
        return ",".join(wild.number_text(random) for _ in range(2))
    count = wild.one_of(random, ["1", "2", "0", "-1", "1e3", str(10**9), str(10**30), wild.number_text(random)])
    log = wild.one_of(random, ["", "", ":log", ":lin"])
    return f"{wild.number_text(random)}:{wild.number_text(random)}:{count}{log}"


def _jobs(random: Random) -> str:
    return wild.one_of(random, ["1", "1", "2", "0", "-1", str(10**9), "x"])


def _scene(random: Random) -> str:
    if random.random() < 0.75:
        return wild.one_of(random, ["string", "spring", "oscillator", "chain"])
    return wild.one_of(random, [*scenes(), _word(random), f"{_word(random)}.toml"])


def _word(random: Random) -> str:
    """A word as the system can hand it over: without zeros."""
    return (wild.text(random) if random.random() < 0.7 else wild.number_text(random)).replace("\x00", "")


@contextmanager
def opened(folder: Path) -> Iterator[Enter]:
    """The command line in this process, in a folder of its own, with a store of its own."""

    def enter(made: Any) -> str:
        return ending(springlab(*made))

    with pytest.MonkeyPatch.context() as patch, chdir(folder), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        patch.setenv("SPRINGLAB_STORE", str(folder / "store.sqlite"))
        patch.setenv("COLUMNS", "160")
        try:
            yield enter
        finally:
            os.chdir("/")
            stop_supervisors()


def ending(said: Said) -> str:
    """What a command has said: its results, or one line; never a traceback, nor what a terminal would obey."""
    if "Traceback" in said.out + said.err:
        return f"a traceback: {said.err[-500:]}"
    wild_letters = {c for c in said.err + said.out if c not in "\n\r" and printable(c) != c}
    if wild_letters:
        return f"letters that are none to be seen: {wild_letters}"
    if said.code == 0:
        return "taken"
    if said.code not in (1, 2):
        return f"exit code {said.code}"
    return "refused" if said.err.count("\n") == 1 else f"no single line: {said.err[-500:]!r}"
