"""The figures of results made by hand, each drawn once, and the tables beside them."""

from __future__ import annotations

from functools import cache
from typing import Any

from experiments.experiment import Result
from report.figures import Picture, draw
from tests.experiments.canned.results import RESULTS


@cache
def result(name: str, case: str = "usual") -> Result:
    """What is drawn."""
    return RESULTS[name][case]()


@cache
def shown(name: str, case: str = "usual") -> Picture:
    """The figure of an experiment's result."""
    return draw(name, result(name, case))


def records(result: Result, table: str | None = None) -> list[dict[str, Any]]:
    """The rows of a table, by default the first, each by its columns."""
    (found,) = [t for t in result.tables if t.name == table] if table else result.tables[:1]
    return [dict(zip(found.columns, row, strict=True)) for row in found.rows]
