"""A row of a film: every frame has the motion at its time, moved by as much as the frames are apart."""

from __future__ import annotations

import numpy as np
import pytest

from report.figures import new_figure
from report.figures.filmstrip import Strip, draw_row
from tests.experiments.canned.motions import turning
from tests.report.figures.artists import data, marks, tick_labels, verticals

TIMES, FRAME = (0.0, 0.5, 2.0), (1.5, 2.0, 0.4)


def test_each_frame_has_the_motion_at_its_time() -> None:
    """The nearest one; none after the motion has ended; the anchor in the middle of each; not stretched."""
    motion = turning(np.linspace(0, 1, 11), rate=1.0)
    _, axes = new_figure((6, 2))
    draw_row(axes, [Strip(motion, {"color": "#123456"})], TIMES, FRAME)
    strings = marks(axes, color="#123456")
    assert len(strings) == 2
    for i, (string, time) in enumerate(zip(strings, TIMES, strict=False)):
        along = np.linspace(0, 1.2, 5)
        expected = np.array([3.0 * i + along * np.cos(time), -along * np.sin(time)])
        assert np.array(data(string)) == pytest.approx(expected, abs=1e-12)
    assert [data(anchor) for anchor in marks(axes, marker="v")] == [([3.0 * i], [0.0]) for i in range(3)]
    assert verticals(axes) == [1.5, 4.5]
    assert tick_labels(axes.xaxis) == {0.0: "0 s", 3.0: "0.5 s", 6.0: "2 s"}
    assert (axes.get_xlim(), axes.get_ylim()) == ((-1.5, 7.5), (-2.0, 0.4))
    assert axes.get_aspect() == 1.0
    assert not any(line.get_visible() for line in axes.get_xgridlines())


def test_what_leaves_its_frame_is_cut_off() -> None:
    """Each string at the window of its own frame."""
    _, axes = new_figure((6, 2))
    draw_row(axes, [Strip(turning(np.linspace(0, 1, 11), rate=1.0), {"color": "#123456"})], TIMES[:2], FRAME)
    for i, string in enumerate(marks(axes, color="#123456")):
        window = axes.transData.inverted().transform(string.get_clip_box().get_points())
        assert window == pytest.approx(np.array([[3.0 * i - 1.5, -2.0], [3.0 * i + 1.5, 0.4]]))
