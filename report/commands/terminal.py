"""What the terminal shows: tables, progress on anything over a second, and errors in one line."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reference.errors import InputError, SolverError
from reference.printable import printable
from report.plain import plain

if TYPE_CHECKING:  # these import NumPy, Numba and the engines' adapters: `springlab --help` does without
    from experiments.experiment import Experiment, Result, Table
    from experiments.runs.progress import Progress

#: Where results go unless told otherwise.
RESULTS = Path("results")

#: In a table a text of SENTENCE characters and more may be folded, to FOLDED characters at least; between columns there
#: are GAP.
SENTENCE, FOLDED, GAP = 40, 24, 3


@contextmanager
def progress(title: str) -> Iterator[Progress]:
    """A line on standard error with what is being done and for how long; nothing is left of it, nor shown in a file.

    Where what is told begins with "N of M", the bar is as full as that, and the time that is left is guessed from it.
    """
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    left = (TextColumn("left:"), TimeRemainingColumn())
    columns = (BarColumn(20), TextColumn("{task.description}"), TimeElapsedColumn(), *left)
    console = Console(stderr=True)
    with Bar(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task(title, total=None)

        def tell(what: str) -> None:
            count = re.match(r"(\d+) of (\d+)\b", what)
            done, total = map(int, count.groups()) if count else (0, None)
            bar.update(task, description=f"{title}: {what}", completed=done, total=total)

        yield tell


def json_text(document: Any) -> str:
    """As commands print JSON, and write it to files."""
    return json.dumps(document, indent=2)


def show_table(title: str, columns: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
    """A table on standard output, numbers to the right, and nothing of it left out for want of room.

    Where it is too wide, sentences are notes below it; where that does not do, there are several tables, each with the
    first column.
    """
    from rich.console import Console

    console = Console(highlight=False)
    # A file or a pipe has no width of its own: give it that of a wide terminal.
    console.width = console.width if console.is_terminal else 160
    columns, cells = [*map(printable, columns)], [[plain(value) for value in row] for row in rows]
    notes: list[str] = []
    if len(_parts(columns, cells, console.width, folded=True)) > 1:
        cells, notes = with_notes(cells)
    if title:  # a table's own would be folded at the table's width
        console.print(printable(title), style="italic", markup=False)
    numbers = [any(isinstance(row[i], float) for row in rows) for i in range(len(columns))]
    for part in _parts(columns, cells, console.width, folded=not notes):
        console.print(_table(columns, cells, numbers, _widths(columns, cells, part, console.width)))
    for note in notes:
        console.print(note, markup=False)


def show_lines(lines: Sequence[str]) -> None:
    """Lines on standard output, folded between words where a terminal is narrower: what goes on is set in."""
    from textwrap import fill

    from rich.console import Console

    console = Console()
    for line in map(printable, lines):
        folded = fill(line, console.width, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
        print(folded if console.is_terminal else line)


def with_notes(cells: Sequence[Sequence[str]]) -> tuple[list[list[str]], list[str]]:
    """The cells, sentences replaced by the numbers of notes, and the notes; the same sentence is one note."""
    numbers: dict[str, int] = {}
    short = [
        [text if len(text) < SENTENCE else f"({numbers.setdefault(text, len(numbers) + 1)})" for text in row]
        for row in cells
    ]
    return short, [f"({number}) {text}" for text, number in numbers.items()]


def _parts(columns: Sequence[str], cells: Sequence[Sequence[str]], width: int, folded: bool) -> list[list[int]]:
    """Which columns fit beside one another: as few tables as will do, the first column in each."""
    widths = [_least(column, [row[i] for row in cells], folded) + GAP for i, column in enumerate(columns)]
    parts = [[0]]
    for i in range(1, len(columns)):
        if sum(widths[j] for j in parts[-1]) + widths[i] > width and len(parts[-1]) > 1:
            parts.append([0])
        parts[-1].append(i)
    return parts


def _least(column: str, texts: Sequence[str], folded: bool) -> int:
    """How wide a column is at least: headings are folded between words, names and numbers are not."""
    longest = max(map(len, texts), default=0)
    word = max(map(len, column.split()), default=0)
    return max(word, FOLDED if folded and longest >= SENTENCE else longest)


def _widths(columns: Sequence[str], cells: Sequence[Sequence[str]], part: Sequence[int], width: int) -> dict[int, int]:
    """How wide some of the columns are, each by its number: what is left of the width goes to those that are folded."""
    texts = {i: [row[i] for row in cells] for i in part}
    widths = {i: _least(columns[i], texts[i], folded=True) for i in part}
    wanted = {i: max(map(len, [columns[i], *texts[i]])) for i in part}
    for _ in range(width - sum(widths.values()) - GAP * len(part)):
        folded = [i for i in part if widths[i] < wanted[i]]
        if folded:
            widths[min(folded, key=lambda i: widths[i] / wanted[i])] += 1
    return widths


def _table(
    columns: Sequence[str],
    cells: Sequence[Sequence[str]],
    numbers: Sequence[bool],
    widths: Mapping[int, int],
) -> Any:
    """Some of the columns, each of its width, as Rich draws them."""
    from rich import box
    from rich.markup import escape
    from rich.table import Table as RichTable

    table = RichTable(box=box.SIMPLE_HEAD, pad_edge=False)
    for i, width in widths.items():
        table.add_column(escape(columns[i]), justify="right" if numbers[i] else "left", width=width)
    for row in cells:
        table.add_row(*(escape(row[i]) for i in widths))
    return table


def show_result(experiment: Experiment, result: Result) -> None:
    """An experiment's question, findings, first table and failures."""
    from rich.console import Console
    from rich.markup import escape

    console = Console(highlight=False)
    console.print(f"[bold]{escape(experiment.title)}[/bold]\n{escape(experiment.question)}\n")
    for finding in result.findings:
        console.print(f"- {finding}", markup=False)
    table: Table = result.tables[0]
    show_table("", table.columns, table.rows)
    for failure in result.failures:
        console.print(f"[yellow]not done:[/yellow] {escape(printable(str(failure)))}")


def in_one_line(command: Callable[[], object]) -> int:
    """Run a command; what is wrong with its input is one line on standard error and exit code 2."""
    try:
        command()
    except InputError as error:
        say(f"springlab: {error}")
        return 2
    except SolverError as error:
        say(f"springlab: {error}")
        return 1
    except MemoryError:
        say("springlab: there is not enough memory for that: expected fewer masses, steps or steppers")
        return 2
    except OSError as error:
        what = error.filename or ("input or output" if error.strerror else None)
        say(": ".join(["springlab", *([str(what)] if what else []), error.strerror or str(error)]))
        return 2
    return 0


def exit_if_files_failed(ended: Iterable[tuple[str, str]]) -> None:
    """Exit code 1 where a stepper in a file of the user's raised, died or took too long.

    An engine that does is a result like any other.

    Args:
        ended: of each stepper its kind, and how its run ended.
    """
    if any(kind == "own" and ending in ("crashed", "timed out") for kind, ending in ended):
        sys.exit(1)


def say(line: str) -> None:
    """A line on standard error; what a terminal would obey in it is escaped."""
    print(printable(line), file=sys.stderr)
