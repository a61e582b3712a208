"""The figures of results made by hand, each drawn once, and the tables beside them."""

from __future__ import annotations

from functools import cache

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
