"""A user's own scene, as made up."""

from __future__ import annotations

from experiments.experiment import Result, Table
from reference.scenes import find
from reference.system import MassSpringSystem
from tests.experiments.canned.scenes import stretched


def usual(system: MassSpringSystem | None = None) -> Result:
    """A string whose springs are stretched in the end; or another system."""
    system = system or find("string").system({"masses": 3})
    table = Table("scene", ["what", "value", "unit"], [["masses", len(system.masses), ""]])
    return Result(["mine is shown."], [table], {"system": system, "motion": stretched(system)})
