"""The command that derives what a stepper computes: explain."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from reference.printable import printable
from report.commands.options import json_option
from report.commands.terminal import json_text, progress, say

if TYPE_CHECKING:
    from reference.derivation.explanation import Explanation


@click.command("explain")
@click.argument("stepper")
@json_option
@click.option(
    "--plot",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help="Also draw its stability region with measured points: FILE ends in .svg.",
)
def explain_command(stepper: str, as_json: bool, plot: Path | None) -> None:
    """Derive, from the outside only, what STEPPER computes in a step, and say what follows from it."""
    from experiments.runs.steppers import find_steppers
    from reference.derivation.explanation import explain

    if plot is not None and plot.suffix != ".svg":
        raise click.UsageError(f"--plot {plot}: expected a name that ends in .svg")
    (found,) = find_steppers([stepper])
    with progress("explain") as tell:
        explanation = explain(found, tell)
        if plot is not None:
            from report.figures.explain import draw

            tell("its stability region")
            plot.write_text(draw(explanation, found).svg(), encoding="utf-8")
    if as_json:
        click.echo(json_text(explanation.document))
    else:
        _show(explanation)
    if plot is not None:
        say(f"written: {plot}")
    if explanation.failed:
        sys.exit(1)


def _show(explanation: Explanation) -> None:
    from report.derived import name_line, sections

    click.echo(printable(f"{name_line(explanation)}."))
    for title, lines in sections(explanation):
        click.echo(f"\n{title}")
        for line in lines:
            indent = "" if line.startswith("- ") else "    "
            click.echo(f"{indent}{printable(line)}")
