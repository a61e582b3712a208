"""The options that several commands share, each written once.

Words of options are given their meaning here, so that a command gets dictionaries, changes and setups.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Any

import click

from report.commands.arguments import parse_changes, parse_ranges, parse_settings

#: A command, and an option's decorator, as click has them.
Command = Callable[..., Any]
Decorator = Callable[[Command], Command]

scene_argument = click.argument("scene", default="string")
dt_option = click.option("--dt", type=float, help="Step [s]; the scene's own where left out.")
duration_option = click.option("--duration", type=float, help="How long [s]; the scene's own where left out.")
settings_option = click.option(
    "--set",
    "settings",
    multiple=True,
    metavar="KEY=VALUE",
    callback=lambda context, option, words: parse_settings(words),
    help="Set a parameter of the scene.",
)
changes_option = click.option(
    "--change",
    "changes",
    multiple=True,
    metavar="T:KEY=VALUE",
    callback=lambda context, option, words: parse_changes(words),
    help="Change a parameter at a time [s], on the fly; one number, or one for each, as 1,-9.81.",
)
ranges_option = click.option(
    "--range",
    "ranges",
    multiple=True,
    metavar="KEY=LOW:HIGH",
    callback=lambda context, option, words: parse_ranges(words),
    help="The range of a map's axis.",
)
json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON.")


def steppers_option(text: str = "Only these; see `springlab list`.", required: bool = False) -> Decorator:
    """Add --stepper, any number of times, as `names`."""
    return click.option("--stepper", "names", multiple=True, required=required, metavar="NAME", help=text)


def out_option(default: Path | None, text: str | None = None) -> Decorator:
    """Add --out, a folder."""
    folder = click.Path(path_type=Path, file_okay=False)
    return click.option("--out", type=folder, default=default, show_default=default is not None, help=text)


def setup_options(command: Command) -> Command:
    """Add SCENE, --dt, --duration, --set and --change, which a command gets as one `setup`, a `reference.scenes.Setup`.

    Raises:
        InputError: when the command is called, for anything that makes no sense.
    """

    @wraps(command)
    def with_setup(
        *, scene: str, dt: float | None, duration: float | None, settings: Any, changes: Any, **others: Any
    ) -> Any:
        from reference.files.setup import setup_for

        return command(setup=setup_for(scene, dt, duration, settings, changes), **others)

    decorated: Command = with_setup
    for option in (changes_option, settings_option, duration_option, dt_option, scene_argument):
        decorated = option(decorated)
    return decorated
