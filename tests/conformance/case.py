"""A run without its stepper. Imported in every engine's process: it needs nothing heavy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from reference.changes import Change
from reference.system import MassSpringSystem


@dataclass(frozen=True, eq=False)
class Case:
    """A system, a step dt [s], the number of steps, and what changes on the fly."""

    name: str
    system: MassSpringSystem
    dt: float
    steps: int
    changes: Sequence[Change] = ()
