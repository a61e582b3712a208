"""The report's sections: every experiment run and drawn, each in a process of its own."""

from __future__ import annotations

import base64
import os
from collections.abc import Callable, Sequence
from concurrent.futures import as_completed
from contextlib import closing
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import perf_counter

from engines.process.isolation import isolated
from experiments.advice.own_scene import experiments_of
from experiments.experiment import Experiment, find, write_tables
from experiments.runs.progress import Progress
from experiments.runs.runner import LocalExecutor, Runner, current, using
from experiments.runs.store import Store, StoreError
from reference.scenes import Setup
from report.figures import animate, draw
from report.page.processes import prepare_processes
from report.page.section import Section
from report.page.section_cache import cache_section, cached_section

#: These take longest, and begin first, in this order: no core is to wait for the last of them.
LONGEST = ("scenes", "stability", "maps", "drape", "energy", "order", "numbering")

#: How long an experiment may take [s], and how much memory its process [bytes].
TIME_LIMIT, MEMORY_LIMIT = 900.0, 16 * 2**30


def section(experiment: Experiment, folder: Path, progress: Progress) -> Section:
    """Run an experiment and draw it, leaving its figure and tables in a folder. Its failure is its section's only.

    Raises:
        OSError, StoreError: where its results cannot be kept: that is everybody's failure.
    """
    try:
        result = experiment.run(progress)
        picture = draw(experiment.name, result)
        files = write_tables(result, folder)
        svg, motions = picture.svg(), animate(experiment.name, result)
        (folder / f"{experiment.name}.svg").write_text(svg, encoding="utf-8")
    except (OSError, StoreError):
        raise
    except Exception as error:
        return Section(experiment, failure=f"{type(error).__name__}: {error}")
    downloads = [(file.name, embedded(file)) for file in files]
    return Section(experiment, result, svg, picture.alt, downloads, motions=motions)


def all_sections(
    experiments: Sequence[Experiment],
    folder: Path,
    progress: Progress,
    store: Path,
    fresh: bool = False,
    full: bool = False,
) -> list[Section]:
    """A section for every experiment, in their order, each with a folder of its own.

    What is kept of before, with nothing changed since, is shown again. The others run in parallel, each in a process of
    its own; those that measure times run alone, at the end.

    Args:
        folder: where figures and tables go.
        store: the file where results are kept.
        fresh: whether to run again what has been kept.
        full: whether those that can are to be run in full.
    """
    done = {} if fresh else _cached(experiments, full, folder)
    progress(f"{len(done)} of {len(experiments)} done")
    missing = [experiment for experiment in experiments if experiment.name not in done]
    parallel = [experiment for experiment in missing if not experiment.timed]
    parallel.sort(key=lambda experiment: LONGEST.index(experiment.name) if experiment.name in LONGEST else len(LONGEST))
    alone = [experiment for experiment in missing if experiment.timed]
    make = partial(_isolated_section, folder=folder, store=store, fresh=fresh, full=full)

    prepare_processes()

    def when_made(made: Section, seconds: float) -> None:
        cache = current().store
        done[made.experiment.name] = made if cache is None else cache_section(made, full, cache, seconds)
        left = [experiment.name for experiment in missing if experiment.name not in done]
        progress(f"{len(done)} of {len(experiments)} done; next: {', '.join(left)}")

    _make_each(parallel, os.cpu_count(), make, when_made)
    _make_each(alone, 1, make, when_made)
    return [done[experiment.name] for experiment in experiments]


def _cached(experiments: Sequence[Experiment], full: bool, folder: Path) -> dict[str, Section]:
    """What the present runner's store has of them, by name."""
    store = current().store
    if store is None:
        return {}
    found = {experiment.name: cached_section(experiment, full, store, folder) for experiment in experiments}
    return {name: section for name, section in found.items() if section is not None}


def _make_each(
    experiments: Sequence[Experiment],
    workers: int | None,
    make: Callable[[Experiment], Section],
    when_made: Callable[[Section, float], None],
) -> None:
    """Make sections in a number of threads; `when_made` is told of each, and after how many seconds."""
    with current().threads(workers) as pool:
        begin = perf_counter()
        for future in as_completed([pool.submit(make, experiment) for experiment in experiments]):
            when_made(future.result(), perf_counter() - begin)


def scene_sections(setup: Setup, command: str, folder: Path, progress: Progress) -> list[Section]:
    """A section for every question to a user's own scene, each with a folder of its own.

    Args:
        command: what makes the page they stand on.
    """
    made = []
    for experiment in experiments_of(setup):
        progress(experiment.title)
        asked = section(experiment, folder / experiment.name, progress)
        made.append(replace(asked, made_by=command))
    return made


def _isolated_section(experiment: Experiment, folder: Path, store: Path, fresh: bool, full: bool) -> Section:
    own = (folder / experiment.name).resolve()
    arguments = (experiment.name, own, store.resolve(), fresh, full)
    made = isolated(section_by_name, *arguments, time_limit=TIME_LIMIT, memory_limit=MEMORY_LIMIT)
    return made if isinstance(made, Section) else Section(experiment, failure=f"{made.ending}: {made.reason}")


def section_by_name(name: str, folder: Path, store: Path, fresh: bool, full: bool) -> Section:
    """As `section`, with what travels between processes: the page needs no more of a result than its words."""
    with closing(Store(store)) as opened, using(Runner(LocalExecutor(), opened, fresh)):
        experiment = find(name)
        in_full = experiment.run_in_full if full else None
        asked = experiment if in_full is None else replace(experiment, run=in_full)
        made = section(asked, folder, lambda _: None)
        made = replace(made, experiment=experiment, full=in_full is not None)
    return made if made.result is None else replace(made, result=replace(made.result, data={}))


def embedded(file: Path) -> str:
    """A file as a link that carries it."""
    return "data:text/csv;base64," + base64.b64encode(file.read_bytes()).decode()
