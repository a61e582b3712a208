"""The command that measures versions of engines: versions."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import asdict
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from reference.errors import InputError
from reference.printable import printable
from report.commands.options import json_option, out_option
from report.commands.terminal import RESULTS, json_text, progress, show_table

if TYPE_CHECKING:
    from experiments.engine_versions.versions import Subject, VersionMeasurements
    from experiments.runs.progress import Progress


@click.command("versions")
@click.argument("engine", required=False)
@click.argument("versions", nargs=-1, metavar="[VERSION]...")
@click.option("--all", "all_kept", is_flag=True, help="All versions in the baseline.")
@click.option("--check", is_flag=True, help="Compare with the baseline; exit code 1, with the differences, if any.")
@click.option("--bisect", is_flag=True, help="Of the versions given, find two neighbours between which it changed.")
@click.option("--update-baseline", "update", is_flag=True, help="Write the baseline that the project keeps.")
@click.option("--install", is_flag=True, help="Only make the environment that ENGINE's package is run in, and keep it.")
@json_option
@out_option(RESULTS / "versions")
def versions_command(
    engine: str | None,
    versions: tuple[str, ...],
    install: bool,
    all_kept: bool,
    check: bool,
    bisect: bool,
    update: bool,
    as_json: bool,
    out: Path,
) -> int:
    """Say what versions of ENGINE do, each in an environment of its own, and what each changed.

    ENGINE is a package, such as mujoco, or one engine of `springlab list`. Without ENGINE: all that are in the
    baseline. Environments are made in the user's cache folder at first need, from the package index, and kept there; a
    version that the index has no wheel of for this Python is compiled, which takes minutes. A VERSION may be the file
    of a wheel that you have built.
    """
    from experiments.engine_versions.versions import measure_versions

    if install:
        return _install(engine)
    if engine is None and not (all_kept or check):
        raise InputError("versions: expected ENGINE and VERSION..., or --all, or --check")
    measured = []
    with progress("versions") as tell:
        for subject, wanted in _wanted(engine, versions, all_kept or check):
            named = bool(versions) and not check
            if bisect:
                measured.append((subject, _between(subject, wanted, tell)))
            else:
                measured.append((subject, measure_versions(subject, wanted, tell, patient=not named)))
    if update:
        from experiments.engine_versions.baseline import write

        for _, found in measured:
            print(f"written: {write(found)}", file=sys.stderr)
    return _compare(measured, as_json) if check else _show(measured, as_json, out)


def _install(name: str | None) -> int:
    """Make the environment of a package that has one of its own."""
    from engines.engine import registry
    from engines.process.environments import environment
    from engines.process.packages import APART

    package = registry()[name].package if name and name in registry() else name
    if package is None or package not in APART:
        raise InputError(f"versions --install {package or ''}: expected one of {', '.join(APART)}")
    with progress("versions") as tell:
        tell(f"environment of {package} {APART[package].version}")
        click.echo(printable(f"made: {environment(package, APART[package].version).parents[1]}"))
    return 0


def _between(subject: Subject, versions: Sequence[str], tell: Progress) -> VersionMeasurements:
    """The two neighbours between which something changed."""
    from experiments.engine_versions.changes import changes
    from experiments.engine_versions.versions import measure_versions, where_it_changed

    def measured(version: str) -> VersionMeasurements:
        return measure_versions(subject, [version], tell)

    return where_it_changed(subject, versions, measured, lambda before, after: bool(changes(before, after)))


def _wanted(engine: str | None, versions: Sequence[str], kept: bool) -> list[tuple[Subject, list[str]]]:
    """What is to be measured; with `kept`, only what the baseline has."""
    from experiments.engine_versions.baseline import kept_versions, packages
    from experiments.engine_versions.versions import find_subject

    subjects = [find_subject(name) for name in ([engine] if engine else packages())]
    return [(s, kept_versions(s, versions) if kept or not versions else list(versions)) for s in subjects]


def _compare(measured: Sequence[tuple[Subject, VersionMeasurements]], as_json: bool) -> int:
    from experiments.engine_versions.baseline import deviations, unknown_engines

    for subject, _ in measured:
        for name in unknown_engines(subject):
            print(f"not compared: {name}, of which the baseline has nothing; see --update-baseline", file=sys.stderr)
    lines = [line for subject, found in measured for line in deviations(subject, found)]
    count = sum(len(of_name) for _, found in measured for rows in found.rows.values() for of_name in rows.values())
    if as_json:
        click.echo(json_text({"measurements": count, "differences": lines}))
    else:
        click.echo("\n".join(lines) or f"{count} measurements are as in the baseline.")
    return int(bool(lines))


def _show(measured: Sequence[tuple[Subject, VersionMeasurements]], as_json: bool, out: Path) -> int:
    from experiments.engine_versions.changes import result_of
    from experiments.experiment import write_tables
    from report.figures import draw

    documents = {}
    for _, found in measured:
        result = result_of(found)
        files = [*write_tables(result, out), out / f"{found.package}.svg", out / f"{found.package}.json"]
        documents[found.package] = _document(found)
        files[-2].write_text(draw("versions", result).svg(), encoding="utf-8")
        files[-1].write_text(json_text(documents[found.package]) + "\n", encoding="utf-8")
        if as_json:
            continue
        for line in [*result.findings, *(f"not done: {failure}" for failure in result.failures)]:
            click.echo(line)
        changed = result.tables[0]
        if changed.rows:
            show_table("", changed.columns, changed.rows)
        click.echo(printable(f"written: {', '.join(map(str, files))}"))
    if as_json:
        click.echo(json_text(documents))
    return 0


def _document(found: VersionMeasurements) -> dict[str, Any]:
    """What was measured of a package, and what changed, as JSON has it."""
    from experiments.engine_versions.changes import changes

    pairs = [
        {"from": old, "to": new, **asdict(change)}
        for old, new in pairwise(found.rows)
        for change in changes(found.rows[old], found.rows[new])
    ]
    return {"versions": dict(found.rows), "changes": pairs, "missing": dict(found.missing)}
