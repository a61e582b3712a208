"""What do versions of an engine do?

Each version runs in an environment of its own (`engines.process.environments`); what it did is judged here.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from engines.crash_cases import TIME_LIMIT, CrashCase, crash_cases, ending
from engines.engine import Engine, registry
from engines.process.environments import environment, numpy_version, version_numbers
from engines.process.isolation import EngineStepper, isolated
from engines.process.supervisor import supervisor
from experiments.engine_versions.conformance import Value, measure
from experiments.runs.progress import Progress
from experiments.translation import free_spring
from reference.errors import InputError, unknown_name

#: What was measured of a version: by engine (crash cases by package), by measure.
Rows = dict[str, dict[str, Value]]


@dataclass(frozen=True)
class Subject:
    """What is measured of a package: settings of its engine, and the package itself, by its crash cases and so on."""

    package: str
    engines: Sequence[Engine]
    whole: bool

    @property
    def names(self) -> list[str]:
        """What its rows are of."""
        return [*(engine.name for engine in self.engines), *([self.package] if self.whole else [])]


@dataclass(frozen=True)
class VersionMeasurements:
    """What versions of a package do.

    Attributes:
        rows: by version, in their order.
        missing: by version, why it could not be installed.
    """

    package: str
    rows: Mapping[str, Rows]
    missing: Mapping[str, str] = field(default_factory=dict)


def find_subject(name: str) -> Subject:
    """A package with all its engines, or one engine. Raises InputError, with a suggestion, for an unknown name."""
    engines = registry()
    packages = dict.fromkeys(engine.package for engine in engines.values())
    if name in packages:
        return Subject(name, [engine for engine in engines.values() if engine.package == name], whole=True)
    if name not in engines:
        raise unknown_name("engine", name, [*packages, *engines])
    return Subject(engines[name].package, [engines[name]], whole=False)


def in_order(versions: Sequence[str]) -> list[str]:
    """Versions, the oldest first, each once."""
    return sorted(dict.fromkeys(versions), key=version_numbers)


def measure_versions(
    subject: Subject, versions: Sequence[str], progress: Progress, patient: bool = False
) -> VersionMeasurements:
    """What each version does.

    Args:
        patient: whether a version that cannot be installed is left out.

    Raises:
        InputError: for one that cannot be installed, unless patient.
    """
    pythons: dict[str, Path] = {}
    missing: dict[str, str] = {}
    for version in in_order(versions):
        progress(f"environment of {subject.package} {version}")
        try:
            pythons[version] = environment(subject.package, version)
        except InputError as error:
            if not patient:
                raise
            missing[version] = str(error)
    try:
        return VersionMeasurements(subject.package, _measure(subject, pythons, progress), missing)
    finally:
        for python in pythons.values():
            supervisor(python).stop()


def where_it_changed(
    subject: Subject,
    versions: Sequence[str],
    measured: Callable[[str], VersionMeasurements],
    changed: Callable[[Rows, Rows], bool],
) -> VersionMeasurements:
    """Of versions in their order, the last that still does as the first, and the next one, by halving.

    Where a change was taken back in between, one of the places where it came is found. As few versions as can be are
    measured: of a hundred, nine.

    Args:
        measured: what one version does.
        changed: whether the second does something else than the first.
    """
    order = in_order(versions)
    if len(order) < 2:
        raise InputError(f"{subject.package}: expected two versions or more to look between")
    rows = {version: dict(measured(version).rows)[version] for version in (order[0], order[-1])}
    low, high = 0, len(order) - 1
    if changed(rows[order[low]], rows[order[high]]):
        while high - low > 1:
            middle = (low + high) // 2
            rows[order[middle]] = dict(measured(order[middle]).rows)[order[middle]]
            if changed(rows[order[0]], rows[order[middle]]):
                high = middle
            else:
                low = middle
    return VersionMeasurements(subject.package, {order[i]: rows[order[i]] for i in (low, high)})


def _measure(subject: Subject, pythons: Mapping[str, Path], progress: Progress) -> dict[str, Rows]:
    """The rows of every version; what they are made of is measured side by side."""
    tasks: dict[tuple[str, str, str], Callable[[], Mapping[str, Value]]] = {}
    for version, python in pythons.items():
        for engine in subject.engines:
            stepper = EngineStepper(engine, isolate=partial(isolated, python=python), pinned=version)
            tasks[version, engine.name, "conformance"] = partial(measure, stepper)
        if subject.whole:
            tasks[version, subject.package, "NumPy"] = partial(_numpy, python)
            for translation in free_spring.of_package(subject.package):
                own = partial(free_spring.measured, translation, python)
                tasks[version, subject.package, translation.name] = own
            for case in crash_cases(subject.package).values():
                tasks[version, subject.package, case.name] = partial(_break, case, python)
    answers = {}
    for key, answer in _side_by_side(tasks):
        answers[key] = answer
        progress(f"{len(answers)} of {len(tasks)} done: {subject.package} {', '.join(key)}")
    rows: dict[str, Rows] = {version: {} for version in pythons}
    for version, name, what in tasks:
        rows[version].setdefault(name, {}).update(answers[version, name, what])
    return rows


def _side_by_side(
    tasks: Mapping[tuple[str, str, str], Callable[[], Mapping[str, Value]]],
) -> Iterator[tuple[tuple[str, str, str], Mapping[str, Value]]]:
    """The answers as they come. Where one fails or is interrupted, those under way are not waited for."""
    pool = ThreadPoolExecutor(os.cpu_count())
    try:
        futures = {pool.submit(task): key for key, task in tasks.items()}
        for done in as_completed(futures):
            yield futures[done], done.result()
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _numpy(python: Path) -> Mapping[str, Value]:
    """With which NumPy it could be imported, as a row."""
    answer = isolated(numpy_version, python=python)
    return {"NumPy": answer if isinstance(answer, str) else f"{answer.ending}: {answer.reason}"}


def _break(case: CrashCase, python: Path) -> Mapping[str, Value]:
    """What becomes of an engine, as a row."""
    return {f"crash list: {case.name}": ending(isolated(case.function, time_limit=TIME_LIMIT, python=python))}
