"""The commands that answer in the terminal: list, compare, identify."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import click

from experiments.arguments import parse_changes, parse_settings, setup_for
from experiments.console import plain, progress, show_table


@click.command("list")
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def show_list(as_json: bool) -> None:
    """Scenes with their parameters, schemes, engines with version or why not available, experiments."""
    from engines.engine import registry, version
    from experiments.experiment import experiments
    from experiments.steppers import all_steppers
    from reference.scenes import scenes
    from reference.stepper import SchemeStepper

    scene_rows = [
        [s.name, s.slides, s.summary, ", ".join(f"{k}={v}" for k, v in s.parameters.items())] for s in scenes().values()
    ]
    stepper_rows = []
    for stepper in all_steppers().values():
        if stepper.kind != "engine":
            summary = stepper.scheme.summary if isinstance(stepper, SchemeStepper) else stepper.summary  # type: ignore[attr-defined]
            stepper_rows.append([stepper.name, stepper.kind, summary])
    engine_rows = [
        [
            e.name,
            version(e) or f"not available: {e.package} is not installed",
            ", ".join(dict.fromkeys(e.identified_as.values())),
            e.semantics,
        ]
        for e in registry().values()
    ]
    experiment_rows = [[e.name, e.slides, e.question] for e in experiments().values()]
    tables = {
        "scenes": (["scene", "slides", "what", "parameters"], scene_rows),
        "schemes": (["stepper", "kind", "what"], stepper_rows),
        "engines": (["engine", "version", "known to be", "in SI units"], engine_rows),
        "experiments": (["experiment", "slides", "question"], experiment_rows),
    }
    if as_json:
        click.echo(
            json.dumps(
                {
                    name: [dict(zip(columns, row, strict=True)) for row in rows]
                    for name, (columns, rows) in tables.items()
                },
                indent=2,
            )
        )
        return
    for name, (columns, rows) in tables.items():
        show_table(name, columns, rows)


def run_options(command: Any) -> Any:
    """The options that say what is run, and for how long."""
    options = [
        click.option("--dt", type=float, help="Step [s]; the scene's own where left out."),
        click.option("--duration", type=float, help="How long [s]."),
        click.option("--set", "settings", multiple=True, metavar="KEY=VALUE", help="Set a parameter of the scene."),
        click.option(
            "--change",
            "changes",
            multiple=True,
            metavar="T:KEY=VALUE",
            help="Change a parameter at a time [s], on the fly.",
        ),
        click.option("--json", "as_json", is_flag=True, help="Print JSON."),
    ]
    for option in reversed(options):
        command = option(command)
    return command


@click.command("compare")
@click.argument("scene", default="string")
@click.option("--stepper", "names", multiple=True, metavar="NAME", help="Only these; see `springlab list`.")
@run_options
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), help="Also write CSV and JSON files here.")
def compare_command(
    scene: str,
    names: tuple[str, ...],
    dt: float | None,
    duration: float | None,
    settings: tuple[str, ...],
    changes: tuple[str, ...],
    as_json: bool,
    out: Path | None,
) -> None:
    """Run steppers on SCENE (a name or a TOML file) and say how far each is from the true motion, and why."""
    from experiments.comparison import compare
    from experiments.divergence import result_of
    from experiments.experiment import write_tables
    from experiments.steppers import default_steppers, find_steppers

    setup = setup_for(scene, dt, duration, parse_settings(settings), parse_changes(changes))
    steppers = find_steppers(names) if names else default_steppers()
    with progress("compare") as tell:
        comparison = compare(setup, steppers, tell, patient=bool(names))
    document = json.dumps(comparison.document, indent=2)
    if out is not None:
        files = write_tables(result_of(comparison), out)
        (out / "compare.json").write_text(document + "\n", encoding="utf-8")
        print(*(f"written: {file}" for file in [*files, out / "compare.json"]), sep="\n", file=sys.stderr)
    if as_json:
        click.echo(document)
        return
    title = f"{setup.name}: dt = {setup.dt:g} s, {setup.duration:g} s"
    columns = ["stepper", "outcome", "error [m]", "identified as", "deviation [m]", "reason"]
    keys = ["stepper", "outcome", "error_m", "identified_as", "identification_error_m", "reason"]
    show_table(title, columns, [[run.row[key] for key in keys] for run in comparison.runs])
    if comparison.why_no_true_motion:
        click.echo(f"No error is known: {comparison.why_no_true_motion}.")


@click.command("identify")
@click.argument("stepper")
@click.argument("scene", default="string")
@run_options
def identify_command(
    stepper: str,
    scene: str,
    dt: float | None,
    duration: float | None,
    settings: tuple[str, ...],
    changes: tuple[str, ...],
    as_json: bool,
) -> None:
    """Say which scheme of the catalogue reproduces STEPPER on SCENE to rounding."""
    from experiments.comparison import finite
    from experiments.steppers import find_steppers
    from reference.changes import whole_steps
    from reference.identify import identify

    (found,) = find_steppers([stepper])
    setup = setup_for(scene, dt, duration, parse_settings(settings), parse_changes(changes))
    with progress("identify") as tell:
        tell(stepper)
        steps = whole_steps(setup.dt, setup.duration)
        identification = identify(found, setup.system, setup.dt, steps, setup.changes)
    ranking = [{"scheme": m.scheme, "error_m": finite(m.error)} for m in identification.ranking]
    if as_json:
        document = {
            "stepper": stepper,
            "identified_as": identification.identified_as,
            "error_m": finite(identification.error),
            "ranking": ranking,
        }
        click.echo(json.dumps(document, indent=2))
        return
    click.echo(str(identification))
    also = [m.scheme for m in identification.matches[1:]]
    if also:
        click.echo(f"On this scene it cannot be told from {', '.join(also)}.")
    show_table("", ["scheme", "deviation [m]"], [[m.scheme, plain(finite(m.error))] for m in identification.ranking])
