"""The command that says what there is: list."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence

import click

from report.commands.options import json_option
from report.commands.terminal import show_table

#: Columns, and a row for each thing: words, or what is in the JSON only.
Listing = tuple[Sequence[str], Sequence[Sequence[object]]]

#: In the terminal a column may have another heading than its key in the JSON, or be left out.
HEADINGS: Mapping[str, str | None] = {"known to be": "claims to be", "settings": None, "precision": None}


@click.command("list")
@json_option
def list_command(as_json: bool) -> None:
    """Scenes with their parameters, schemes, engines with version or why not available, experiments."""
    listings = {"scenes": _scenes(), "schemes": _schemes(), "engines": _engines(), "experiments": _experiments()}
    if as_json:
        document = {
            name: [dict(zip(columns, row, strict=True)) for row in rows] for name, (columns, rows) in listings.items()
        }
        click.echo(json.dumps(document, indent=2))
        return
    for name, (columns, rows) in listings.items():
        headings = [HEADINGS.get(column, column) for column in columns]
        kept = [i for i, heading in enumerate(headings) if heading]
        show_table(name, [str(headings[i]) for i in kept], [[row[i] for i in kept] for row in rows])


def _scenes() -> Listing:
    from reference.scenes import scenes

    rows = [
        [s.name, s.slides, s.summary, ", ".join(f"{key}={value}" for key, value in s.parameters.items())]
        for s in scenes().values()
    ]
    return ["scene", "slides", "what", "parameters"], rows


def _schemes() -> Listing:
    """All steppers that are not engines."""
    from experiments.runs.steppers import all_steppers
    from reference.stepper import SchemeStepper

    rows = []
    for stepper in all_steppers().values():
        if stepper.kind != "engine":
            summary = stepper.scheme.summary if isinstance(stepper, SchemeStepper) else stepper.summary  # type: ignore[attr-defined]
            rows.append([stepper.name, stepper.kind, summary])
    return ["stepper", "kind", "what"], rows


def _engines() -> Listing:
    """Each with its version, the schemes it claims to step by, and what is recorded with its results."""
    from engines.engine import precision, registry, version

    rows = [
        [
            engine.name,
            version(engine) or f"not available: {engine.package} is not installed",
            ", ".join(dict.fromkeys(engine.identified_as.values())),
            engine.semantics,
            dict(engine.settings),
            precision(engine),
        ]
        for engine in registry().values()
    ]
    return ["engine", "version", "known to be", "in SI units", "settings", "precision"], rows


def _experiments() -> Listing:
    from experiments.experiment import experiments

    rows = [[experiment.name, experiment.slides, experiment.question] for experiment in experiments().values()]
    return ["experiment", "slides", "question"], rows
