"""The baseline: what the versions we keep do, one JSON file for each package, beside this file in `baselines`."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from experiments.engine_versions.changes import differences
from experiments.engine_versions.versions import Rows, Subject, VersionMeasurements, in_order
from reference.errors import InputError

#: Where the files are.
FOLDER = Path(__file__).parent / "baselines"


def packages(folder: Path = FOLDER) -> list[str]:
    """The packages that have a baseline."""
    return sorted(file.stem for file in folder.glob("*.json"))


def read(package: str, folder: Path = FOLDER) -> dict[str, Rows]:
    """What each version that is kept does, the oldest first; nothing for a package without a baseline."""
    file = folder / f"{package}.json"
    if not file.exists():
        return {}
    found: dict[str, Rows] = json.loads(file.read_text(encoding="utf-8"))
    return found


def write(measured: VersionMeasurements, folder: Path = FOLDER) -> Path:
    """Keep what was measured, in place of what the baseline had of the same versions and engines. The file."""
    kept = read(measured.package, folder)
    merged = {version: {**kept.get(version, {}), **rows} for version, rows in measured.rows.items()}
    versions = {**kept, **merged}
    file = folder / f"{measured.package}.json"
    document = {version: versions[version] for version in in_order([*versions])}
    file.write_text(json.dumps(document, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return file


def kept_versions(subject: Subject, asked: Sequence[str], folder: Path = FOLDER) -> list[str]:
    """The versions asked for, or all that are kept.

    Raises:
        InputError: for one that is not kept, or where there is no baseline.
    """
    kept = list(read(subject.package, folder))
    if not kept:
        raise InputError(
            f"{subject.package} has no baseline: expected VERSION..., or one of {', '.join(packages(folder))}"
        )
    for version in asked:
        if version not in kept:
            raise InputError(f"{subject.package} {version} is not in the baseline: expected {', '.join(kept)}")
    return list(asked) or kept


def unknown_engines(subject: Subject, folder: Path = FOLDER) -> list[str]:
    """The subject's engines of which nothing is kept: new ones, which there is nothing to compare with."""
    known = {name for rows in read(subject.package, folder).values() for name in rows}
    return [name for name in subject.names if name not in known]


def deviations(subject: Subject, measured: VersionMeasurements, folder: Path = FOLDER) -> list[str]:
    """Each difference between the baseline and what was measured, in a line; of the subject's known engines only."""
    lines = [f"{subject.package} {version}: {why}" for version, why in measured.missing.items()]
    unknown = unknown_engines(subject, folder)
    kept = read(subject.package, folder)
    for version, rows in measured.rows.items():
        expected = {name: of_name for name, of_name in kept[version].items() if name in subject.names}
        found = {name: of_name for name, of_name in rows.items() if name not in unknown}
        for change in differences(expected, found):
            before, after = ("nothing" if v is None else v for v in (change.before, change.after))
            place = f"{subject.package} {version}, {change.engine}, {change.measure}"
            lines.append(f"{place}: {before} in the baseline, {after} now")
    return lines
