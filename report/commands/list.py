"""The command that says what there is: list."""

from __future__ import annotations

from collections.abc import Mapping

import click

from report.commands.options import json_option
from report.commands.terminal import json_text, show_table

#: In the terminal a column may have another heading than its key in the JSON, or be left out.
HEADINGS: Mapping[str, str | None] = {"known to be": "claims to be", "settings": None, "precision": None}


@click.command("list")
@json_option
def list_command(as_json: bool) -> None:
    """Scenes with their parameters, schemes, engines with version or why not available, experiments."""
    from report.listings import besides_rows, engine_rows, experiment_rows, scene_rows, stepper_rows

    listings = [scene_rows(), besides_rows(), stepper_rows(), engine_rows(), experiment_rows()]
    if as_json:
        document = {
            shown.title: [dict(zip(shown.columns, row, strict=True)) for row in shown.rows] for shown in listings
        }
        click.echo(json_text(document))
        return
    for shown in listings:
        headings = [HEADINGS.get(column, column) for column in shown.columns]
        kept = [i for i, heading in enumerate(headings) if heading]
        show_table(shown.title, [str(headings[i]) for i in kept], [[row[i] for i in kept] for row in shown.rows])
