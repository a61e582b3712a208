"""Bisection: what it leaves is a border of the statement, wherever that is, after as many questions as halvings."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from reference.bisection import bisect
from tests.reference.systems import property_test


@property_test
@given(border=st.floats(0.0, 1.0, exclude_max=True), halvings=st.integers(0, 40))
def test_the_border_lies_between_the_two_numbers(border: float, halvings: int) -> None:
    """False of the lower, true of the upper, and these are 2^-n apart after n questions."""
    asked = []

    def beyond(x: float) -> bool:
        asked.append(x)
        return x > border

    low, high = bisect(beyond, 0.0, 1.0, lambda low, high: high - low <= 2.0**-halvings)
    assert low <= border < high
    assert high - low == 2.0**-halvings
    assert len(asked) == halvings


def test_numbers_that_are_near_already_are_left_as_they_are() -> None:
    """Nothing is asked."""
    asked: list[float] = []
    assert bisect(lambda x: bool(asked.append(x)), 2.0, 3.0, lambda low, high: True) == (2.0, 3.0)
    assert asked == []
