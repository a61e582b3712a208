"""The commands for many runs: sweep, results."""

from __future__ import annotations

import json
import shutil
import sys
from contextlib import closing
from pathlib import Path
from time import perf_counter

import click

from report.commands.runner_options import chosen_runner, runner_options, store_option
from report.commands.terminal import plain, progress, show_table

#: Rows of results that are shown in the terminal.
SHOWN = 40


@click.command("sweep")
@click.argument("scene", default="string")
@click.option("--stepper", "names", multiple=True, required=True, metavar="NAME", help="See `springlab list`.")
@click.option("--over", "axes", multiple=True, required=True, metavar="KEY=LOW:HIGH:COUNT", help="Or KEY=A,B,C.")
@click.option("--set", "settings", multiple=True, metavar="KEY=VALUE", help="Set a parameter of the scene.")
@click.option("--dt", type=float, help="Step [s], where it is not varied; the scene's own where left out.")
@click.option("--duration", type=float, help="How long [s].")
@click.option("--identify", is_flag=True, help="Find the scheme of every run: a second each.")
@click.option("--keep", is_flag=True, help="Keep trajectories.")
@click.option("--time-limit", type=float, default=60.0, show_default=True, help="Of a run [s].")
@click.option("--memory-limit", type=float, default=4.0, show_default=True, help="Of a run's process [GiB].")
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
@runner_options
def sweep_command(
    scene: str,
    names: tuple[str, ...],
    axes: tuple[str, ...],
    settings: tuple[str, ...],
    dt: float | None,
    duration: float | None,
    identify: bool,
    keep: bool,
    time_limit: float,
    memory_limit: float,
    as_json: bool,
    resume: bool,
    store: Path,
    jobs: int | None,
    cluster: str | None,
) -> None:
    """Run steppers on SCENE over a grid of its parameters (and dt), every run in the store as soon as it is done.

    --over KEY=LOW:HIGH:COUNT spaces values evenly; KEY=LOW:HIGH:COUNT:log by equal factors.
    """
    from experiments.runs.steppers import find_steppers
    from experiments.runs.store import outcome_of_answer
    from experiments.runs.sweeps import Sweep, count, parse_axes, tally
    from report.commands.arguments import parse_settings

    steppers, values = find_steppers(names), parse_axes(axes)
    limits = (time_limit, memory_limit * 2**30)
    sweep = Sweep(scene, steppers, values, parse_settings(settings), dt, duration, identify, keep, *limits)
    tallies, begin, done = tally(steppers), perf_counter(), 0
    with chosen_runner(resume, store, jobs, cluster) as runner, progress("sweep") as tell:
        if not resume:
            runner.start_over(sweep.jobs())
        with closing(runner.answers(sweep.jobs())) as answers:
            for job, answer in answers:
                done += 1
                count(tallies, job.labels["stepper"], outcome_of_answer(answer))
                tell(f"{done} of {len(sweep)} runs")
    seconds = perf_counter() - begin
    if as_json:
        endings = {name: dict(found.endings) for name, found in tallies.items()}
        click.echo(
            json.dumps({"runs": done, "run_now": runner.done, "seconds": seconds, "outcomes": endings}, indent=2)
        )
        return
    show_table("", ["stepper", "runs", "most frequent reason"], [found.row for found in tallies.values()])
    click.echo(f"{done} runs, {runner.done} of them now, in {seconds:.3g} s; `springlab results` shows them")


@click.command("results")
@click.argument("filters", nargs=-1, metavar="[COLUMN=VALUE]...")
@store_option
@click.option("--csv", "as_csv", is_flag=True, help="Print CSV.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
@click.option("--all", "retired", is_flag=True, help="Also those that were started over.")
def results_command(filters: tuple[str, ...], store: Path, as_csv: bool, as_json: bool, retired: bool) -> None:
    """Show or export what is in the store: all of it, or rows with COLUMN=VALUE (stepper=heun outcome=crashed ...)."""
    from experiments.runs.results import parse_filters, rows, write_csv
    from report.commands.results_table import for_people, heading

    found = rows(store, parse_filters(filters), retired)
    if as_json:
        click.echo(json.dumps(found, indent=2))
        return
    if as_csv:
        write_csv(found, sys.stdout)
        return
    shown = found[-SHOWN:]
    columns, same, left_out = for_people(shown, shutil.get_terminal_size((160, 24)).columns)
    if found:
        show_table("", [heading(name) for name in columns], [[row.get(name) for name in columns] for row in shown])
    if same:
        click.echo(f"In every row: {', '.join(f'{name}={plain(value)}' for name, value in same.items())}")
    if left_out:
        click.echo(f"Left out, as there is no room: {', '.join(left_out)}; --csv has everything.")
    newest = f"; these are the last {SHOWN}: --csv has all, COLUMN=VALUE picks" if len(found) > SHOWN else ""
    click.echo(f"{len(found)} runs in {store}{newest}")
