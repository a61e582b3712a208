"""The first dt at which something grows: from a short step on, where growth in a step is known but for rounding."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from reference.bisection import bisect
from reference.limit import Limit

#: Each dt looked at is so many times the one before: in short steps, and in longer ones than a part of the fastest 1/w,
#: where a step may let a mode grow in a narrow range and be stable again.
RATIO, CLOSE, SHORT_STEP = 1.2, 1.04, 0.3

#: The search ends where perturbations grow still at so many times the step that it began with.
SHORTEST = 1e-4

#: Where decay is so many times what rounding may do, there is no question where it ends.
PLAIN = 100.0

#: So many times beyond a limit growth is PLAIN, unless it is the end of a growth that was hidden by rounding.
SOON = 1.1

#: Between the last decay and the first growth that are no rounding lies one value, if they are as near as this.
ONE_VALUE = 1e-2


@dataclass(frozen=True)
class Search:
    """What is looked at, dt by dt.

    Attributes:
        excess: by how much of itself the worst perturbation grows in a step of dt [s].
        rounding: how much of that may be rounding.
        precision: to this part of itself a limit is found.
        decays: whether every perturbation decays in steps that are short enough; else some only stay as they are.
    """

    excess: Callable[[float], float]
    rounding: Callable[[float], float]
    precision: float
    decays: bool

    def is_growth(self, dt: float) -> bool:
        """Whether perturbations are seen to grow."""
        return self.excess(dt) > self.rounding(dt)

    def is_no_decay(self, dt: float, times: float = 1.0) -> bool:
        """Whether they are not seen to decay, by so many times what rounding may do."""
        return not self.excess(dt) < -times * self.rounding(dt)

    def near(self, low: float, high: float) -> bool:
        """Whether two dts are one limit."""
        return high - low <= self.precision * low


def first_growth(search: Search, start: float, unit: float, last: float) -> Limit:
    """The first dt at which perturbations grow, from a short step on, each a little longer.

    Args:
        start: the short step [s]; where they grow there already, shorter ones are looked at first.
        unit: the fastest motion's 1/w [s].
        last: the longest dt to look at [s].
    """
    dt = start
    while search.is_growth(dt):
        dt /= 2 if start > 1e-2 * unit else 10
        if dt < SHORTEST * start:
            if search.decays:
                why = "in short ones all decays, by less than can be told"
                return Limit(None, f"not computed: growth is seen in steps down to {dt:.3g} s; {why}")
            return Limit(None, f"no stable step was found, down to {dt:.3g} s")
    while not search.is_growth(longer := dt * (RATIO if dt < SHORT_STEP * unit else CLOSE)):
        dt = longer
        if dt > last:
            return Limit(None, f"stable at any dt that was looked at, up to {dt:.3g} s")
    if search.decays:
        return _where_decay_ends(search, dt, longer)
    low, high = bisect(search.is_growth, dt, longer, search.near)
    if search.excess(SOON * high) < PLAIN * search.rounding(SOON * high):
        return Limit(None, hidden(high))
    return Limit((low + high) / 2)


def hidden(dt: float) -> str:
    """What is said where growth rises out of rounding slowly: it may have begun in steps that are far shorter."""
    return f"not computed: growth is seen at {dt:.3g} s; in shorter steps damping takes less than can be told"


def _where_decay_ends(search: Search, low: float, high: float) -> Limit:
    """Where all that decayed begins to grow: one value if rounding allows to tell, else two between which it is.

    Args:
        low: a dt [s] at which growth is not seen.
        high: one at which it is.
    """
    if search.is_no_decay(low, PLAIN):
        seen = low
        while search.is_no_decay(seen):
            seen /= RATIO
            if seen < SHORTEST * low:
                return Limit(None, hidden(high))
        low, _ = bisect(search.is_no_decay, seen, high, search.near)
        _, high = bisect(search.is_growth, low, high, search.near)
        if high > (1 + ONE_VALUE) * low:
            return Limit(low, at_most=high, certainty="between")
    low, high = bisect(lambda dt: search.excess(dt) > 0, low, high, search.near)
    return Limit((low + high) / 2)
