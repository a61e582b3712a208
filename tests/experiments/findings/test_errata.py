"""Errata: remarks with their numbers, and sentences of the right ones."""

from __future__ import annotations

import pytest

from tests.experiments.canned import errata
from tests.experiments.canned.errata import LIMITS, ORDERS
from tests.experiments.canned.reading import finding, in_order, numbers, records


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
