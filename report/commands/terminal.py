"""What the terminal shows: tables, progress on anything over a second, and errors in one line."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reference.errors import InputError, SolverError
from report.plain import plain

if TYPE_CHECKING:  # these import NumPy, Numba and the engines' adapters: `springlab --help` does without
    from experiments.experiment import Experiment, Result, Table
    from experiments.runs.progress import Progress

#: Where results go unless told otherwise.
RESULTS = Path("results")


@contextmanager
def progress(title: str) -> Iterator[Progress]:
    """A line on standard error with what is being done and for how long; nothing is left of it, nor shown in a file.

    Where what is told begins with "N of M", the bar is as full as that, and the time that is left is guessed from it.
    """
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    left = (TextColumn("left:"), TimeRemainingColumn(elapsed_when_finished=True))
    columns = (BarColumn(20), TextColumn("{task.description}"), TimeElapsedColumn(), *left)
    console = Console(stderr=True)
    with Bar(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task(title, total=None)

        def tell(what: str) -> None:
            count = re.match(r"(\d+) of (\d+)\b", what)
            done, total = map(int, count.groups()) if count else (0, None)
            bar.update(task, description=f"{title}: {what}", completed=done, total=total)

        yield tell


def show_table(title: str, columns: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
    """A table on standard output, numbers to the right."""
    from rich import box
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table as RichTable

    table = RichTable(title=title or None, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for i, column in enumerate(columns):
        cells = [plain(row[i]) for row in rows]
        numbers = any(isinstance(row[i], float) for row in rows)
        # Names stay whole; only sentences are folded.
        table.add_column(
            escape(column), justify="right" if numbers else "left", no_wrap=max(map(len, cells), default=0) < 40
        )
    for row in rows:
        table.add_row(*(escape(plain(value)) for value in row))
    console = Console()
    # A file or a pipe has no width of its own: give it that of a wide terminal.
    console.width = console.width if console.is_terminal else 160
    console.print(table)


def show_result(experiment: Experiment, result: Result) -> None:
    """An experiment's question, findings, first table and failures."""
    from rich.console import Console

    console = Console(highlight=False)
    console.print(f"[bold]{experiment.title}[/bold]\n{experiment.question}\n")
    for finding in result.findings:
        console.print(f"- {finding}", markup=False)
    table: Table = result.tables[0]
    show_table("", table.columns, table.rows)
    for failure in result.failures:
        console.print(f"[yellow]not done:[/yellow] {failure}")


def in_one_line(command: Callable[[], object]) -> int:
    """Run a command; what is wrong with its input is one line on standard error and exit code 2."""
    try:
        command()
    except InputError as error:
        print(f"springlab: {error}", file=sys.stderr)
        return 2
    except SolverError as error:
        print(f"springlab: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"springlab: {error.filename or 'input or output'}: {error.strerror or error}", file=sys.stderr)
        return 2
    return 0
