"""The commands that make something to look at: run, report."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from experiments.experiment import NAMES, find
from reference.errors import InputError
from report.commands.arguments import setup_for
from report.commands.runner_options import chosen_runner, resume_option, runner_options, store_option
from report.commands.terminal import RESULTS, progress, show_result

if TYPE_CHECKING:
    from experiments.stability import Row
    from reference.stepper import Stepper


@click.command("stability")
@click.argument("scene", default="string")
@click.option("--stepper", "names", multiple=True, metavar="NAME", help="Only these; see `springlab list`.")
@click.option("--set", "settings", multiple=True, metavar="KEY=VALUE", help="Set a parameter of the scene.")
@click.option("--map", "axes", nargs=2, metavar="X Y", help="Map growth over two of dt, masses, damping, stiffness ...")
@click.option("--dt", type=float, help="The step of a map that has no dt axis [s]; the scene's own where left out.")
@click.option("--range", "ranges", multiple=True, metavar="KEY=LOW:HIGH", help="The range of a map's axis.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
@click.option(
    "--out", type=click.Path(path_type=Path, file_okay=False), default=RESULTS / "stability", show_default=True
)
def stability_command(
    scene: str,
    names: tuple[str, ...],
    settings: tuple[str, ...],
    axes: tuple[str, str] | None,
    dt: float | None,
    ranges: tuple[str, ...],
    as_json: bool,
    out: Path,
) -> None:
    """Predict and measure the largest stable dt of steppers on SCENE, about its equilibrium; or map growth.

    Without --set damping or drag, in the cases the report shows: undamped, damping 0.1 and 0.5, drag 0.1 N s/m.
    """
    from experiments.runs.steppers import all_steppers, find_steppers
    from report.commands.arguments import parse_settings

    given = parse_settings(settings)
    steppers = find_steppers(names) if names else [s for s in all_steppers().values() if s.kind != "lecture"]
    if axes:
        _map(scene, given, dt, axes, ranges, steppers if names else find_steppers(["heun"]), out)
        return
    rows = _rows(scene, given, steppers if names else [s for s in steppers if s.kind != "pendulum"])
    _write_stability(rows, as_json, out)


def _rows(scene: str, settings: Mapping[str, str], steppers: Sequence[Stepper]) -> list[Row]:
    from experiments.stability import CASES, stability_rows

    named = not Path(scene).suffix and not {"damping", "drag"} & settings.keys()
    cases = [{key: str(value) for key, value in case.items()} for case in CASES] if named else [{}]
    rows = []
    with progress("stability") as tell:
        for case in cases:
            rows += stability_rows(setup_for(scene, settings={**settings, **case}).system, steppers, tell)
    return rows


def _write_stability(rows: Sequence[Row], as_json: bool, out: Path) -> None:
    from experiments.experiment import write_tables
    from experiments.stability import EXPERIMENT, result_of
    from report.figures import draw

    result = result_of(rows)
    written = write_tables(result, out)
    (out / "stability.svg").write_text(draw("stability", result).svg(), encoding="utf-8")
    if as_json:
        click.echo(json.dumps([row.document for row in rows], indent=2))
        return
    show_result(EXPERIMENT, result)
    click.echo(f"written: {', '.join(map(str, [*written, out / 'stability.svg']))}")


def _map(
    scene: str,
    settings: Mapping[str, str],
    dt: float | None,
    names: tuple[str, str],
    ranges: Sequence[str],
    steppers: Sequence[Stepper],
    out: Path,
) -> None:
    from experiments.stability_map import stability_map, write_map
    from report.commands.map_arguments import axes_for, system_maker
    from report.figures.stability_map import draw_map

    system_at, step = system_maker(scene, settings, dt)
    x, y = axes_for(names, ranges, system_at({}))
    out.mkdir(parents=True, exist_ok=True)
    for stepper in steppers:
        with progress(f"map of {stepper.name}") as tell:
            found = stability_map(stepper, system_at, step, x, y, tell)
        name = f"{stepper.name}-{x.name}-{y.name}"
        (out / f"{name}.svg").write_text(draw_map(found).svg(), encoding="utf-8")
        write_map(found, out / f"{name}.csv")
        click.echo(f"written: {out / name}.svg, {out / name}.csv")


@click.command("run")
@click.argument("names", nargs=-1, required=True, metavar="EXPERIMENT...")
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), default=RESULTS, show_default=True)
@runner_options
def run_command(
    names: tuple[str, ...], out: Path, resume: bool, store: Path, jobs: int | None, cluster: str | None
) -> int:
    """Run experiments: show what they find, and write figures and tables to OUT/EXPERIMENT."""
    from report.page.sections import section

    failed = False
    for experiment in [find(name) for name in names]:
        with chosen_runner(resume, store, jobs, cluster), progress(experiment.name) as tell:
            answer = section(experiment, out / experiment.name, tell)
        if answer.result is None:
            print(f"springlab: {experiment.name}: {answer.failure}", file=sys.stderr)
            failed = True
            continue
        show_result(experiment, answer.result)
        click.echo(f"written: {out / experiment.name}")
    return int(failed)


@click.command("report")
@click.argument("scene", required=False)
@click.option("--only", "names", multiple=True, metavar="EXPERIMENT", help="Only these experiments.")
@click.option("--full", is_flag=True, help="All experiments, also those that take long, and finer maps.")
@click.option("--open", "show", is_flag=True, help="Open the page in the browser.")
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), default=RESULTS / "report", show_default=True)
@resume_option
@store_option
def report_command(
    scene: str | None, names: Sequence[str], full: bool, show: bool, out: Path, resume: bool, store: Path
) -> int:
    """Run the experiments and write one self-contained page, OUT/index.html. Exit code 1 if an experiment failed.

    With SCENE (a name or a TOML file) the page is about that scene: which dt to use in which engine.
    """
    from report.page.page import page, scene_page
    from report.page.sections import all_sections, scene_sections

    if scene is not None:
        if names or full:
            raise InputError("--only and --full are of experiments: expected no SCENE with them")
        setup = setup_for(scene)
    wanted = [find(name) for name in dict.fromkeys(names or NAMES)]
    if not names and not full:
        wanted = [experiment for experiment in wanted if experiment.in_report]
    out.mkdir(parents=True, exist_ok=True)
    with chosen_runner(resume, store), progress("report") as tell:
        if scene is not None:
            sections = scene_sections(setup, f"springlab report {scene}", out, tell)
            html = scene_page(setup.name, sections)
        else:
            sections = all_sections(wanted, out, tell, store, fresh=not resume, full=full)
            html = page(sections)
    written = out / "index.html"
    written.write_text(html, encoding="utf-8")
    for answer in sections:
        said = [answer.failure] if answer.result is None else answer.result.findings
        told = "\n".join(said) if answer.experiment.name == "advice" else said[0]
        click.echo(f"{answer.experiment.title}: {told}\n")
    click.echo(f"written: {written}")
    if show:
        click.launch(str(written))
    return int(any(answer.result is None for answer in sections))
