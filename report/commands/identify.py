"""The command that says which scheme a stepper is: identify."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import click

from report.commands.options import json_option, setup_options
from report.commands.terminal import progress, show_table
from report.plain import plain

if TYPE_CHECKING:
    from reference.identification import Identification
    from reference.scenes import Setup


@click.command("identify")
@click.argument("stepper")
@setup_options
@json_option
def identify_command(stepper: str, setup: Setup, as_json: bool) -> None:
    """Say which scheme of the catalogue reproduces STEPPER on SCENE to rounding."""
    from experiments.runs.steppers import find_steppers
    from reference.changes import whole_steps
    from reference.identification import identify

    (found,) = find_steppers([stepper])
    with progress("identify") as tell:
        tell(stepper)
        steps = whole_steps(setup.dt, setup.duration)
        identification = identify(found, setup.system, setup.dt, steps, setup.changes)
    (_print_json if as_json else _show)(stepper, identification)


def _print_json(stepper: str, identification: Identification) -> None:
    from experiments.runs.comparison import finite

    document = {
        "stepper": stepper,
        "identified_as": identification.identified_as,
        "error_m": finite(identification.error),
        "ranking": [{"scheme": match.scheme, "error_m": finite(match.error)} for match in identification.ranking],
    }
    click.echo(json.dumps(document, indent=2))


def _show(stepper: str, identification: Identification) -> None:
    from experiments.runs.comparison import finite

    click.echo(str(identification))
    also = [match.scheme for match in identification.matches[1:]]
    if also:
        click.echo(f"On this scene it cannot be told from {', '.join(also)}.")
    rows = [[match.scheme, plain(finite(match.error))] for match in identification.ranking]
    show_table("", ["scheme", "deviation [m]"], rows)
