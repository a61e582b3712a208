"""Errata: remarks with their numbers, and sentences of the right ones."""

from __future__ import annotations

import numpy as np
import pytest

from experiments.errata import result_of, stability_remark
from reference.limit import Limit
from tests.experiments.canned import errata
from tests.experiments.canned.errata import LIMITS, ORDERS
from tests.experiments.canned.reading import finding, in_order, numbers, records

ANGLES = np.zeros(1)


def test_the_table_has_the_remarks() -> None:
    """Each number beside what it is of, with its unit."""
    table = {row["measured"]: row for row in records(errata.usual())}
    for name, (_, order) in ORDERS.items():
        assert table[f"order of {name}"]["value"] == order
    limit = table["largest stable dt, heun_link_by_link"]
    assert (limit["value"], limit["unit"], limit["slide"]) == (LIMITS[1], "s", "7-11")


def test_the_sentences_have_the_order_link_by_link_then_heuns() -> None:
    """And how many times the stable dt is larger."""
    said = finding(errata.usual(), "What the slide warns of")
    assert numbers(said) == pytest.approx([ORDERS["heun_link_by_link"][1], ORDERS["heun"][1], LIMITS[1] / LIMITS[0]])
    assert in_order(said, "link by link has order 1.00", "Heun has 2.00")
    assert numbers(finding(errata.usual(), "better than its heading")) == [11, 0, 7]


def test_without_a_limit_it_is_growth_that_is_told() -> None:
    """No largest stable dt of 0."""
    limited = stability_remark("heun", Limit(0.25))
    assert limited == ("largest stable dt, heun", 0.25, "s")
    said, value, unit = stability_remark("euler", Limit(None, "unstable at any dt: grows by 0.02 in a step", 0.02))
    assert said == "growth in a step of euler, unstable at any dt: grows by 0.02 in a step"
    assert (value, unit) == (0.02, "1")


@pytest.mark.parametrize("name", ["heun", "heun_link_by_link"])
def test_where_one_has_no_limit_nothing_is_said_of_it(name: str) -> None:
    """Then there is nothing to compare with."""
    (table,) = errata.usual().tables
    kept = [row for row in table.rows if row[2] != f"largest stable dt, {name}"]
    assert len(kept) == len(table.rows) - 1
    assert "stable" not in finding(result_of(kept, {}, (ANGLES, ANGLES, ANGLES)), "What the slide warns of")  # type: ignore[arg-type]
