"""What do versions of an engine do, and what did each of them change?

Each version runs in an environment of its own (`engines.environments`); what it did is judged here.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise
from math import isclose
from pathlib import Path

from engines.crash_list import TIME_LIMIT, Breach, crash_list, ending
from engines.engine import Engine, registry
from engines.environments import environment
from engines.isolation import EngineStepper, isolated
from engines.supervisor import supervisor
from experiments.comparison import Progress
from experiments.conformance import Value, measure
from experiments.experiment import Result, Table
from reference.errors import InputError, unknown_name

#: What was measured of a version: by engine (the crash list by package), by measure.
Rows = dict[str, dict[str, Value]]

#: Numbers are the same up to this part of themselves.
TOLERANCE = 1e-5


@dataclass(frozen=True)
class Subject:
    """What is measured of a package: settings of its engine, and where they are all of them, its crash list."""

    package: str
    engines: Sequence[Engine]
    crashes: Sequence[Breach]


@dataclass(frozen=True)
class Measured:
    """What versions of a package do.

    Attributes:
        rows: by version, in their order.
        missing: by version, why it could not be had.
    """

    package: str
    rows: Mapping[str, Rows]
    missing: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Change:
    """A measure that differs between two versions, or between the baseline and now; None where there is none."""

    engine: str
    measure: str
    before: Value | None
    after: Value | None


def find_subject(name: str) -> Subject:
    """A package with all its engines, or one engine. Raises InputError, with a suggestion, for an unknown name."""
    engines = registry()
    packages = dict.fromkeys(engine.package for engine in engines.values())
    if name in packages:
        of_package = [engine for engine in engines.values() if engine.package == name]
        return Subject(name, of_package, [*crash_list(name).values()])
    if name not in engines:
        raise unknown_name("engine", name, [*packages, *engines])
    return Subject(engines[name].package, [engines[name]], [])


def in_order(versions: Sequence[str]) -> list[str]:
    """Versions, the oldest first, each once."""
    return sorted(dict.fromkeys(versions), key=lambda version: [int(n) for n in re.findall(r"\d+", version)])


def measure_versions(
    subject: Subject, versions: Sequence[str], progress: Progress, patient: bool = False
) -> Measured:
    """What each version does.

    Args:
        patient: whether a version that cannot be had is let be.

    Raises:
        InputError: for one that cannot be had, unless patient.
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
        return Measured(subject.package, _measure(subject, pythons, progress), missing)
    finally:
        for python in pythons.values():
            supervisor(python).stop()


def _measure(subject: Subject, pythons: Mapping[str, Path], progress: Progress) -> dict[str, Rows]:
    """The rows of every version; what they are made of is measured side by side."""
    tasks: dict[tuple[str, str, str], Callable[[], dict[str, Value]]] = {}
    for version, python in pythons.items():
        for engine in subject.engines:
            stepper = EngineStepper(engine, isolate=partial(isolated, python=python), pinned=version)
            tasks[version, engine.name, ""] = partial(measure, stepper)
        for breach in subject.crashes:
            tasks[version, subject.package, breach.name] = partial(_break, breach, python)
    answers = {}
    for key, answer in _side_by_side(tasks):
        answers[key] = answer
        progress(f"{len(answers)} of {len(tasks)} done: {subject.package} {' '.join(key)}")
    rows: dict[str, Rows] = {version: {} for version in pythons}
    for version, name, breach_name in tasks:
        rows[version].setdefault(name, {}).update(answers[version, name, breach_name])
    return rows


def _side_by_side(
    tasks: Mapping[tuple[str, str, str], Callable[[], dict[str, Value]]],
) -> Iterator[tuple[tuple[str, str, str], dict[str, Value]]]:
    """The answers as they come. Where one fails or is interrupted, those under way are not waited for."""
    pool = ThreadPoolExecutor(os.cpu_count())
    try:
        futures = {pool.submit(task): key for key, task in tasks.items()}
        for done in as_completed(futures):
            yield futures[done], done.result()
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _break(breach: Breach, python: Path) -> dict[str, Value]:
    """What becomes of an engine, as a row."""
    return {f"crash list: {breach.name}": ending(isolated(breach.task, time_limit=TIME_LIMIT, python=python))}


def same(one: Value | None, other: Value | None) -> bool:
    """Equal words, or numbers within TOLERANCE of each other."""
    if isinstance(one, float) and isinstance(other, float):
        return isclose(one, other, rel_tol=TOLERANCE)
    return one == other


def differences(before: Rows, after: Rows) -> list[Change]:
    """Everything that is not the same in both, what is only in one of them too."""
    changes = []
    for engine in dict.fromkeys([*before, *after]):
        old, new = before.get(engine, {}), after.get(engine, {})
        changes += [Change(engine, name, old.get(name), new.get(name)) for name in dict.fromkeys([*old, *new])]
    return [change for change in changes if not same(change.before, change.after)]


def changes(before: Rows, after: Rows) -> list[Change]:
    """What a version changed: differences in what both were asked. Of an engine that does not run nothing is."""
    return [c for c in differences(before, after) if c.before is not None and c.after is not None]


def result_of(measured: Measured) -> Result:
    """What changed from version to version, in sentences and tables."""
    versions, rows = [*measured.rows], measured.rows
    asked = [(engine, name) for engine, name in _asked(rows)]
    differing = [key for key in asked if not _same_in_all(rows, *key)]
    columns = ["engine", "measure", *versions]
    tables = [
        Table(f"{measured.package}{suffix}", columns, [[*key, *(_value(rows[v], *key) for v in versions)] for key in keys])
        for suffix, keys in (("_changes", differing), ("", asked))
    ]
    findings = [_finding(measured.package, old, new, rows[old], rows[new]) for old, new in pairwise(versions)]
    failures = [f"{measured.package} {version}: {why}" for version, why in measured.missing.items()]
    return Result(findings or [f"{len(asked)} measurements of {versions}."], tables, {"measured": measured}, failures)


def _asked(rows: Mapping[str, Rows]) -> list[tuple[str, str]]:
    """Engine and measure of everything that any version was asked."""
    keys = [(engine, name) for of_version in rows.values() for engine in of_version for name in of_version[engine]]
    order = {engine: i for i, engine in enumerate(dict.fromkeys(engine for engine, _ in keys))}
    return sorted(dict.fromkeys(keys), key=lambda key: order[key[0]])


def _value(rows: Rows, engine: str, name: str) -> Value | None:
    return rows.get(engine, {}).get(name)


def _same_in_all(rows: Mapping[str, Rows], engine: str, name: str) -> bool:
    values = [v for v in (_value(of_version, engine, name) for of_version in rows.values()) if v is not None]
    return all(same(values[0], value) for value in values)


def _finding(package: str, old: str, new: str, before: Rows, after: Rows) -> str:
    """What a version changed, in a sentence."""
    count = sum(_value(after, *key) is not None for key in _asked({old: before}))
    found = changes(before, after)
    if not found:
        return f"{package} {new} changed nothing: {count} measurements are those of {old}."
    listed = "; ".join(f"{c.engine}, {c.measure}: {c.before} became {c.after}" for c in found)
    return f"{package} {new} changed {len(found)} of {count} measurements of {old}. {listed}."
