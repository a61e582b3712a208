"""Maps: the part of the plane that is predicted unstable is not the part where measurement and prediction agree."""

from __future__ import annotations

import pytest

from tests.experiments.canned import maps
from tests.experiments.canned.reading import finding, numbers, records


def test_the_table_has_both_parts_in_their_columns() -> None:
    """Half is predicted unstable; of the last a quarter is on the wrong side, to one of 40 columns."""
    heun, rk4, pymunk = records(maps.usual())
    assert (heun["stepper"], heun["dt and"], heun["runs"], heun["predicted by"]) == ("heun", "drag", 400, "heun")
    assert (rk4["dt and"], pymunk["dt and"]) == ("damping", "damping")
    parts = [row["part predicted unstable [1]"] for row in (heun, rk4, pymunk)]
    assert parts == pytest.approx([0.5, 0.5, 0.5], abs=0.025)
    agree = [row["part that agrees [1]"] for row in (heun, rk4, pymunk)]
    assert agree == pytest.approx([1.0, 1.0, 0.75], abs=0.025)


def test_each_sentence_has_the_part_that_agrees() -> None:
    """In percent, of its runs."""
    for row in records(maps.usual()):
        said = numbers(finding(maps.usual(), f"{row['stepper']}, dt and {row['dt and']}: "))
        assert said == pytest.approx([row["runs"], 100 * row["part that agrees [1]"]], abs=0.05)
