"""Strings over time, and their energies: solid is measured, dotted predicted for small swings."""

from __future__ import annotations

import numpy as np
import pytest

from experiments.less_damping import DRAGS, DURATION, TIMES
from report.figures import look
from tests.experiments.canned.less_damping import MASS, START
from tests.experiments.canned.reading import records
from tests.report.figures.artists import data, marks, out_of_sight, text, tick_labels
from tests.report.figures.shown import result, shown


def test_solid_lines_are_the_energies_of_the_table_and_dotted_the_predicted_decay() -> None:
    """E0 exp(-t Cd/m), from the same start, one for each drag."""
    *_, axes = shown("less_damping").figure.axes
    table = records(result("less_damping"), "less_damping_over_time")
    solid, dotted = marks(axes, linestyle="-"), marks(axes, linestyle=":")
    for i, drag in enumerate(DRAGS):
        times, energies = data(solid[i])
        rows = [row for row in table if row["drag [N s/m]"] == drag]
        assert times[::10] == [row["time [s]"] for row in rows]
        assert energies[::10] == [row["energy above rest [J]"] for row in rows]
        assert (solid[i].get_color(), solid[i].get_marker()) == tuple(look(i).values())
        times, energies = data(dotted[i])
        assert energies == pytest.approx(START * np.exp(-np.array(times) * drag / MASS))
        label = text(axes, f"{drag:g} N s/m")
        assert label.xy == (times[-1], data(solid[i])[1][-1])


def test_stars_are_where_1_e_is_measured() -> None:
    """One for each run that is long enough, at its time and at 1/e of the energy at the start."""
    *_, axes = shown("less_damping").figure.axes
    stars = [data(line) for line in axes.lines if line.get_marker() == "*" and line.get_linestyle() == "None"]
    times = [row["falls to 1/e at, measured [s]"] for row in records(result("less_damping"))]
    assert [x for (x,), _ in stars] == [time for time in times if time is not None]
    assert [y for _, (y,) in stars] == pytest.approx([START / np.e] * len(stars))


def test_axes_have_units_and_the_title_says_what_is_dotted() -> None:
    """Energies on a logarithm."""
    *_, axes = shown("less_damping").figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time [s]", "energy above rest [J]")
    assert axes.get_yscale() == "log"
    assert axes.get_title(loc="left") == (
        "Measured (star: fallen to 1/e), and predicted for small swings (dotted): exp(-t Cd/m)"
    )
    assert axes.get_xlim()[0] == 0


def test_a_row_of_the_film_for_each_drag_in_its_colour() -> None:
    """At the times that are written under it."""
    *rows, _ = shown("less_damping").figure.axes
    for i, (row, drag) in enumerate(zip(rows, DRAGS, strict=True)):
        assert row.get_title(loc="left") == f"drag {drag:g} N s/m"
        assert len(marks(row, color=look(i)["color"])) == len(TIMES)
        assert [*tick_labels(row.xaxis).values()] == [f"{time:g} s" for time in TIMES]
        assert out_of_sight(row) == []
        bottom, top = row.get_ylim()
        assert 0 < top < 0.5 < -bottom < 2  # a metre of string hangs from the anchor at 0


def test_the_words_for_it_have_what_is_left() -> None:
    """Of the energy, by drag."""
    for row in records(result("less_damping")):
        part = (
            f"with drag {row['drag [N s/m]']:g} N s/m {row['left [1]']:.1e} of the energy is left after {DURATION:g} s"
        )
        assert part in shown("less_damping").alt
