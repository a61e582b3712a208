"""Paths on the command line: an option names a file or a folder, never either."""

from __future__ import annotations

import click
import pytest

from report.commands.main import COMMANDS
from tests.report.commands.test_units import command, options


@pytest.mark.parametrize("name", COMMANDS)
def test_an_option_is_for_a_file_or_for_a_folder(name: str) -> None:
    """Then a folder in a file's place is refused in a line, and a file in a folder's, before anything is done."""
    paths = {option.name: option.type for option in options(command(name)) if isinstance(option.type, click.Path)}
    assert {key for key, path in paths.items() if path.file_okay == path.dir_okay} == set()
