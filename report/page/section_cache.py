"""The section cache: sections kept in the store, and shown again while nothing has changed that decides them."""

from __future__ import annotations

import base64
import importlib
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from typing import Any

from engines.engine import available_version, registry
from experiments.experiment import Experiment, Result, Table
from experiments.runs.environment import environment, processor
from experiments.runs.store import Store
from experiments.runs.task import Task, digest
from report.page.section import Section

PROJECT = Path(__file__).parents[2]

#: What is computed and drawn with: folders with all they hold, and the files that make sections of results.
FOLDERS = ("reference", "engines", "experiments", "report/figures", "report/film")
FILES = tuple(f"report/page/{name}.py" for name in ("processes", "section", "section_cache", "sections"))


def cached_section(experiment: Experiment, full: bool, store: Store, folder: Path) -> Section | None:
    """The section as it was made before, its files written anew into a folder of its own; None where it is to be made.

    Raises:
        OSError, StoreError: where the files cannot be written or the store not be read.
    """
    task = task_of(experiment, full)
    found = None if task is None else store.find(task)
    if found is None:
        return None
    section = from_document(experiment, found.answer)
    own = folder / experiment.name
    own.mkdir(parents=True, exist_ok=True)
    (own / f"{experiment.name}.svg").write_text(section.svg, encoding="utf-8")
    for name, link in section.downloads:
        (own / name).write_bytes(base64.b64decode(link.partition("base64,")[2]))
    return section


def cache_section(section: Section, full: bool, store: Store, seconds: float) -> Section:
    """Keep a section that came to its end, in place of what the cache had; the section as it will be shown again.

    Args:
        seconds: how long it took to make [s].

    Raises:
        StoreError: where the store cannot be written.
    """
    task = task_of(section.experiment, full)
    if task is None or section.result is None:
        return section
    store.retire([task.key])
    try:
        store.keep(task, document(section), seconds)
    except TypeError:  # something in a table that the store cannot hold
        return section
    found = store.find(task)
    return section if found is None else from_document(section.experiment, found.answer)


def task_of(experiment: Experiment, full: bool) -> Task | None:
    """What the store knows a section by; None where its experiment's function cannot be told from others."""
    run = (experiment.run_in_full if full else None) or experiment.run
    name = name_of(run)
    if name is None:
        return None
    machine = processor() if experiment.timed else ""
    return Task(report_section, (experiment.name, full, name, sources(), versions(), machine))


def report_section(experiment: str, full: bool, run: str, sources: str, versions: str, machine: str) -> None:
    """What the store calls a section; its answer is made elsewhere."""


def name_of(run: Callable[..., Any]) -> str | None:
    """The name of a module's own function, with the digest of what is given to it; None for any other."""
    given = digest(dict(run.keywords)) if isinstance(run, partial) else ""
    function = run.func if isinstance(run, partial) else run
    module, name = function.__module__, getattr(function, "__qualname__", "")
    known = getattr(importlib.import_module(module), name, None)
    return f"{module}.{name} {given}" if known is function else None


@cache
def sources() -> str:
    """The digest of all files that decide what a section says."""
    return digest([(str(file.relative_to(PROJECT)), file.read_bytes()) for file in source_files()])


def source_files() -> list[Path]:
    """All files that decide what a section says."""
    files = [file for folder in FOLDERS for file in sorted((PROJECT / folder).rglob("*")) if file.is_file()]
    files += [PROJECT / file for file in FILES]
    return [file for file in files if "__pycache__" not in file.parts]


@cache
def versions() -> str:
    """The digest of the packages and the system that everything rests on."""
    told = environment()
    for name in ("date", "processor"):
        del told[name]
    packages = {engine.package: available_version(engine.package) for engine in registry().values()}
    return digest(told, packages)


def document(section: Section) -> dict[str, Any]:
    """A section that came to its end, as what the store can hold."""
    assert section.result is not None
    result = section.result
    return {
        "findings": list(result.findings),
        "tables": [{"name": t.name, "columns": list(t.columns), "rows": list(t.rows)} for t in result.tables],
        "failures": list(result.failures),
        "svg": section.svg,
        "alt": section.alt,
        "downloads": list(section.downloads),
        "full": section.full,
        "motions": section.motions,
    }


def from_document(experiment: Experiment, told: Mapping[str, Any]) -> Section:
    """The section that was kept as a document."""
    tables = [Table(table["name"], table["columns"], table["rows"]) for table in told["tables"]]
    result = Result(told["findings"], tables, {}, told["failures"])
    downloads = [(name, link) for name, link in told["downloads"]]
    made = Section(experiment, result, told["svg"], told["alt"], downloads)
    return replace(made, full=told["full"], motions=told["motions"])
