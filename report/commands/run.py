"""The command that runs experiments one by one: run."""

from __future__ import annotations

from pathlib import Path

import click

from reference.printable import printable
from report.commands.options import out_option
from report.commands.runner_options import chosen_runner, runner_options
from report.commands.terminal import RESULTS, progress, say, show_result


@click.command("run")
@click.argument("names", nargs=-1, required=True, metavar="EXPERIMENT...")
@out_option(RESULTS)
@runner_options
def run_command(
    names: tuple[str, ...], out: Path, resume: bool, store: Path, jobs: int | None, cluster: str | None
) -> int:
    """Run experiments: show what they find, and write figures and tables to OUT/EXPERIMENT.

    Exit code 1 if one of them failed.
    """
    from experiments.experiment import find
    from report.page.sections import section

    failed = False
    for experiment in [find(name) for name in names]:
        with chosen_runner(resume, store, jobs, cluster), progress(experiment.name) as tell:
            answer = section(experiment, out / experiment.name, tell)
        if answer.result is None:
            say(f"springlab: {experiment.name}: {answer.failure}")
            failed = True
            continue
        show_result(experiment, answer.result)
        click.echo(printable(f"written: {out / experiment.name}"))
    return int(failed)
