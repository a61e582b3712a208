"""The report's sections: every experiment run and drawn, each in a process of its own."""

from __future__ import annotations

import base64
import os
from collections.abc import Sequence
from concurrent.futures import as_completed
from contextlib import closing
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from time import perf_counter

from engines.process.isolation import isolated
from experiments.advice.own_scene import experiments_of
from experiments.experiment import Experiment, Result, find, write_tables
from experiments.runs.runner import LocalCrew, Runner, current, using
from experiments.runs.side_by_side import Progress
from experiments.runs.store import Store, StoreError
from reference.scenes import Setup
from report.figures import animate, draw

#: An experiment may take so long [s], and its process so much memory [bytes].
TIME_LIMIT, MEMORY_LIMIT = 900.0, 16 * 2**30


@dataclass(frozen=True)
class Section:
    """One experiment on the page: its answer, or why there is none.

    Attributes:
        full: whether it was run in full.
        made_by: its command, where that is not the experiment's own.
        motions: its animations, as HTML.
    """

    experiment: Experiment
    result: Result | None = None
    svg: str = ""
    alt: str = ""
    downloads: Sequence[tuple[str, str]] = ()
    failure: str = ""
    full: bool = False
    made_by: str = ""
    motions: str = ""

    @property
    def command(self) -> str:
        """What makes its figure and tables."""
        if self.made_by:
            return self.made_by
        name = self.experiment.name
        return f"springlab report --only {name} --full" if self.full else f"springlab run {name}"


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
    return Section(
        experiment, result, svg, picture.alt, [(file.name, embedded(file)) for file in files], motions=motions
    )


def all_sections(
    experiments: Sequence[Experiment],
    folder: Path,
    progress: Progress,
    store: Path,
    fresh: bool = False,
    full: bool = False,
) -> list[Section]:
    """A section for every experiment, in their order, each with a folder of its own.

    What is kept of before, with nothing changed since, is shown again. The others run beside one another, each in
    a process of its own; those that measure times run alone, at the end.

    Args:
        full: whether those that can are to be run in full.
    """
    from report.page.section_cache import keep, kept

    shelf = current().store
    done: dict[str, Section] = {}
    for experiment in [] if fresh else experiments:
        again = None if shelf is None else kept(experiment, full, shelf, folder)
        if again is not None:
            done[experiment.name] = again
    missing = [experiment for experiment in experiments if experiment.name not in done]
    crowd = [experiment for experiment in missing if not experiment.timed]
    alone = [experiment for experiment in missing if experiment.timed]
    progress(f"{len(done)} of {len(experiments)} done")
    for group, workers in ((crowd, os.cpu_count()), (alone, 1)):
        with current().threads(workers) as pool:
            made = partial(_isolated_section, folder=folder, store=store, fresh=fresh, full=full)
            begin = perf_counter()
            running = {pool.submit(made, experiment): experiment for experiment in group}
            for future in as_completed(running):
                came = future.result()
                seconds = perf_counter() - begin
                done[running[future].name] = came if shelf is None else keep(came, full, shelf, seconds)
                left = [experiment.name for experiment in running.values() if experiment.name not in done]
                progress(f"{len(done)} of {len(experiments)} done; next: {', '.join(left)}")
    return [done[experiment.name] for experiment in experiments]


def scene_sections(setup: Setup, command: str, folder: Path, progress: Progress) -> list[Section]:
    """A section for every question to somebody's scene, each with a folder of its own."""
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
    with closing(Store(store)) as kept, using(Runner(LocalCrew(), kept, fresh)):
        experiment = find(name)
        fuller = experiment.run_in_full if full else None
        asked = replace(experiment, run=fuller) if fuller is not None else experiment
        made = replace(section(asked, folder, lambda _: None), experiment=experiment, full=fuller is not None)
    return made if made.result is None else replace(made, result=replace(made.result, data={}))


def embedded(file: Path) -> str:
    """A file as a link that carries it."""
    return "data:text/csv;base64," + base64.b64encode(file.read_bytes()).decode()
