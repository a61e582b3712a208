"""The command that runs steppers side by side, in numbers and in moving pictures: compare."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

import click

from reference.printable import printable
from report.commands.options import json_option, out_option, patient, setup_options, steppers_option, time_limit_option
from report.commands.terminal import RESULTS, exit_if_files_failed, json_text, progress, say, show_table

if TYPE_CHECKING:
    from experiments.runs.comparison import Comparison
    from reference.scenes import Setup

#: What --animate is without a file name.
UNNAMED = "-"


@click.command("compare")
@setup_options
@steppers_option()
@json_option
@out_option(None, "Also write CSV and JSON files here.")
@click.option(
    "--animate",
    is_flag=False,
    flag_value=UNNAMED,
    metavar="[FILE]",
    help="Also draw the reference and all engines, or the steppers named, as they move: FILE ends in .gif or .mp4; "
    "left out, results/SCENE.gif, or OUT/SCENE.gif.",
)
@click.option(
    "--slow", type=float, default=1.0, show_default=True, help="By which factor --animate is slower than the motion."
)
@time_limit_option
def compare_command(
    setup: Setup,
    names: tuple[str, ...],
    as_json: bool,
    out: Path | None,
    animate: str | None,
    slow: float,
    time_limit: float | None,
) -> None:
    """Run steppers on SCENE (a name or a TOML file) and say how far each is from the true motion, and why."""
    from experiments.runs.comparison import compare
    from experiments.runs.steppers import default_steppers, find_steppers

    found = find_steppers(names) if names else default_steppers()
    steppers = [patient(stepper, time_limit) for stepper in found]
    film = None if animate is None else _film_path(setup, animate, out, slow)
    with _film_file(film) as part:
        with progress("compare") as tell:
            comparison = compare(setup, steppers, tell, patient=bool(names))
        document = json_text(comparison.document)
        if out is not None:
            _write(comparison, document, out)
        if as_json:
            click.echo(document)
        else:
            _show(comparison)
        if film is not None and part is not None:
            _draw(comparison, names, slow, part, film)
    if film is not None:
        say(f"written: {film}")
    exit_if_files_failed((run.stepper.kind, run.outcome.ending) for run in comparison.runs)


def _film_path(setup: Setup, animate: str, out: Path | None, slow: float) -> Path:
    """Where the film goes. Raises InputError where that is no film's name, or it would have too many frames."""
    from reference.changes import whole_steps
    from report.film.film import frame_steps
    from report.film.film_file import check_name

    path = (out or RESULTS) / f"{setup.name}.gif" if animate == UNNAMED else Path(animate)
    check_name(path)
    frame_steps(setup, whole_steps(setup.dt, setup.duration), slow)
    return path


def _film_file(film: Path | None) -> AbstractContextManager[Path | None]:
    """A file that becomes the film's once all has gone well: what cannot be written is said before anything runs."""
    if film is None:
        return nullcontext()
    from report.film.film_file import whole_file

    return whole_file(film)


def _write(comparison: Comparison, document: str, out: Path) -> None:
    """Tables and JSON into a folder; which files, on standard error."""
    from experiments.divergence import result_of
    from experiments.experiment import write_tables

    written = [*write_tables(result_of(comparison), out), out / "compare.json"]
    written[-1].write_text(document + "\n", encoding="utf-8")
    for file in written:
        say(f"written: {file}")


def _show(comparison: Comparison) -> None:
    """A comparison as a table."""
    from report.shown import of_comparison

    shown = of_comparison(comparison)
    show_table(shown.title, shown.columns, shown.rows)
    for note in shown.notes:
        click.echo(printable(note))


def _draw(comparison: Comparison, names: Sequence[str], slow: float, part: Path, path: Path) -> None:
    """A comparison as a film, in `part`, which is to become `path`; what is not in it, and why, on standard error."""
    from report.film.film import RATE, film
    from report.film.film_file import write_film

    made = film(comparison, names, slow)
    with progress("animate") as tell:
        write_film(part, path, made.frames(tell), RATE)
    for run in comparison.runs:
        if run.outcome.trajectory is None and (names or run.stepper.kind == "engine"):
            say(f"not shown: {run.stepper.name}: {run.outcome.ending}, {run.outcome.reason}")
