"""Labels beside lines: in the order of the lines, none over another, each joined to its line's end."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from report.figures import COLOURS, new_figure
from report.figures.labels import End, gathered, label_ends, spread

boxes = st.lists(st.tuples(st.floats(-0.5, 1.5), st.floats(0.01, 0.1)), min_size=1, max_size=9)


@given(boxes)
@settings(deadline=None)
def test_boxes_keep_their_order_and_are_not_over_one_another(boxes: list[tuple[float, float]]) -> None:
    """Between 0 and 1, to rounding: their sizes add up to less."""
    heights, sizes = np.array(boxes).T
    middles = spread(heights, sizes)
    order = np.argsort(heights, kind="stable")
    tops, bottoms = (middles + sizes / 2)[order], (middles - sizes / 2)[order]
    assert (bottoms[1:] >= tops[:-1] - 1e-12).all()
    assert bottoms[0] >= -1e-12
    assert tops[-1] <= 1 + 1e-12


def test_boxes_that_have_room_stay_where_they_are() -> None:
    """Moved by nothing; of two at one height one goes up and one down by as much."""
    assert spread(np.array([0.8, 0.2]), np.array([0.1, 0.1])) == pytest.approx([0.8, 0.2])
    assert spread(np.array([0.5, 0.5]), np.array([0.1, 0.1])) == pytest.approx([0.45, 0.55])


def test_boxes_at_the_same_height_stand_in_their_order() -> None:
    """Ten at each of two heights, upwards by their numbers."""
    middles = spread(np.repeat([0.9, 0.1], 10), np.full(20, 0.04))
    assert (np.diff(middles[:10]) > 0).all()
    assert (np.diff(middles[10:]) > 0).all()
    assert middles[:10].min() > middles[10:].max()


def test_heights_that_are_near_are_gathered() -> None:
    """From one to the next; upwards, and among themselves in their order."""
    assert gathered(np.array([0.51, 0.9, 0.5, 0.505]), 0.02) == [[0, 2, 3], [1]]
    assert gathered(np.array([0.51, 0.9]), 0.001) == [[0], [1]]


def test_each_label_is_joined_to_its_end() -> None:
    """Beside the axes, upwards as the ends are; those that end together have one label, grey for two colours."""
    _, axes = new_figure((4, 4))
    ends = [End(1.0, 0.9, "high", COLOURS[0]), End(1.0, 0.1, "low", COLOURS[1]), End(1.0, 0.101, "too", COLOURS[2])]
    label_ends(axes, ends, line=0.05)
    high, low, too = axes.texts
    assert [text.get_text() for text in axes.texts] == ["high", "low", "too"]
    assert [text.xy for text in axes.texts] == [(1.0, 0.9), (1.0, 0.1), (1.0, 0.101)]
    assert high.get_position()[1] > too.get_position()[1] > low.get_position()[1]
    assert all(text.get_position()[0] > 1 and text.anncoords == "axes fraction" for text in axes.texts)
    assert [text.arrowprops["color"] for text in axes.texts] == list(COLOURS[:3])
    assert {text.arrowprops["relpos"] for text in axes.texts} == {(0, 0.5)}  # from the middle of its left border
    label_ends(axes, ends, line=0.05, together=0.01)
    assert [(text.get_text(), text.arrowprops["color"]) for text in axes.texts[3:]] == [
        ("low\ntoo", "#777777"),
        ("high", COLOURS[0]),
    ]


def test_ends_in_one_label_are_joined_at_the_first() -> None:
    """In its colour where all have that; beside the axes, too, where the end is not in them."""
    _, axes = new_figure((4, 4))
    ends = [
        End(0.9, 0.101, "first", COLOURS[1]),
        End(1.0, 0.1, "second", COLOURS[1]),
        End(1.0, 0.8, "high", COLOURS[0]),
    ]
    label_ends(axes, ends, line=0.05, together=0.01)
    one, _ = axes.texts
    assert (one.get_text(), one.xy, one.arrowprops["color"]) == ("first\nsecond", (0.9, 0.101), COLOURS[1])
    assert one.get_annotation_clip() is False
    label_ends(axes, [], line=0.05)
    assert len(axes.texts) == 2
