"""Where a step is stable again above its first limit: the windows, found by looking at S(h) of a small system.

Only where a step's damping grows faster than dt does S(h) come back (`definite`): a spring that is damped by
exp(-h c/m) in a step is held by it once h is long. Between dts that are looked at a narrow window may be missed; of
systems of more than MOST coordinates none are looked for, nor where the damping of a step drowns all else in rounding.
"""

from __future__ import annotations

import numpy as np

from reference.bisection import bisect
from reference.errors import SolverError
from reference.state import Array
from reference.theory.definite import Definiteness
from reference.theory.inertia import negative_eigenvalues
from reference.theory.strong_damping import drowned_from

#: The largest system, in coordinates, that is looked at; how many dts, and up to how many times the first limit.
MOST, LOOKS, FAR = 120, 120, 1e3

#: The ends of a window are found to this part of themselves.
PRECISION = 1e-7


def looked_to(definite: Definiteness, first: float) -> float:
    """Up to which dt [s] windows are looked for above the first limit."""
    return min(FAR * first, drowned_from(definite))


def windows_of(definite: Definiteness, first: float) -> tuple[tuple[float, float], ...]:
    """The intervals of dt [s] above the first limit in which S is not negative again, as far as is looked."""
    if definite.in_proportion or len(definite.linear.mass) > MOST:
        return ()

    def stable(dt: float, part: tuple[Array, Array] | None = None) -> bool:
        with np.errstate(all="ignore"):
            matrix = definite.matrix(dt, part)
            return bool(np.isfinite(matrix).all()) and negative_eigenvalues(matrix) == 0

    begin, last = (1 + 1e-6) * first, looked_to(definite, first)
    last = min(last, definite.negative_damping_from(last))
    if last <= begin:
        return ()
    steps = np.geomspace(begin, last, LOOKS)
    try:
        with np.errstate(all="ignore"):
            parts = definite.damping_parts(steps)
    except SolverError:
        return ()
    seen = [stable(float(dt), part) for dt, part in zip(steps, parts, strict=True)]
    found: list[tuple[float, float]] = []
    for before, after, was, now in zip(steps[:-1], steps[1:], seen[:-1], seen[1:], strict=True):
        if now and not was:
            _, low = bisect(stable, float(before), float(after), _near)
            found.append((low, last))
        if was and not now and found:
            high, _ = bisect(lambda dt: not stable(dt), float(before), float(after), _near)
            found[-1] = (found[-1][0], high)
    return tuple(found)


def _near(low: float, high: float) -> bool:
    return high - low <= PRECISION * high
