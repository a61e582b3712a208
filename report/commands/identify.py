"""The command that says which scheme a stepper is: identify."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.commands.options import json_option, setup_options
from report.commands.terminal import exit_if_files_failed, json_text, progress, show_table
from report.plain import plain

if TYPE_CHECKING:
    from reference.identification import Identification
    from reference.scenes import Setup


@click.command("identify")
@click.argument("stepper")
@setup_options
@json_option
def identify_command(stepper: str, setup: Setup, as_json: bool) -> None:
    """Say which scheme of the catalogue reproduces STEPPER on SCENE to rounding.

    STEPPER may be a recording of another program's, FILE.csv or FILE.npz with the columns that `simulate` writes:
    nothing of it is run. Its times say the dt, which --dt may confirm.
    """
    from experiments.runs.steppers import find_steppers
    from experiments.simulation.recorded import identify_recording, is_recording
    from reference.identification import identify_all

    if is_recording(stepper):
        recorded = Path(stepper)
        identification = identify_recording(recorded, setup, click.get_current_context().params["dt"])
        (_print_json if as_json else _show)(recorded.name, identification)
        return
    (found,) = find_steppers([stepper])
    with progress("identify") as tell:
        tell(stepper)
        outcome = found.run(setup.system, setup.dt, setup.steps, setup.changes)
        runs = [(found, outcome)]
        (identification,) = identify_all(runs, setup.system, setup.dt, setup.steps, setup.changes).each
    (_print_json if as_json else _show)(stepper, identification)
    exit_if_files_failed([(found.kind, outcome.ending)])


def _print_json(stepper: str, identification: Identification) -> None:
    from experiments.runs.comparison import finite, told

    said = told(identification)
    document = {
        "stepper": stepper,
        "identified_as": said.pop("identified_as"),
        "error_m": said.pop("identification_error_m"),
        **said,
        "same_without": dict(identification.same_without),
        "ranking": [
            {"scheme": match.scheme, "error_m": finite(match.error), "steps": match.steps}
            for match in identification.ranking
        ],
    }
    click.echo(json_text(document))


def _show(_: str, identification: Identification) -> None:
    from report.shown import of_identification

    shown = of_identification(identification)
    click.echo(shown.title)
    for note in shown.notes:
        click.echo(note)
    show_table("", shown.columns, [[scheme, plain(error), steps] for scheme, error, steps in shown.rows])
