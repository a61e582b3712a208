"""The options that say who runs and where results are kept, for every command that runs much."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

from experiments.console import RESULTS

#: The store, unless told otherwise.
STORE = RESULTS / "store.sqlite"

#: What Ctrl-C ends a command with.
INTERRUPTED = 130


def store_option(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add --store."""
    file = click.Path(path_type=Path, dir_okay=False)
    return click.option("--store", type=file, default=STORE, show_default=True, help="Where results are kept.")(command)


def runner_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add --resume/--fresh, --store, --jobs and --cluster."""
    options: list[Callable[[Any], Any]] = [
        click.option(
            "--resume/--fresh",
            default=True,
            help="Go on from what is in the store (as it does by itself), or start over; nothing is deleted.",
        ),
        store_option,
        click.option("--jobs", type=click.IntRange(min=1), help="Runs at once; as many as there are cores."),
        click.option("--cluster", metavar="tcp://HOST:PORT", help="Run on the workers of a Dask scheduler."),
    ]
    for option in reversed(options):
        command = option(command)
    return command


@contextmanager
def chosen_runner(resume: bool, store: Path, jobs: int | None, cluster: str | None) -> Iterator[Any]:
    """The runner that was asked for, at work meanwhile; after Ctrl-C it says how to go on.

    Raises:
        InputError: for a store that cannot be used, or a cluster that cannot be reached.
    """
    from experiments.runner import Crew, LocalCrew, Runner, using
    from experiments.store import Store

    kept = Store(store)
    crew: Crew
    if cluster is None:
        crew = LocalCrew(jobs)
    else:
        from experiments.cluster import DaskCrew

        crew = DaskCrew(cluster, jobs)
    runner = Runner(crew, kept, fresh=not resume)
    try:
        with using(runner):
            yield runner
    except KeyboardInterrupt:
        print(f"springlab: interrupted; what is done is kept in {store}: the same command goes on", file=sys.stderr)
        raise click.exceptions.Exit(INTERRUPTED) from None
    finally:
        crew.stop()
        kept.close()
