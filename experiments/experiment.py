"""What an experiment is: a question, and a function that answers it in tables and sentences made from its numbers."""

from __future__ import annotations

import csv
import importlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from experiments.runs.progress import Progress
from reference.errors import unknown_name
from reference.files.csv_cell import cell
from reference.registry import Registry

#: The experiments, in the order they are shown; each is the module experiments.NAME.
NAMES = (
    "divergence",
    "stability",
    "maps",
    "order",
    "energy",
    "stiff_limit",
    "less_damping",
    "first_order_instability",
    "numbering",
    "errata",
    "barrier",
    "drape",
    "ground_motion",
    "scenes",
    "cost",
    "speed",
    "million_runs",
)


@dataclass(frozen=True)
class Table:
    """Rows of numbers and words under headings with units.

    Attributes:
        name: what its CSV file is called.
        columns: headings, with the unit in brackets.
        rows: one value per column; None for an empty cell.
    """

    name: str
    columns: Sequence[str]
    rows: Sequence[Sequence[Any]]


@dataclass(frozen=True)
class Result:
    """An experiment's answer.

    Attributes:
        findings: sentences made from the numbers, the first one the answer.
        tables: the numbers; the first one is shown, all are written as CSV.
        data: what its figure draws, by name.
        failures: what did not come to its end, each with its reason.
    """

    findings: Sequence[str]
    tables: Sequence[Table]
    data: Mapping[str, Any] = field(default_factory=dict)
    failures: Sequence[str] = ()


@dataclass(frozen=True)
class Experiment:
    """A question and the function that answers it.

    Attributes:
        name: the module's.
        title: a few words.
        question: one sentence.
        slides: of the lecture.
        run: answers it, telling `progress` what it is at.
        in_report: whether `springlab report` runs it unasked.
        timed: whether it measures times, and so must run alone.
        run_in_full: the same, with more or finer numbers, where there is such a run.
    """

    name: str
    title: str
    question: str
    slides: str
    run: Callable[[Progress], Result]
    in_report: bool = True
    timed: bool = False
    run_in_full: Callable[[Progress], Result] | None = None


def experiments() -> Mapping[str, Experiment]:
    """All experiments by name, in the order of NAMES. Imports their modules, which import what they need when they run.

    Raises:
        InputError: where two have one name.
    """
    known = Registry[Experiment]("experiment", [f"experiments.{name}" for name in NAMES])
    for name in NAMES:
        module = importlib.import_module(f"experiments.{name}")
        known.enter(module.EXPERIMENT.name, module.EXPERIMENT, module.__name__)
    return known.all()


def find(name: str) -> Experiment:
    """The experiment of that name. Raises InputError, with a suggestion, where there is none."""
    if name not in NAMES:
        raise unknown_name("experiment", name, NAMES)
    return experiments()[name]


def write_tables(result: Result, folder: Path) -> list[Path]:
    """Write every table as a CSV file into a folder, and return the files."""
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for table in result.tables:
        files.append(folder / f"{table.name}.csv")
        with files[-1].open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(map(cell, table.columns))
            writer.writerows(["" if value is None else cell(value) for value in row] for row in table.rows)
    return files
