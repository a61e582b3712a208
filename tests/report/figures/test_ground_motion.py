"""How far a bridge sways by frequency, and how a truck that crosses takes its middle off the influence line."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_hex

from experiments.ground_motion import DT, SPEEDS, SWEEP, peak
from report.figures import COLOURS, MARKERS, look
from report.figures.ground_motion import crests
from tests.experiments.canned.ground_motion import HIGH, LINE, NATURAL, SWING, sway
from tests.experiments.canned.reading import records
from tests.report.figures.artists import data, legend, line, lines, looks, text, verticals
from tests.report.figures.shown import result, shown


def shaken() -> Axes:
    """By frequency."""
    return shown("ground_motion").figure.axes[0]


def crossed() -> Axes:
    """By the truck's position."""
    return shown("ground_motion").figure.axes[1]


def test_crests_are_the_largest_of_each_half_swing() -> None:
    """Twice in each swing, to a step; the ends are none."""
    found = crests(sway(1.3, 1.0))
    assert np.diff(found) == pytest.approx(np.full(len(found) - 1, SWING / 2), abs=2)
    assert crests(np.array([3.0, 1.0, 2.0, 1.0, 5.0])).tolist() == [2]


def test_lines_are_the_crests_in_millimetres_at_the_sweeps_frequency() -> None:
    """Each stepper's in its look, the linear bridge's dotted and predicted."""
    assert [*legend(shaken())] == ["linear bridge, predicted", "kick_drift", "mujoco_tendons"]
    motions = {"linear bridge, predicted": sway(1.31, HIGH)}
    motions |= {name: ran.shaken for name, ran in result("ground_motion").data["rows"].items()}
    for label, motion in motions.items():
        frequencies, heights = data(line(shaken(), label))
        at = crests(motion)
        assert frequencies == pytest.approx(SWEEP.frequency(at * DT))
        assert heights == pytest.approx(1e3 * np.abs(motion[at]))
    assert line(shaken(), "linear bridge, predicted").get_linestyle() == ":"
    assert shaken().get_ylim() == (0, pytest.approx(1.5e3 * max(np.abs(motion).max() for motion in motions.values())))
    for i, name in enumerate(result("ground_motion").data["rows"]):
        assert line(shaken(), name).get_color() == look(i)["color"]


def test_the_natural_frequency_is_where_it_is() -> None:
    """With its number above."""
    assert verticals(shaken()) == [NATURAL]
    said = text(shaken(), "natural frequency, predicted")
    assert said.get_text().endswith(f"{NATURAL:.2f} Hz")
    assert said.get_position()[0] == NATURAL


def test_lines_of_the_truck_are_sags_in_millimetres_at_its_position() -> None:
    """A colour for each speed, all steppers in it; the influence line dotted; downwards is down."""
    influence = line(crossed(), "influence line: it stands there, predicted")
    assert data(influence) == (LINE[0].tolist(), pytest.approx(1e3 * LINE[1]))
    assert influence.get_linestyle() == ":"
    rows = result("ground_motion").data["rows"]
    for i, speed in enumerate(SPEEDS):
        found = [drawn for drawn in lines(crossed()) if looks(drawn)[:2] == (to_hex(COLOURS[i]), MARKERS[i])]
        for drawn, ran in zip(found, rows.values(), strict=True):
            places, sags = data(drawn)
            assert sags == pytest.approx(1e3 * ran.crossed[speed])
            assert places == pytest.approx(speed * DT * np.arange(len(sags)))
        assert found[0].get_label() == f"crosses at {speed:g} m/s, {len(rows)} steppers"
        each = [drawn.get_markevery() for drawn in found]
        assert len(set(each)) == len(each)  # their markers are not over one another
        assert all(0 <= first < every < len(sags) for first, every in each)  # and each has some
    bottom, top = crossed().get_ylim()
    assert bottom > top


def test_axes_have_units() -> None:
    """Hertz, metres, millimetres."""
    assert shaken().get_xlabel() == "frequency of the ground [Hz]"
    assert shaken().get_ylabel() == "amplitude of the sway of the middle [mm]"
    assert crossed().get_xlabel() == "position of the truck [m]"
    assert crossed().get_ylabel() == "sag of the middle [mm]"


def test_the_words_for_it_have_peaks_and_distances() -> None:
    """Predicted and measured; off the line as parts of the largest sag."""
    alt = shown("ground_motion").alt
    assert f"predicted at {peak(sway(1.31, HIGH))[0]:.2f} Hz, by 10 mm; " in alt
    for row in records(result("ground_motion")):
        assert f"{row['stepper']} at {row['sways most at [Hz]']:.2f} Hz, by {1e3 * row['by [m]']:.0f} mm" in alt
    assert "predicted: 1.22 Hz" in alt
    assert "kick_drift at 40 m/s: 20 %" in alt
