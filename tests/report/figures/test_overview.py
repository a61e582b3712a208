"""The first figure: full dots are measured distances from the true motion, rings what is left once it is identified."""

from __future__ import annotations

import pytest

from report.figures import COLOURS
from report.figures.overview import NOTHING, ROUNDING, Explained, draw
from tests.report.figures.artists import (
    cut_off,
    data,
    laid_out,
    marks,
    odd_measures,
    out_of_sight,
    overlaps,
    text,
    tick_labels,
    unlabelled,
    words,
)

ENGINES = [
    Explained("pymunk_springs", "drift_kick", 4e-3, 2e-15),
    Explained("mujoco_cable", "pendulum_kick_drift", 40.0, 8e-15),
    Explained("stranger", None, 1e-8, 3e-7),
    Explained("exact", "rk4", 2e-8, 0.0),
]


def test_rows_are_the_engines_the_farthest_first_with_both_distances() -> None:
    """A dot is measured, a ring identified; the row's name says as what; no distance at all is at `none`."""
    axes = draw(ENGINES).figure.axes[0]
    dots, rings = marks(axes, marker="o", fillstyle="full"), marks(axes, marker="o", fillstyle="none")
    assert [data(dot) for dot in dots] == [([40.0], [0]), ([4e-3], [1]), ([2e-8], [2]), ([1e-8], [3])]
    assert [data(ring) for ring in rings] == [([8e-15], [0]), ([2e-15], [1]), ([NOTHING], [2]), ([3e-7], [3])]
    assert {dot.get_color() for dot in dots} == {COLOURS[1]} != {ring.get_color() for ring in rings} == {COLOURS[0]}
    assert [*tick_labels(axes.yaxis).values()] == [
        "mujoco_cable = pendulum_kick_drift",
        "pymunk_springs = drift_kick",
        "exact = rk4",
        "stranger = not identified",
    ]
    assert tick_labels(axes.xaxis)[NOTHING] == "none"
    joined = [data(line) for line in marks(axes, marker="None")]
    assert joined[1] == ([2e-15, 4e-3], [1, 1])


def test_words_have_the_colours_of_what_they_name() -> None:
    """Measured is above the dots, at the right; identified above the rings; rounding where it is shaded."""
    axes = draw(ENGINES).figure.axes[0]
    measured, identified = text(axes, "measured"), text(axes, "identified")
    assert (measured.get_color(), identified.get_color()) == (COLOURS[1], COLOURS[0])
    assert measured.get_position()[0] > 1 > 1e-15 > identified.get_position()[0]
    (shaded,) = axes.patches
    assert shaded.get_x() + shaded.get_width() == pytest.approx(ROUNDING)
    assert text(axes, "rounding").get_position()[0] < ROUNDING
    assert axes.get_xlabel() == "largest distance of any mass within half a second [m]"
    assert axes.get_xscale() == "log"


def test_known_lengths_are_where_they_are() -> None:
    """On an axis above, which goes with the one below."""
    axes = draw(ENGINES).figure.axes[0]
    (above,) = axes.child_axes
    assert not above.spines["top"].get_visible()
    shown = dict(zip(above.get_xticks(), (label.get_text() for label in above.get_xticklabels()), strict=True))
    assert shown == {1e-3: "1 mm", 1e-6: "1 µm", 1e-10: "an atom", 1e-15: "a proton"}


def test_all_of_it_can_be_seen() -> None:
    """Also what is farther away than the axis goes by itself."""
    figure = laid_out(draw(ENGINES).figure)
    assert (
        unlabelled(figure)
        == overlaps(figure)
        == odd_measures(figure)
        == cut_off(figure)
        == out_of_sight(figure.axes[0])
        == []
    )


def test_without_a_scheme_there_is_no_word_of_one() -> None:
    """Only what is measured, in the words that stand for it, too."""
    picture = draw(ENGINES[2:3])
    assert not [said for said in words(picture.figure.axes[0]) if "identified" in said]
    assert "stranger 1.0e-08 m from the true motion, not identified" in picture.alt
    assert "mujoco_cable 4.0e+01 m from the true motion and 8.0e-15 m from pendulum_kick_drift" in draw(ENGINES).alt
