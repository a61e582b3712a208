"""The commands that answer in the terminal: list, identify."""

from __future__ import annotations

import json
from typing import Any

import click

from report.commands.arguments import parse_changes, parse_settings, setup_for
from report.commands.terminal import plain, progress, show_table


@click.command("list")
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def show_list(as_json: bool) -> None:
    """Scenes with their parameters, schemes, engines with version or why not available, experiments."""
    from engines.engine import registry, version
    from experiments.experiment import experiments
    from experiments.runs.steppers import all_steppers
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
            help="Change a parameter at a time [s], on the fly; one number, or one for each, as 1,-9.81.",
        ),
        click.option("--json", "as_json", is_flag=True, help="Print JSON."),
    ]
    for option in reversed(options):
        command = option(command)
    return command


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
    from experiments.runs.comparison import finite
    from experiments.runs.steppers import find_steppers
    from reference.changes import whole_steps
    from reference.identification import identify

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
