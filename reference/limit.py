"""A stability limit: the one form it has, predicted or measured. Needs NumPy only."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, isinf
from typing import Literal

#: How sure a limit is: proved up to rounding; from eigenvalues or runs; or known only to lie between two values.
Certainty = Literal["certified", "computed", "between"]

#: Which dts are stable, as far as that is known or was tried.
StableSteps = Literal["up to a limit", "any", "none", "unknown"]


@dataclass(frozen=True)
class Limit:
    """Up to which dt perturbations do not grow: the first limit, from short steps on.

    Attributes:
        dt: the limit [s]; None where there is none. Of a limit between two values the lower one.
        reason: why there is none; empty where there is one.
        growth: where perturbations grow at any dt, how much they do in a step of a tenth of the fastest mode's 1/w.
        factors: the growth factors of the step just below and just above the limit, where they were looked at.
        grows_beyond: whether perturbations were seen to grow beyond the limit; None where that was not looked at.
        certainty: how sure it is.
        at_most: the upper one of two values between which the limit lies [s].
        note: what is to be known of a limit that there is.
        windows: where above the limit a step is stable again: (from, to) [s], rising; the last may have no end.
        looked_to: up to where such were looked for [s]: one that ends there may go on.
    """

    dt: float | None
    reason: str = ""
    growth: float | None = None
    factors: tuple[float, float] | None = None
    grows_beyond: bool | None = None
    certainty: Certainty = "computed"
    at_most: float | None = None
    note: str = ""
    windows: tuple[tuple[float, float], ...] = ()
    looked_to: float = inf

    @property
    def exact(self) -> bool:
        """Whether there is a limit, and it is one value."""
        return self.dt is not None and self.certainty != "between"

    @property
    def stable_steps(self) -> StableSteps:
        """Which dts are stable; the reason says up to where one has looked.

        >>> Limit(0.02).stable_steps, Limit(None, "stable at any dt").stable_steps
        ('up to a limit', 'any')
        """
        if self.dt is not None:
            return "up to a limit"
        if self.reason.startswith(("unstable at any dt", "no stable step")):
            return "none"
        return "any" if self.reason.startswith(("stable at any dt", "nothing moves")) else "unknown"

    @property
    def remark(self) -> str:
        """What there is to say besides the value, in a few words; empty where there is nothing."""
        words = [word for word in (self.reason, self.note) if word]
        if self.certainty == "between" and self.dt is not None and self.at_most is not None:
            words.append(f"between {self.dt:.6g} and {self.at_most:.6g} s")
        words += [f"stable again {self._window(*window)}" for window in self.windows]
        return "; ".join(words)

    def _window(self, low: float, high: float) -> str:
        if high < self.looked_to:
            return f"from {low:.4g} to {high:.4g} s"
        return f"from {low:.4g} s on" + ("" if isinf(high) else f", looked at up to {high:.4g} s")
