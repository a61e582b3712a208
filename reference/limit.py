"""A stability limit: the one form it has, predicted or measured. Needs NumPy only."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Limit:
    """Up to which dt perturbations do not grow.

    Attributes:
        dt: the limit [s]; None where there is none.
        reason: why there is none; empty where there is one.
        growth: where perturbations grow at any dt, how much they do in a step of a tenth of the fastest mode's 1/w.
        factors: the growth factors of the step just below and just above the limit, where they were looked at.
        grows_beyond: whether perturbations were seen to grow beyond the limit; None where that was not looked at.
    """

    dt: float | None
    reason: str = ""
    growth: float | None = None
    factors: tuple[float, float] | None = None
    grows_beyond: bool | None = None
