"""The command that runs steppers over a grid of parameters: sweep."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import closing
from pathlib import Path
from time import perf_counter

import click

from report.commands.options import (
    dt_option,
    duration_option,
    json_option,
    scene_argument,
    settings_option,
    steppers_option,
)
from report.commands.runner_options import chosen_runner, runner_options
from report.commands.terminal import json_text, progress, show_table


@click.command("sweep")
@scene_argument
@steppers_option("See `springlab list`.", required=True)
@click.option("--over", "axes", multiple=True, required=True, metavar="KEY=LOW:HIGH:COUNT", help="Or KEY=A,B,C.")
@settings_option
@dt_option
@duration_option
@click.option("--identify", is_flag=True, help="Find the scheme of every run: a second each.")
@click.option("--keep", is_flag=True, help="Keep trajectories.")
@click.option("--time-limit", type=float, default=60.0, show_default=True, help="Of a run [s].")
@click.option("--memory-limit", type=float, default=4.0, show_default=True, help="Of a run's process [GiB].")
@json_option
@runner_options
def sweep_command(
    scene: str,
    names: tuple[str, ...],
    axes: tuple[str, ...],
    settings: Mapping[str, str],
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
    from experiments.runs.sweeps import ParameterSweep, count, parse_axes, tally

    steppers, values = find_steppers(names), parse_axes(axes)
    limits = (time_limit, memory_limit * 2**30)
    sweep = ParameterSweep(scene, steppers, values, settings, dt, duration, identify, keep, *limits)
    tallies, begin, done = tally(steppers), perf_counter(), 0
    with chosen_runner(resume, store, jobs, cluster) as runner, progress("sweep") as tell:
        if not resume:
            runner.start_over(sweep.tasks())
        with closing(runner.answers(sweep.tasks())) as answers:
            for task, answer in answers:
                done += 1
                count(tallies, task.labels["stepper"], outcome_of_answer(answer))
                tell(f"{done} of {len(sweep)} runs")
    seconds = perf_counter() - begin
    if as_json:
        endings = {name: dict(found.endings) for name, found in tallies.items()}
        document = {"runs": done, "run_now": runner.done, "seconds": seconds, "outcomes": endings}
        click.echo(json_text(document))
        return
    columns = ["stepper", "runs", "most frequent reason"]
    # a reason is of what crashed, timed out or was refused: often there is none
    known = columns if any(found.reasons for found in tallies.values()) else columns[:2]
    show_table("", known, [found.row[: len(known)] for found in tallies.values()])
    click.echo(f"{done} runs, {runner.done} of them now, in {seconds:.3g} s; `springlab results` shows them")
