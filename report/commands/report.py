"""The command that writes the report, of experiments or of a user's own scene: report."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from reference.errors import InputError
from reference.printable import printable
from report.commands.options import out_option
from report.commands.runner_options import chosen_runner, resume_option, store_option
from report.commands.terminal import RESULTS, progress

if TYPE_CHECKING:
    from report.page.section import Section


@click.command("report")
@click.argument("scene", required=False)
@click.option("--only", "names", multiple=True, metavar="EXPERIMENT", help="Only these experiments.")
@click.option("--full", is_flag=True, help="All experiments, also those that take long, and finer maps.")
@click.option("--open", "show", is_flag=True, help="Open the page in the browser.")
@out_option(RESULTS / "report")
@resume_option
@store_option
def report_command(
    scene: str | None, names: tuple[str, ...], full: bool, show: bool, out: Path, resume: bool, store: Path
) -> int:
    """Run the experiments and write one self-contained page, OUT/index.html. Exit code 1 if an experiment failed.

    With SCENE (a name or a TOML file) the page is about that scene: which dt to use in which engine.
    """
    if scene is not None and (names or full):
        raise InputError("--only and --full are of experiments: expected no SCENE with them")
    if scene is None and not store.exists():  # nothing is kept: processes will be needed
        from report.page.processes import prepare_processes

        prepare_processes(at_once=True)
    from report.page.written import write_page, write_scene_page

    with chosen_runner(resume, store), progress("report") as tell:
        if scene is not None:
            written = write_scene_page(scene, out, tell)
        else:
            written = write_page(names, out, store, tell, fresh=not resume, full=full)
    for section in written.sections:
        click.echo(f"{section.experiment.title}: {_told(section)}\n")
    click.echo(printable(f"written: {written.file}"))
    if show:
        click.launch(str(written.file))
    return int(any(section.result is None for section in written.sections))


def _told(section: Section) -> str:
    """What the terminal shows of a section: its failure, or its first finding; of advice all of them."""
    if section.result is None:
        return section.failure
    findings = section.result.findings
    return "\n".join(findings) if section.experiment.name == "advice" else findings[0]
