"""The command that runs steppers and shows what the scene did: simulate."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from report.commands.options import (
    json_option,
    out_option,
    patient,
    setup_options,
    steppers_option,
    time_limit_option,
)
from report.commands.terminal import RESULTS, exit_if_files_failed, json_text, progress, show_table

if TYPE_CHECKING:
    from experiments.simulation.simulation import Run, Simulation
    from reference.scenes import Setup
    from reference.stepper import Stepper
    from reference.system import MassSpringSystem

#: The stepper where none is named: the lecture's.
DEFAULT = "heun"

#: A run that takes more memory than that [bytes] is told before, and so are tables of more rows.
TOLD_FROM, MANY_ROWS = 2**28, 2_000_000


@click.command("simulate")
@setup_options
@steppers_option(f"Who steps; any number of times. {DEFAULT} where left out; see `springlab list`.")
@json_option
@out_option(None, "Also write files here: CSV, NPZ, ParaView's PVD, JSON.")
@click.option(
    "--plot",
    "plots",
    multiple=True,
    metavar="WHAT",
    help="Draw paths, energy, forces, or a mass's coordinate, as 10:y; any number of times; into OUT, or results.",
)
@click.option(
    "--every", type=click.IntRange(min=1), default=1, show_default=True, help="Only every so many steps in files."
)
@click.option("--animate", is_flag=True, help="Also a film of each, NAME.gif.")
@time_limit_option
def simulate_command(
    setup: Setup,
    names: tuple[str, ...],
    as_json: bool,
    out: Path | None,
    plots: tuple[str, ...],
    every: int,
    animate: bool,
    time_limit: float | None,
) -> None:
    """Run steppers on SCENE (a name or a TOML file), and show what it did: where, how far, with which forces."""
    from experiments.runs.steppers import find_steppers
    from experiments.simulation.simulation import simulate_all
    from report.figures.simulation import wanted

    system = setup.system
    asked = [wanted(word, len(system.masses), system.dimension) for word in plots]
    steppers = [patient(stepper, time_limit) for stepper in find_steppers(dict.fromkeys(names or (DEFAULT,)))]
    _tell_room(setup, steppers)
    with progress("simulate") as tell:
        simulation = simulate_all(setup, steppers, tell)
        if out is not None:
            _write(simulation, out, every, tell)
    if as_json:
        click.echo(json_text(simulation.document))
    else:
        _show(simulation)
    folder = out or RESULTS / "simulate"
    for what in asked:
        _plot(simulation, what, folder / f"{setup.name}-{what.name}.svg")
    if animate:
        _animate(simulation, folder)
    exit_if_files_failed((run.stepper.kind, run.outcome.ending) for run in simulation.runs)


def _tell_room(setup: Setup, steppers: Sequence[Stepper]) -> None:
    """Say on standard error how much memory it will take, where that is much."""
    from experiments.runs.room import room_of

    room = room_of(steppers, setup.system, setup.steps)
    if room > TOLD_FROM:
        masses, steps = len(setup.system.masses), setup.steps
        print(f"springlab: {masses:,} masses, {steps:,} steps: {room / 2**30:.2g} GiB of memory", file=sys.stderr)


def _show(simulation: Simulation) -> None:
    """A summary of each run, and with few masses where they are at the end."""
    from report.shown import of_simulation

    shown = of_simulation(simulation)
    show_table(shown.title, shown.columns, shown.rows)
    for note in shown.notes:
        click.echo(note)
    for run in simulation.runs:
        _show_end(run, simulation.setup.system)


#: So many masses are listed at the end of a run.
FEW = 30


def _show_end(run: Run, system: MassSpringSystem) -> None:
    from report.shown import of_bends

    if run.motion is None or len(run.motion.end.positions) > FEW:
        return
    end = run.motion.end
    axes = "xyz"[: end.positions.shape[1]]
    columns = ["mass", *(f"{axis} [m]" for axis in axes), *(f"v{axis} [m/s]" for axis in axes)]
    rows = [
        [str(i), *x, *v] for i, (x, v) in enumerate(zip(end.positions.tolist(), end.velocities.tolist(), strict=True))
    ]
    show_table(f"{run.stepper.name}, t = {end.time:.6g} s", columns, rows)
    if len(run.motion.bends):
        bent = of_bends(system, run.motion.bends, run.motion.torques, f"under {run.stepper.name} then")
        show_table(bent.title, bent.columns, bent.rows)


def _write(simulation: Simulation, out: Path, every: int, tell: Any) -> None:
    """All files of all runs; which, on standard error."""
    from experiments.simulation import files

    out.mkdir(parents=True, exist_ok=True)
    written = [out / "simulate.json"]
    written[0].write_text(json_text(simulation.document) + "\n", encoding="utf-8")
    for run in simulation.runs:
        if run.motion is None:
            continue
        frames = files.frames_of(run.motion, every)
        rows = files.rows_of(simulation.setup.system, frames)
        if rows > MANY_ROWS:
            print(f"springlab: {rows:,} rows for {run.stepper.name}; --every N makes fewer", file=sys.stderr)
        writers = {
            "masses.csv": files.write_masses,
            "springs.csv": files.write_springs,
            "arrays.npz": files.write_arrays,
            "frames.pvd": files.write_time_series,
        }
        for ending, write in writers.items():
            written.append(out / f"{run.stepper.name}-{ending}")
            tell(f"writing {written[-1].name}")
            write(written[-1], simulation.setup, run.motion, frames)
    print(*(f"written: {file}" for file in written), sep="\n", file=sys.stderr)


def _plot(simulation: Simulation, what: Any, file: Path) -> None:
    from report.figures.simulation import draw

    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(draw(simulation, what).svg(), encoding="utf-8")
    print(f"written: {file}", file=sys.stderr)


def _animate(simulation: Simulation, folder: Path) -> None:
    from report.film.contact_sheet import Shot
    from report.film.film import RATE, film_of
    from report.film.film_file import whole_file, write_film

    shown = [Shot((run.stepper.name,), "", run.outcome) for run in simulation.runs if run.motion is not None]
    path = folder / f"{simulation.setup.name}.gif"
    made = film_of(simulation.setup, shown, None)
    with whole_file(path) as part, progress("animate") as tell:
        write_film(part, path, made.frames(tell), RATE)
    print(f"written: {path}", file=sys.stderr)
