"""What a stepper was found to be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np


@dataclass(frozen=True)
class Match:
    """How far a catalogued scheme is from the stepper.

    Attributes:
        scheme: its name.
        positions: the largest distance of any mass at any time compared [m].
        velocities: the same of velocities, times the step [m]: by how much a step then moves the masses elsewhere.
        steps: over how many steps they were compared; 0 where that is not told.
    """

    scheme: str
    positions: float
    velocities: float = 0.0
    steps: int = 0

    @property
    def error(self) -> float:
        """The larger of the two [m]."""
        return max(self.positions, self.velocities)


@dataclass(frozen=True)
class Identification:
    """What a stepper was found to be.

    Attributes:
        stepper: its name.
        ranking: the catalogue, nearest first.
        tolerance: up to which a scheme is named [m].
        reason: why there is no name; empty where there is one.
        told_apart_by: what was done to tell schemes apart that do the same on the system itself; empty where nothing
            was.
        compared: "trajectories"; or "single steps", each from a state of the stepper's own, perhaps "single steps away
            from obstacles": errors are then of a step; or "every bit of every step" (`bits`).
        same_without: of schemes that tie, what the system lacks that they differ in: "damping", "drag".
    """

    stepper: str
    ranking: tuple[Match, ...]
    tolerance: float
    reason: str = ""
    told_apart_by: str = ""
    compared: str = "trajectories"
    same_without: Mapping[str, str] = field(default_factory=dict)

    @property
    def identified_as(self) -> str | None:
        """The scheme, of several that match the simplest; None if none is within the tolerance, or all are."""
        return self.matches[0].scheme if self.matches and not self.reason else None

    @property
    def matches(self) -> tuple[Match, ...]:
        """All schemes within the tolerance: on this system they cannot be told apart."""
        return tuple(m for m in self.ranking if m.error <= self.tolerance)

    @property
    def ties(self) -> tuple[str, ...]:
        """The schemes beside itself that are as good as the one that is named; all that match, where none is named."""
        names = tuple(match.scheme for match in self.matches)
        return tuple(name for name in names[1:] if name != self.stepper) if self.identified_as else names

    @property
    def by_single_steps(self) -> bool:
        """Whether steps were compared one by one."""
        return self.compared.startswith("single steps")

    @property
    def error(self) -> float:
        """The nearest scheme's deviation [m]; infinite without a ranking."""
        return self.ranking[0].error if self.ranking else np.inf

    @property
    def remark(self) -> str:
        """The schemes it cannot be told from, and why, in a sentence; empty where there are none."""
        if not self.ties or not self.identified_as:
            return ""
        by_reason: dict[str, list[str]] = {}
        for name in self.ties:
            by_reason.setdefault(self.same_without.get(name, ""), []).append(name)
        parts = [
            ", ".join(names) + (f" (the same without {lacking})" if lacking else "")
            for lacking, names in sorted(by_reason.items(), reverse=True)
        ]
        return f"On this scene it cannot be told from {'; '.join(parts)}."

    def without_name(self, reason: str) -> Identification:
        """The same, with a reason why nothing is named."""
        return replace(self, reason=reason)

    def __str__(self) -> str:
        named = self.identified_as
        if named is None:
            return f"{self.stepper}: not identified; {self.reason}"
        a_step = f" a step (by {self.compared})" if self.by_single_steps else ""
        by = f", told apart by {self.told_apart_by}" if self.told_apart_by else ""
        return f"{self.stepper} is {named}, to {self.error:.2g} m{a_step}{by}"
