"""First-order instability: growth predicted, measured on the string at rest and on the swinging one, each its own."""

from __future__ import annotations

import math

import pytest

from experiments.first_order_instability import DRAG, DT, DURATION
from tests.experiments.canned import first_order_instability
from tests.experiments.canned.first_order_instability import GROWTH
from tests.experiments.canned.reading import finding, in_order, numbers, records


def test_the_table_has_each_growth_in_its_column() -> None:
    """Less one; tenfold where it grows; how far it is from the true motion in the end."""
    euler, heun = records(first_order_instability.usual())
    columns = [name for name in euler if name.endswith("[1]")]
    for row, name in ((euler, "euler"), (heun, "heun")):
        predicted, undamped, *measured = GROWTH[name]
        expected = [None if growth is None else growth - 1 for growth in (predicted, *measured, undamped)]
        assert [row[column] for column in columns] == expected
    assert euler["predicted: tenfold in [s]"] == pytest.approx(DT * math.log(10) / math.log(GROWTH["euler"][0]))
    assert heun["predicted: tenfold in [s]"] is None
    distance = f"distance from the true motion at {DURATION:g} s [m]"
    assert (euler[distance], heun[distance]) == pytest.approx((2.0, 3e-4))


def test_sentences_have_predicted_then_measured() -> None:
    """Of Euler that it grows tenfold, and how it grew on the swinging string; of Heun that it dies away."""
    predicted, _, at_rest, swinging = GROWTH["euler"]
    seconds = DT * math.log(10) / math.log(predicted)
    said = finding(first_order_instability.usual(), "euler is predicted")
    assert numbers(said) == pytest.approx([predicted, seconds, at_rest, swinging], rel=0.05)
    assert in_order(said, "predicted", f"{predicted:.5f}", "measured", f"{at_rest:.5f}")
    heun = finding(first_order_instability.usual(), "heun is predicted")
    assert numbers(heun) == pytest.approx([GROWTH["heun"][0], GROWTH["heun"][2]])
    assert "dies away" in heun


def test_what_is_stable_by_its_drag_alone_is_said_to_be() -> None:
    """Heun, and by how much it would grow without: that joins it to the stability limits. Of Euler there is nothing."""
    undamped = GROWTH["heun"][1]
    said = finding(first_order_instability.usual(), "by the drag alone")
    assert said.startswith("heun ")
    assert numbers(said) == pytest.approx([undamped, DT * math.log(10) / math.log(undamped)], rel=0.05)


def test_the_last_sentence_has_the_distances_in_the_end() -> None:
    """Each after its name."""
    said = finding(first_order_instability.usual(), "distances from the true motion")
    assert numbers(said) == pytest.approx([DT, DRAG, DURATION, 2.0, 3e-4])
    assert in_order(said, "euler 2 m", "heun 0.0003 m")
