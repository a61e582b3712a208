"""Where a statement about a number turns from false to true, by halving. Needs nothing."""

from __future__ import annotations

from collections.abc import Callable


def bisect(
    beyond: Callable[[float], bool], low: float, high: float, near: Callable[[float, float], bool]
) -> tuple[float, float]:
    """A number of which it is false and one of which it is true, near to one another.

    >>> bisect(lambda x: x * x > 2, 1.0, 2.0, lambda low, high: high - low < 0.1)
    (1.375, 1.4375)

    Args:
        beyond: the statement.
        low: a number of which it is false.
        high: a number of which it is true.
        near: whether the two are near enough.
    """
    while not near(low, high):
        middle = (low + high) / 2
        low, high = (low, middle) if beyond(middle) else (middle, high)
    return low, high
