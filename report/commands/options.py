"""The options that several commands share, each written once.

Words of options are given their meaning here, so that a command gets dictionaries, changes and setups.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from functools import wraps
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from reference.errors import InputError
from report.commands.arguments import parse_changes, parse_ramps, parse_ranges, parse_settings, parse_sines

if TYPE_CHECKING:  # this imports NumPy
    from reference.stepper import Stepper

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
    help="Set a parameter of the scene, or of its springs what is not linear about them: tension_only=1, "
    "compression_only=1, hardening, largest_force, breaking_force, breaking_stretch; or radii of masses that "
    "collide, and their restitution.",
)
changes_option = click.option(
    "--change",
    "changes",
    multiple=True,
    metavar="T:KEY=VALUE",
    callback=lambda context, option, words: parse_changes(words),
    help="Change a parameter at a time [s], on the fly; one number, or one for each, as 1,-9.81. Or hold or release "
    "masses, as 0.2:release=0, or break springs, as 0.3:break=4, or pull masses [N], as 0.2:pull.3.y=-2.",
)
ramps_option = click.option(
    "--ramp",
    "ramps",
    multiple=True,
    metavar="BEGIN:END:KEY=VALUE",
    callback=lambda context, option, words: parse_ramps(words),
    help="Let a parameter go evenly to a value between two times [s].",
)
sines_option = click.option(
    "--sine",
    "sines",
    multiple=True,
    metavar="BEGIN:KEY=AMPLITUDE@HZ",
    callback=lambda context, option, words: parse_sines(words),
    help="Let a parameter swing about its value from a time [s] on.",
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


time_limit_option = click.option(
    "--time-limit", type=click.FloatRange(min=0, min_open=True), help="How long an engine may take [s]."
)


def patient(stepper: Stepper, time_limit: float | None) -> Stepper:
    """A stepper; an engine with this limit on its time [s], if one is given."""
    from engines.process.isolation import EngineStepper

    if time_limit is not None and not isfinite(time_limit):
        raise InputError(f"--time-limit {time_limit:g}: expected a finite number > 0 [s]")
    if time_limit is None or not isinstance(stepper, EngineStepper):
        return stepper
    return replace(stepper, time_limit=time_limit)


def steppers_option(text: str = "Only these; see `springlab list`.", required: bool = False) -> Decorator:
    """Add --stepper, any number of times, as `names`."""
    return click.option("--stepper", "names", multiple=True, required=required, metavar="NAME", help=text)


def out_option(default: Path | None, text: str | None = None) -> Decorator:
    """Add --out, a folder."""
    folder = click.Path(path_type=Path, file_okay=False)
    return click.option("--out", type=folder, default=default, show_default=default is not None, help=text)


def _refuse_stepper(scene: str) -> None:
    """Raises InputError for a stepper in a scene's place."""
    from experiments.runs.steppers import all_steppers

    if scene in all_steppers():
        raise InputError(f"scene {scene!r}: that is a stepper: expected a scene; identify takes STEPPER SCENE")


def setup_options(command: Command) -> Command:
    """Add SCENE, --dt, --duration, --set, --change, --ramp and --sine.

    A command gets them as one `setup`, a `reference.scenes.Setup`.

    Raises:
        InputError: when the command is called, for anything that makes no sense.
    """

    @wraps(command)
    def with_setup(
        *,
        scene: str,
        dt: float | None,
        duration: float | None,
        settings: Any,
        changes: Any,
        ramps: Any,
        sines: Any,
        **others: Any,
    ) -> Any:
        from engines.process.worker import start_beforehand

        # what engines run in imports what it needs while this process imports what schemes need
        start_beforehand()
        from reference.files.setup import setup_for

        try:
            setup = setup_for(scene, dt, duration, settings, changes, (*ramps, *sines))
        except InputError:
            _refuse_stepper(scene)
            raise
        for remark in setup.remarks:
            print(f"springlab: {remark}", file=sys.stderr)
        return command(setup=setup, **others)

    decorated: Command = with_setup
    for option in (
        sines_option,
        ramps_option,
        changes_option,
        settings_option,
        duration_option,
        dt_option,
        scene_argument,
    ):
        decorated = option(decorated)
    return decorated
