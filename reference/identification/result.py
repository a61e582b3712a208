"""What a stepper was found to be."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Match:
    """How far a catalogued scheme is from the stepper: the largest distance of any mass at any time [m]."""

    scheme: str
    error: float


@dataclass(frozen=True)
class Identification:
    """What a stepper was found to be.

    Attributes:
        stepper: its name.
        ranking: the catalogue, nearest first.
        tolerance: up to which a scheme is named [m].
        reason: why there is no ranking, where there is none.
    """

    stepper: str
    ranking: tuple[Match, ...]
    tolerance: float
    reason: str = ""

    @property
    def identified_as(self) -> str | None:
        """The scheme, or None if none is within the tolerance."""
        return self.ranking[0].scheme if self.matches else None

    @property
    def matches(self) -> tuple[Match, ...]:
        """All schemes within the tolerance: on this system they cannot be told apart."""
        return tuple(m for m in self.ranking if m.error <= self.tolerance)

    @property
    def error(self) -> float:
        """The nearest scheme's deviation [m]; infinite without a ranking."""
        return self.ranking[0].error if self.ranking else np.inf

    def __str__(self) -> str:
        if not self.ranking:
            return f"{self.stepper}: not identified; {self.reason}"
        nearest = self.ranking[0]
        if self.identified_as is None:
            return f"{self.stepper}: not identified; nearest {nearest.scheme} at {nearest.error:.2g} m"
        return f"{self.stepper} is {nearest.scheme}, to {nearest.error:.2g} m"
