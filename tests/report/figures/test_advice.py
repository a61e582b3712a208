"""Limits beside the scene's own dt: a black bar is predicted, a dot measured, with what happens at the scene's dt."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from report.figures import COLOURS, draw
from tests.experiments.canned import advice
from tests.experiments.canned.advice import DONE, FOUND, SETUP
from tests.experiments.canned.reading import records
from tests.report.figures.artists import data, laid_out, marks, text, tick_labels, verticals, words
from tests.report.figures.shown import result, shown


def test_bars_are_predicted_and_dots_measured() -> None:
    """As the table has them, in the row of their engine; who cannot take the scene has none."""
    axes = shown("advice").figure.axes[0]
    table = {row["engine"]: row for row in records(result("advice"))}
    rows = tick_labels(axes.yaxis)
    assert set(rows.values()) == {a.engine for a in FOUND} - {"mujoco_flex"}
    bars, dots = marks(axes, marker="", linestyle="-"), marks(axes, marker="o", fillstyle="full")
    for drawn, column in ((bars, "predicted limit [s]"), (dots, "measured limit [s]")):
        found = {rows[round(sum(data(line)[1]) / len(data(line)[1]))]: data(line)[0][0] for line in drawn}
        assert found == {name: table[name][column] for name in rows.values() if table[name][column] is not None}
    assert {bar.get_color() for bar in bars} == {COLOURS[6]}
    assert {dot.get_color() for dot in dots} == {COLOURS[1]}
    assert axes.get_xlabel() == "largest stable dt [s]: predicted (bar), measured (dot)"
    assert shown("advice").figure.get_figheight() > 0.3 * len(rows) + 1


def test_rows_are_in_the_order_of_the_measured_limits() -> None:
    """Those without one first."""
    names = [*tick_labels(shown("advice").figure.axes[0].yaxis).values()]
    assert names[2:] == ["pymunk_springs", "bullet_softbody", "mujoco_tendons", "mujoco_cable"]


def test_the_scenes_own_dt_is_a_line_with_its_number() -> None:
    """Dashed, in its colour, in seconds."""
    axes = shown("advice").figure.axes[0]
    assert verticals(axes) == [SETUP.dt]
    said = text(axes, "the scene's dt")
    assert said.get_text().strip() == "the scene's dt, 0.001 s"
    assert said.get_position()[0] == SETUP.dt
    (line,) = [line for line in axes.lines if line.get_linestyle() == "--"]
    assert line.get_color() == said.get_color() == COLOURS[0]
    assert axes.get_xscale() == "log"


def test_what_happens_stands_beside_the_row() -> None:
    """Measured, and in the words of the outcome: a crash is no blow-up."""
    axes = shown("advice").figure.axes[0]
    rows = {name: place for place, name in tick_labels(axes.yaxis).items()}
    said = {t.get_position()[1]: t.get_text() for t in axes.texts[1:]}
    assert {name: said[place] for name, place in rows.items()} == {
        "exudyn_springs": "limit not measured",
        "Segfaults": "crashes; limit not measured",
        "pymunk_springs": "blows up; dt is 1.82 times the limit",
        "bullet_softbody": "stable, margin 1.05",
        "mujoco_tendons": "stable, margin 4.40",
        "mujoco_cable": "stable, margin 41.00",
    }


def test_a_short_scene_that_ends_well_beyond_the_limit_is_not_said_to_blow_up() -> None:
    """It did not; its dt is beyond the limit."""
    lucky = replace(advice.TOO_LONG, own=DONE)
    said = words(draw("advice", advice.only(lucky)).figure.axes[0])
    assert said[1:] == ["dt is 1.82 times the limit"]


def test_the_words_for_it_have_the_measured_limits() -> None:
    """With what happens."""
    alt = shown("advice").alt
    assert "mujoco_tendons 0.0044 s, stable, margin 4.40" in alt
    assert "scene's dt of 0.001 s" in alt
    assert "of no engine" in shown("advice", "nobody").alt


def test_numbers_over_many_decades_are_powers_of_ten() -> None:
    """1, 2 and 5 of each would run into one another."""
    wide = replace(advice.STABLE, measured=replace(advice.STABLE.measured, dt=5.0))
    figure = laid_out(draw("advice", advice.only(wide)).figure)
    labels = tick_labels(figure.axes[0].xaxis)
    assert 1.0 in labels
    assert 2.0 not in labels
    few = tick_labels(laid_out(shown("advice").figure).axes[0].xaxis)
    for axes, largest in ((figure.axes[0], 5.0), (shown("advice").figure.axes[0], 0.041)):
        left, right = axes.get_xlim()
        assert right > 3.9 * largest
        assert np.log(right / largest) > 0.25 * np.log(right / left)  # for the words beside the last dot
        assert not any(line.get_visible() for line in axes.get_ygridlines())
    assert few[0.002] == "0.002"
    assert min(few) >= 0.55e-3 / 4 == pytest.approx(1.375e-4)
