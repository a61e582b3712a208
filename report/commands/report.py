"""The command that writes the report, of experiments or of a user's own scene: report."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from reference.errors import InputError
from reference.printable import printable
from report.commands.options import out_option
from report.commands.runner_options import chosen_runner, resume_option, store_option
from report.commands.terminal import RESULTS, progress

if TYPE_CHECKING:
    from experiments.experiment import Experiment
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
    if scene is not None:
        html, sections = _scene_page(scene, out, resume, store)
    else:
        html, sections = _page(_wanted(names, full), full, out, resume, store)
    written = out / "index.html"
    written.write_text(html, encoding="utf-8")
    for section in sections:
        click.echo(f"{section.experiment.title}: {_told(section)}\n")
    click.echo(printable(f"written: {written}"))
    if show:
        click.launch(str(written))
    return int(any(section.result is None for section in sections))


def _wanted(names: Sequence[str], full: bool) -> list[Experiment]:
    """The experiments of these names; without names those that belong in the report, in full all."""
    from experiments.experiment import NAMES, find

    wanted = [find(name) for name in dict.fromkeys(names or NAMES)]
    return wanted if names or full else [experiment for experiment in wanted if experiment.in_report]


def _page(
    wanted: Sequence[Experiment], full: bool, out: Path, resume: bool, store: Path
) -> tuple[str, Sequence[Section]]:
    """The page of experiments, and its sections."""
    from report.page.page import page
    from report.page.sections import all_sections

    out.mkdir(parents=True, exist_ok=True)
    with chosen_runner(resume, store), progress("report") as tell:
        sections = all_sections(wanted, out, tell, store, fresh=not resume, full=full)
        return page(sections), sections


def _scene_page(scene: str, out: Path, resume: bool, store: Path) -> tuple[str, Sequence[Section]]:
    """The page of a user's own scene, and its sections."""
    from reference.files.setup import setup_for
    from report.page.page import scene_page
    from report.page.sections import scene_sections

    setup = setup_for(scene)
    out.mkdir(parents=True, exist_ok=True)
    with chosen_runner(resume, store), progress("report") as tell:
        sections = scene_sections(setup, f"springlab report {scene}", out, tell)
        return scene_page(setup.name, sections), sections


def _told(section: Section) -> str:
    """What the terminal shows of a section: its failure, or its first finding; of advice all of them."""
    if section.result is None:
        return section.failure
    findings = section.result.findings
    return "\n".join(findings) if section.experiment.name == "advice" else findings[0]
