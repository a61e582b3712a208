"""The command that shows and exports what is in the store: results."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import click

from reference.printable import printable
from report.commands.options import json_option
from report.commands.runner_options import store_option
from report.commands.terminal import json_text, say, show_table
from report.plain import plain

#: Rows of results that are shown in the terminal.
SHOWN = 40

#: Damaged rows that are named.
NAMED = 10


@click.command("results")
@click.argument("filters", nargs=-1, metavar="[COLUMN=VALUE]...")
@store_option
@click.option("--csv", "as_csv", is_flag=True, help="Print CSV.")
@json_option
@click.option("--all", "retired", is_flag=True, help="Also those that were started over.")
@click.option(
    "--salvage",
    "new",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="NEW",
    help="Take over what can be read of a damaged store into a new one, in another folder.",
)
def results_command(
    filters: tuple[str, ...], store: Path, as_csv: bool, as_json: bool, retired: bool, new: Path | None
) -> None:
    """Show or export what is in the store: all of it, or rows with COLUMN=VALUE (stepper=heun outcome=crashed ...)."""
    from experiments.runs.results import parse_filters, rows, write_csv

    if new is not None:
        _salvage(store, new)
        return
    damaged: list[str] = []
    found = rows(store, parse_filters(filters), retired, damaged.append)
    _tell_of(damaged, store)
    if as_json:
        click.echo(json_text(found))
    elif as_csv:
        write_csv(found, sys.stdout)
    else:
        _show(found[-SHOWN:])
        newest = f"; these are the last {SHOWN}: --csv has all, COLUMN=VALUE picks" if len(found) > SHOWN else ""
        click.echo(printable(f"{len(found)} runs in {store}{newest}"))


def _salvage(store: Path, new: Path) -> None:
    """The command that takes over, and what became of it on standard error."""
    from experiments.runs.salvage import lines, salvage

    for line in lines(salvage(store, new), new):
        say(line)


def _tell_of(damaged: Sequence[str], store: Path) -> None:
    """Rows that are left out, the first ones by name, and what to do."""
    for line in damaged[:NAMED]:
        say(f"store {store}: {line}")
    if damaged:
        rest = f"{len(damaged)} rows are damaged and left out; the others are here"
        say(f"store {store}: {rest}, and `springlab results --salvage NEW` takes them over")


def _show(rows: Sequence[Mapping[str, Any]]) -> None:
    """A table of what differs between rows, as wide as the terminal."""
    from report.commands.results_table import for_people, heading

    columns, same, left_out = for_people(rows, shutil.get_terminal_size((160, 24)).columns)
    if rows:
        show_table("", [heading(name) for name in columns], [[row.get(name) for name in columns] for row in rows])
    if same:
        click.echo(printable(f"In every row: {', '.join(f'{name}={plain(value)}' for name, value in same.items())}"))
    if left_out:
        click.echo(printable(f"Left out, as there is no room: {', '.join(left_out)}; --csv has everything."))
