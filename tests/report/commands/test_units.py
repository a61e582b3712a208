"""What options say of themselves: numbers are in SI units without prefixes, on every command."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import click
import pytest

from report.commands.main import COMMANDS, LazyGroup
from tests.units import others


def options(command: click.Command) -> Iterator[click.Option]:
    """All of a command's and of its own commands'."""
    yield from (option for option in command.params if isinstance(option, click.Option))
    if isinstance(command, click.Group):
        for inner in command.commands.values():
            yield from options(inner)


def command(name: str) -> click.Command:
    """One of springlab's."""
    found = LazyGroup().get_command(click.Context(click.Group()), name)
    assert found is not None
    return found


@pytest.mark.parametrize("name", COMMANDS)
def test_numbers_are_in_si_units(name: str) -> None:
    """But for a computer's memory."""
    assert others([option.help or "" for option in options(command(name))], "GiB") == set()


@pytest.mark.parametrize(
    ("name", "option", "says"),
    [
        ("compare", "dt", "[s]"),
        ("compare", "duration", "[s]"),
        ("translate", "stiffness", "[N/m]"),
        ("translate", "damping", "[N s/m]"),
        ("translate", "mass", "[kg]"),
    ],
)
def test_the_unit_is_that_of_the_quantity(name: str, option: str, says: str) -> None:
    """Of some."""
    (found,) = [one for one in options(command(name)) if one.name == option]
    assert says in (found.help or "")


@pytest.mark.parametrize("name", COMMANDS)
def test_what_is_taken_where_nothing_is_given_is_shown(name: str) -> None:
    """Of every option that has a default; of one that has none nothing."""
    given = {
        option.name: option.default for option in options(command(name)) if not (option.is_flag or option.multiple)
    }
    known = {key for key, value in given.items() if isinstance(value, int | float | str | Path)}
    assert {option.name for option in options(command(name)) if option.show_default} == known


def test_a_scene_comes_first_and_then_what_is_set_of_it() -> None:
    """In one order in every command's help: its step, how long, what is set, and what changes on the way."""
    for name in ("simulate", "modes", "compare", "identify"):
        first = [one.name for one in command(name).params if one.name != "stepper"][:7]
        assert first == ["scene", "dt", "duration", "settings", "changes", "ramps", "sines"]


@pytest.mark.parametrize("name", COMMANDS)
def test_what_takes_a_value_says_which(name: str) -> None:
    """All others are switches: --json, --open, --fresh ..."""
    found = {option.opts[0]: option for option in options(command(name)) if not option.hidden}
    values = {word for word, option in found.items() if not option.is_flag}
    assert {word for word in values if found[word].metavar is None and found[word].type is click.STRING} == set()
