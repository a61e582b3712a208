"""The command that says how a scene swings about its rest, and what its springs carry there: modes."""

from __future__ import annotations

import sys
from math import isnan
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from report.commands.options import json_option, out_option, setup_options, steppers_option
from report.commands.terminal import json_text, progress, show_lines, show_table

if TYPE_CHECKING:
    from experiments.simulation.modes_of_scene import Modes, StepperSwing, Swing
    from reference.scenes import Setup

#: So many modes and springs are shown in the terminal; JSON has all that are computed.
SHOWN = 20

#: How long a mode's film is [s], and how many frames it has in a swing.
FILM_MODES, FILM_FRAMES = 4, 25


@click.command("modes")
@setup_options
@steppers_option("Also what this stepper makes of each mode at the scene's dt; any number of times.")
@json_option
@click.option("--lowest", type=click.IntRange(min=1), help="Only so many modes, the slowest.")
@out_option(None, "Also draw the modes here (SVG), and write a table (CSV).")
@click.option("--animate", is_flag=True, help="Also a film of the slowest modes into OUT.")
def modes_command(
    setup: Setup, names: tuple[str, ...], as_json: bool, lowest: int | None, out: Path | None, animate: bool
) -> None:
    """Frequencies, damping ratios and shapes of the modes of SCENE about its rest, and what its springs carry there."""
    from experiments.runs.steppers import find_steppers
    from experiments.simulation.modes_of_scene import modes_of, swings

    if animate and out is None:
        raise click.UsageError("--animate: expected --out FOLDER with it")
    steppers = find_steppers(names) if names else []
    with progress("modes") as tell:
        found = modes_of(setup, lowest)
        made = swings(found, steppers, tell)
    if as_json:
        document = found.document
        if steppers:
            document["steppers"] = [_document(swing) for swing in made]
        click.echo(json_text(document))
    else:
        _show(found, made)
    if out is not None:
        _write(found, out, animate)


def _document(swing: StepperSwing) -> dict[str, Any]:
    both = {"predicted": swing.predicted, "measured": swing.measured}
    told = {name: each.document if each is not None else None for name, each in both.items()}
    named = {"stepper": swing.stepper, "identified_as": swing.identified_as, "mode": swing.mode}
    return {**named, **told, "reason": swing.reason}


def _show(modes: Modes, made: list[StepperSwing]) -> None:
    from report.shown import of_bends, of_modes, of_springs_at_rest

    shown, springs = of_modes(modes), of_springs_at_rest(modes)
    show_table(shown.title, shown.columns, shown.rows[:SHOWN])
    if len(shown.rows) > SHOWN or len(shown.rows) < modes.asked:
        click.echo(f"{min(SHOWN, len(shown.rows))} of {modes.asked} modes are shown; --json has {len(shown.rows)}.")
    for note in shown.notes:
        click.echo(note)
    show_table(springs.title, springs.columns, springs.rows[:SHOWN])
    if len(springs.rows) > SHOWN:
        click.echo(f"{SHOWN} of {len(springs.rows)} springs are shown; --json has all.")
    if len(modes.bends):
        bent = of_bends(modes.setup.system, modes.bends, modes.torques, "at rest")
        show_table(bent.title, bent.columns, bent.rows[:SHOWN])
        if len(bent.rows) > SHOWN:
            click.echo(f"{SHOWN} of {len(bent.rows)} angular springs are shown; --json has all.")
    if made:
        _show_swings(modes, made)


def _show_swings(modes: Modes, made: list[StepperSwing]) -> None:
    """Period and damping of each mode under each stepper."""
    columns = ["stepper", "mode", "natural [Hz]", "predicted [Hz]", "measured [Hz]"]
    columns += ["predicted damping ratio", "measured damping ratio", "reason"]
    rows = [
        [
            swing.stepper,
            str(swing.mode + 1),
            float(modes.natural.frequencies[swing.mode]),
            *_pair(swing.predicted, swing.measured, "frequency"),
            *_pair(swing.predicted, swing.measured, "damping_ratio"),
            swing.reason,
        ]
        for swing in made
        if swing.mode < SHOWN
    ]
    show_table(f"What steppers make of the modes at dt = {modes.setup.dt:g} s", columns, rows)
    named = {swing.stepper: swing.identified_as for swing in made if swing.identified_as and swing.predicted}
    show_lines([f"{name} is predicted as {scheme}, as which it is identified here." for name, scheme in named.items()])


def _pair(predicted: Swing | None, measured: Swing | None, what: str) -> list[float | None]:
    return [None if swing is None else _known(getattr(swing, what)) for swing in (predicted, measured)]


def _known(value: float) -> float | None:
    return None if isnan(value) else float(value)


def _write(modes: Modes, out: Path, animate: bool) -> None:
    """Pictures and a table; which, on standard error."""
    import csv

    from report.figures.modes import draw

    out.mkdir(parents=True, exist_ok=True)
    written = [out / f"{modes.setup.name}-modes.svg", out / f"{modes.setup.name}-modes.csv"]
    written[0].write_text(draw(modes).svg(), encoding="utf-8")
    with written[1].open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["mode", "frequency [Hz]", "damping ratio"])
        pairs = zip(modes.natural.frequencies.tolist(), modes.natural.damping_ratios.tolist(), strict=True)
        writer.writerows((i + 1, f, ratio) for i, (f, ratio) in enumerate(pairs))
    if animate:
        written.append(out / f"{modes.setup.name}-modes.gif")
        _animate(modes, written[-1])
    print(*(f"written: {file}" for file in written), sep="\n", file=sys.stderr)


def _animate(modes: Modes, path: Path) -> None:
    """The slowest modes side by side, each through one swing of its own."""
    from report.figures.modes import swinging
    from report.film.film_file import whole_file, write_film

    made = swinging(modes, FILM_MODES, FILM_FRAMES)
    with whole_file(path) as part, progress("animate") as tell:
        write_film(part, path, made.frames(tell), FILM_FRAMES)
