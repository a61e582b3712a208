"""What options say of themselves: numbers are in SI units without prefixes, on every command."""

from __future__ import annotations

from collections.abc import Iterator

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
