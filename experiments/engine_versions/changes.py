"""What did a version change? Measurements compared: with those of the version before, or with the baseline."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from math import isclose

from experiments.engine_versions.conformance import Value
from experiments.engine_versions.versions import Rows, VersionMeasurements
from experiments.experiment import Result, Table

#: Measures of how an engine steps: another scheme, another limit, or no step at all.
OF_MOTION = ("identified", "largest stable dt", "runs")

#: Numbers are the same up to this part of themselves.
TOLERANCE = 1e-5


@dataclass(frozen=True)
class Change:
    """A measure that differs between two versions, or between the baseline and now; None where there is none."""

    engine: str
    measure: str
    before: Value | None
    after: Value | None


def same(one: Value | None, other: Value | None) -> bool:
    """Equal words, or numbers within TOLERANCE of each other."""
    if isinstance(one, float) and isinstance(other, float):
        return isclose(one, other, rel_tol=TOLERANCE)
    return one == other


def differences(before: Rows, after: Rows) -> list[Change]:
    """Everything that is not the same in both; of an engine that runs in one of them only, just that."""
    changes = []
    for engine in dict.fromkeys([*before, *after]):
        old, new = before.get(engine, {}), after.get(engine, {})
        measures = dict.fromkeys([*old, *new]) if same(old.get("runs"), new.get("runs")) else ["runs"]
        changes += [Change(engine, name, old.get(name), new.get(name)) for name in measures]
    return [change for change in changes if not same(change.before, change.after)]


def changes(before: Rows, after: Rows) -> list[Change]:
    """What a version changed: differences in what both were asked."""
    return [c for c in differences(before, after) if c.before is not None and c.after is not None]


def result_of(measured: VersionMeasurements) -> Result:
    """What changed from version to version, in sentences and tables."""
    versions, rows = [*measured.rows], measured.rows
    asked = [(engine, name) for engine, name in _asked(rows)]
    differing = [key for key in asked if not _same_in_all(rows, *key)]
    columns = ["engine", "measure", *versions]
    tables = [
        Table(
            f"{measured.package}{suffix}", columns, [[*key, *(_value(rows[v], *key) for v in versions)] for key in keys]
        )
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
    moved = [change for change in found if change.measure.startswith(OF_MOTION)]
    first = "The motion changed" if moved else "The motion is the same"
    by_engine: dict[str, list[str]] = {}
    for change in found:
        by_engine.setdefault(change.engine, []).append(change.measure)
    listed = "; ".join(f"{engine}: {', '.join(names)}" for engine, names in by_engine.items())
    return f"{first}: {package} {new} changed {len(found)} of {count} measurements of {old}. Of {listed}."
