"""What is said of stability limits is made from the numbers. The limits themselves: tests/experiments/limits."""

from __future__ import annotations

from experiments.limits.limit_rows import Row
from experiments.stability import result_of
from reference.limit import Limit
from reference.scenes import find


def row(stepper: str, measured: Limit, predicted: Limit | None = None) -> Row:
    """A stepper on a small string, predicted to be stable up to 10 ms."""
    return Row(stepper, "engine", find("string").system({"masses": 2}), predicted or Limit(0.01), measured)


def test_the_table_has_an_engines_growth_factors_in_their_order() -> None:
    """Below the limit, then above it; empty where its step was not looked at."""
    (table,) = result_of([row("seen", Limit(0.01, factors=(0.9, 1.2))), row("unseen", Limit(0.01))]).tables
    assert table.columns[-2:] == ["engine's own growth factor at 0.99 of it", "at 1.01"]
    assert [cells[-2:] for cells in table.rows] == [[0.9, 1.2], [None, None]]
