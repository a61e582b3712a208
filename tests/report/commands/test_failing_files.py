"""A stepper of one's own that does not work, in every command that runs it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.report.commands.terminal import springlab

#: A step that raises, one that returns what is not a number, and one that works.
BROKEN = "def step(x, v, dt, system):\n    raise ValueError('no slope')\n"
NO_NUMBERS = "def step(x, v, dt, system):\n    return x * float('nan'), v\n"
WORKS = "def step(x, v, dt, system):\n    return x + dt * v, v + dt * system.acceleration(x, v)\n"

COMMANDS = {
    "compare": ["compare", "string", "--duration", "0.003", "--stepper"],
    "simulate": ["simulate", "string", "--duration", "0.003", "--stepper"],
    "stability": ["stability", "oscillator", "--set", "damping=0.5", "--stepper"],
    "identify": ["identify"],
    "explain": ["explain"],
}


@pytest.mark.parametrize("as_json", [False, True])
@pytest.mark.parametrize("command", COMMANDS)
def test_a_file_that_raises_is_told_in_a_line_and_ends_with_1(command: str, as_json: bool, tmp_path: Path) -> None:
    """The line says where; the exit code says to a script that something is not as it should be."""
    file = tmp_path / "own.py"
    file.write_text(BROKEN)
    words = [*COMMANDS[command], str(file), *(["--json"] if as_json else [])]
    done = springlab(*words, *(["--out", str(tmp_path / "out")] if command == "stability" else []))
    assert done.code == 1
    assert "own.py, line 2: ValueError: no slope" in " ".join(done.out.split())
    assert "Traceback" not in done.err


@pytest.mark.parametrize("command", ["compare", "simulate", "identify"])
def test_a_file_that_works_ends_with_0(command: str, tmp_path: Path) -> None:
    """So does an engine that a command has nothing to say of."""
    file = tmp_path / "own.py"
    file.write_text(WORKS)
    assert springlab(*COMMANDS[command], str(file)).code == 0


@pytest.mark.parametrize("command", ["compare", "simulate", "identify"])
def test_a_file_that_returns_no_numbers_is_a_result_and_told(command: str, tmp_path: Path) -> None:
    """It neither raised nor took too long: a run that diverges, as an engine's may."""
    file = tmp_path / "own.py"
    file.write_text(NO_NUMBERS)
    done = springlab(*COMMANDS[command], str(file))
    assert done.code == 0
    assert "own.py returns NaN or infinity" in done.err
    assert "NaN" not in springlab("list", "--json").err
