"""The command that runs steppers side by side, in numbers and in moving pictures: compare."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.commands.arguments import parse_changes, parse_settings, setup_for
from report.commands.identify import run_options
from report.commands.terminal import RESULTS, progress, show_table

if TYPE_CHECKING:
    from experiments.runs.comparison import Comparison

#: What --animate is without a file name.
UNNAMED = "-"


@click.command("compare")
@click.argument("scene", default="string")
@click.option("--stepper", "names", multiple=True, metavar="NAME", help="Only these; see `springlab list`.")
@run_options
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), help="Also write CSV and JSON files here.")
@click.option(
    "--animate",
    is_flag=False,
    flag_value=UNNAMED,
    metavar="[FILE]",
    help="Also draw the reference and all engines, or the steppers named, as they move: FILE ends in .gif or .mp4; "
    "left out, results/SCENE.gif, or OUT/SCENE.gif.",
)
@click.option("--slow", type=float, default=1.0, help="So many times slower than it is, for --animate.")
def compare_command(
    scene: str,
    names: tuple[str, ...],
    dt: float | None,
    duration: float | None,
    settings: tuple[str, ...],
    changes: tuple[str, ...],
    as_json: bool,
    out: Path | None,
    animate: str | None,
    slow: float,
) -> None:
    """Run steppers on SCENE (a name or a TOML file) and say how far each is from the true motion, and why."""
    from experiments.divergence import result_of
    from experiments.experiment import write_tables
    from experiments.runs.comparison import compare
    from experiments.runs.steppers import default_steppers, find_steppers

    setup = setup_for(scene, dt, duration, parse_settings(settings), parse_changes(changes))
    steppers = find_steppers(names) if names else default_steppers()
    with ExitStack() as files:
        if animate is not None:
            from reference.changes import whole_steps
            from report.film.film import frame_steps
            from report.film.film_file import check_name, whole_file

            path = (out or RESULTS) / f"{setup.name}.gif" if animate == UNNAMED else Path(animate)
            check_name(path)
            frame_steps(setup, whole_steps(setup.dt, setup.duration), slow)
            part = files.enter_context(whole_file(path))
        with progress("compare") as tell:
            comparison = compare(setup, steppers, tell, patient=bool(names))
        document = json.dumps(comparison.document, indent=2)
        if out is not None:
            written = write_tables(result_of(comparison), out)
            (out / "compare.json").write_text(document + "\n", encoding="utf-8")
            print(*(f"written: {file}" for file in [*written, out / "compare.json"]), sep="\n", file=sys.stderr)
        if as_json:
            click.echo(document)
        else:
            show(comparison)
        if animate is not None:
            draw(comparison, names, slow, part, path)
    if animate is not None:
        print(f"written: {path}", file=sys.stderr)


def show(comparison: Comparison) -> None:
    """A comparison as a table."""
    setup = comparison.setup
    title = f"{setup.name}: dt = {setup.dt:g} s, {setup.duration:g} s"
    columns = ["stepper", "outcome", "error [m]", "identified as", "deviation [m]", "reason"]
    keys = ["stepper", "outcome", "error_m", "identified_as", "identification_error_m", "reason"]
    show_table(title, columns, [[run.row[key] for key in keys] for run in comparison.runs])
    if comparison.why_no_true_motion:
        click.echo(f"No error is known: {comparison.why_no_true_motion}.")


def draw(comparison: Comparison, names: Sequence[str], slow: float, part: Path, path: Path) -> None:
    """A comparison as a film, in `part`, which is to become `path`; who is not in it, and why, on standard error."""
    from report.film.film import RATE, film
    from report.film.film_file import write_film

    made = film(comparison, names, slow)
    with progress("animate") as tell:
        write_film(part, path, made.frames(tell), RATE)
    for run in comparison.runs:
        if run.outcome.trajectory is None and (names or run.stepper.kind == "engine"):
            print(f"not shown: {run.stepper.name}: {run.outcome.ending}, {run.outcome.reason}", file=sys.stderr)
