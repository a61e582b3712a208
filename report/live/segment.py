"""A segment: what has happened since the last thing that no command can say, so that it can be repeated."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from reference.state import State
from reference.system import MassSpringSystem, Value


@dataclass(frozen=True, eq=False)
class Segment:
    """A run that can be repeated.

    Attributes:
        scene: its name, or the path of its file.
        settings: its parameters that were set otherwise; None where the scene cannot be named: it is written out.
        system: at the beginning, without the changes.
        steppers: one for each lane.
        begin: where each lane began.
        dt: the step [s].
        steps: how many there have been.
        changes: of parameters: before which step, which one, to what.
    """

    scene: str
    settings: Mapping[str, str] | None
    system: MassSpringSystem
    steppers: tuple[str, ...]
    begin: tuple[State, ...]
    dt: float
    steps: int = 0
    changes: tuple[tuple[int, str, Value], ...] = ()

    @property
    def at_start(self) -> bool:
        """Whether it begins at the start of a scene that can be named, and nothing has moved yet."""
        return self.settings is not None and self.steps == 0

    def after(self, steps: int) -> Segment:
        """The same, some steps further."""
        return replace(self, steps=self.steps + steps)

    def with_change(self, parameter: str, value: Value) -> Segment:
        """The same with a change now; a change of the same parameter since the last step is undone by it."""
        earlier = [change for change in self.changes if change[0] < self.steps]
        now = [change for change in self.changes if change[0] == self.steps and change[1] != parameter]
        return replace(self, changes=(*earlier, *now, (self.steps, parameter, value)))
