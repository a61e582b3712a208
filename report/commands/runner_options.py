"""The options that say who runs and where results are kept, for every command that runs much."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.commands.options import Command
from report.commands.terminal import RESULTS, say

if TYPE_CHECKING:  # this imports NumPy: `springlab --help` does without
    from experiments.runs.runner import Runner

#: The store, unless told otherwise.
STORE = RESULTS / "store.sqlite"

#: No more runs at once: each is a process.
MOST_JOBS = 1024

#: What Ctrl-C ends a command with.
INTERRUPTED = 130


def store_option(command: Command) -> Command:
    """Add --store."""
    file = click.Path(path_type=Path, dir_okay=False)
    text = "Where results are kept."
    add = click.option("--store", type=file, envvar="SPRINGLAB_STORE", default=STORE, show_default=True, help=text)
    return add(command)


def resume_option(command: Command) -> Command:
    """Add --resume/--fresh."""
    text = "Go on from what is in the store (as it does by itself), or start over; nothing is deleted."
    return click.option("--resume/--fresh", default=True, help=text)(command)


def runner_options(command: Command) -> Command:
    """Add --resume/--fresh, --store, --jobs and --cluster."""
    jobs = click.option("--jobs", type=click.IntRange(1, MOST_JOBS), help="Runs at once; as many as there are cores.")
    cluster = click.option("--cluster", metavar="tcp://HOST:PORT", help="Run on the workers of a Dask scheduler.")
    return resume_option(store_option(jobs(cluster(command))))


@contextmanager
def chosen_runner(resume: bool, store: Path, jobs: int | None = None, cluster: str | None = None) -> Iterator[Runner]:
    """The runner that was asked for, at work meanwhile; after Ctrl-C it says how to go on.

    Raises:
        InputError: for a store that cannot be used, or a cluster that cannot be reached.
    """
    from experiments.runs.runner import Executor, LocalExecutor, Runner, using
    from experiments.runs.store import Store

    with closing(Store(store)) as kept:
        executor: Executor
        if cluster is None:
            executor = LocalExecutor(jobs)
        else:
            from experiments.runs.cluster import DaskExecutor

            executor = DaskExecutor(cluster, jobs)
        runner = Runner(executor, kept, fresh=not resume)
        try:
            with using(runner):
                yield runner
        except KeyboardInterrupt:
            again = "the same command" if resume else "the same command without --fresh"
            say(f"springlab: interrupted; what is done is kept in {store}: {again} goes on")
            raise click.exceptions.Exit(INTERRUPTED) from None
        finally:
            executor.stop()
            for remark in kept.remarks:
                say(f"springlab: {remark}")
