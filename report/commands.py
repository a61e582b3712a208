"""The commands that make something to look at: run, report."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import click

from experiments.console import RESULTS, progress, show_result
from experiments.experiment import NAMES, find


@click.command("run")
@click.argument("names", nargs=-1, required=True, metavar="EXPERIMENT...")
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), default=RESULTS, show_default=True)
def run_command(names: tuple[str, ...], out: Path) -> int:
    """Run experiments: show what they find, and write figures and tables to OUT/EXPERIMENT."""
    from report.page import section

    failed = False
    for experiment in [find(name) for name in names]:
        with progress(experiment.name) as tell:
            answer = section(experiment, out / experiment.name, tell)
        if answer.result is None:
            print(f"springlab: {experiment.name}: {answer.failure}", file=sys.stderr)
            failed = True
            continue
        show_result(experiment, answer.result)
        click.echo(f"written: {out / experiment.name}")
    return int(failed)


@click.command("report")
@click.option("--only", "names", multiple=True, metavar="EXPERIMENT", help="Only these experiments.")
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), default=RESULTS / "report", show_default=True)
def report_command(names: Sequence[str], out: Path) -> int:
    """Run the experiments and write one self-contained page, OUT/index.html. Exit code 1 if an experiment failed."""
    from report.page import page, section

    wanted = [find(name) for name in names or NAMES]
    out.mkdir(parents=True, exist_ok=True)
    sections = []
    with progress("report") as tell:
        for experiment in wanted:
            tell(experiment.name)
            sections.append(section(experiment, out / experiment.name, tell))
    (out / "index.html").write_text(page(sections), encoding="utf-8")
    for answer in sections:
        first = answer.failure if answer.result is None else answer.result.findings[0]
        click.echo(f"{answer.experiment.title}: {first}\n")
    click.echo(f"written: {out / 'index.html'}")
    return int(any(answer.result is None for answer in sections))
