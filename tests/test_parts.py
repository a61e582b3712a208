"""Long lists that are checked in parts: after as many days as there are parts all have been checked."""

from __future__ import annotations

import pytest

from tests.parts import PARTS, kept


@pytest.mark.parametrize("every", [1, 2, 3, 4, PARTS])
def test_every_case_that_rotates_comes_round(every: int) -> None:
    """And is run every n-th day, but for where the parts begin again."""
    cases = range(3 * every)
    days = [[case for case in cases if kept(case, every, number)] for number in range(PARTS)]
    assert sorted({case for day in days for case in day}) == list(cases)
    assert {len(day) for day in days} == {3}
