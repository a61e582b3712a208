"""Stability, measured: a stepper is run from a small perturbation of rest, and the perturbation is watched.

Two ways, because steppers differ in what can be seen of them. An engine is perturbed at random, everywhere, and the
mean square of what is left is compared between the beginning and the end of the run: no reset, clamp or sleep hides
growth from so small a perturbation, and nothing of the theory goes in. A scheme can be perturbed along its
fastest-growing mode and watched in that mode alone, so that growth of a millionth in a step is seen in some hundred
steps (`theory.measured_mode`). Needs NumPy only.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.bisection import bisect
from reference.limit import Limit
from reference.state import Array

#: The size of a perturbation, as a part of the length it is to be small against.
PERTURBATION = 1e-6

#: How long a random perturbation is watched [steps].
STEPS = 1200

#: A perturbation that is this many times as large as at the start has grown, whatever stops it then.
GROWN = 100.0

#: The least growth in a step that is seen in that time: a doubling between its first and its last quarter.
SEEN = float(np.log(2) / (0.75 * STEPS))

#: How many times as long a run below a limit is: in it, growth is seen that is smaller by the same factor.
LONGER = 6

#: At these parts of an expected limit runs are made first: between them lies more than what is expected.
EXPECTED = (0.988, 1.013)


def random_growth(offsets: Array) -> float:
    """Growth in a step, from the mean squares of offsets in the first and the last quarter of a run.

    Args:
        offsets: distances from equilibrium [m], one row per step, the perturbation itself first. Where they are not
            finite, or GROWN times the perturbation, growth is infinite: what a nonlinear system does after that is
            another matter.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        power = np.square(offsets.reshape(len(offsets), -1)).mean(axis=1)
    if not power.max() <= GROWN**2 * power[0] < np.inf:
        return np.inf
    quarter = len(power) // 4
    first, last = power[:quarter].mean(), power[-quarter:].mean()
    return float(0.5 * np.log(last / first) / (0.75 * len(power))) if last > 0 else -np.inf


def mode_growth(offsets: Array, mode: Array) -> float:
    """Growth in a step, from a straight line through the logarithm of one mode's part in the offsets.

    It ends where nothing of the part is left; what does so at once has decayed whole.

    Args:
        offsets: state vectors, one row per step.
        mode: the left eigenvector that tells this mode from all others.
    """
    part = np.abs(offsets @ mode.conj())
    if not np.isfinite(part).all():
        return np.inf
    left = part[: np.argmin(part)] if part.min() == 0 else part
    if len(left) < 2:
        return -1.0
    slope = np.polynomial.Polynomial.fit(np.arange(len(left)), np.log(left), 1).convert().coef[1]
    return float(np.expm1(slope))


def measured_limit(
    growth: Callable[[float, int], float], dt: float, precision: float, expected: float | None = None
) -> Limit:
    """Up to which dt a random perturbation does not grow, by doubling, halving and bisection.

    Where it does not a little below an expected limit, and does a little above, the limit is looked for between the two
    only: that all grows slowly at any dt is then out of the question.

    Args:
        growth: of a dt [s] and a number of steps, as random_growth measures it.
        dt: about as long as the fastest mode lasts [s].
        precision: as a part of the limit.
        expected: the limit [s] of the scheme that this one was identified with.
    """

    def unstable(h: float) -> bool:
        return growth(h, STEPS) > SEEN

    def near(low: float, high: float) -> bool:
        return high - low <= precision * low

    if expected is not None:
        low, high = (part * expected for part in EXPECTED)
        if not unstable(low) and unstable(high):
            return Limit(bisect(unstable, low, high, near)[0])
    low, high = dt, dt
    while unstable(low):
        low, high = low / 2, low
        if low < 1e-6 * dt:
            return Limit(None, f"unstable at any dt that was tried, down to {low:.3g} s")
    while high <= low or not unstable(high):
        low, high = high, 2 * high
        if low > 50 * dt:
            return Limit(None, f"stable at any dt that was tried, up to {low:.3g} s")
    low, high = bisect(unstable, low, high, near)
    # Growth that goes as a power of dt is seen late. Below a true limit a longer run has none either.
    if growth(0.9 * low, LONGER * STEPS) > SEEN / LONGER:
        return Limit(None, f"unstable at any dt that was tried: in longer runs at {0.9 * low:.3g} s too")
    return Limit(low)
