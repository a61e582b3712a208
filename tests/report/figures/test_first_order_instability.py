"""Strings over the true motion, distances with markers, the fastest mode thin, predicted growth dotted."""

from __future__ import annotations

import numpy as np
import pytest

from experiments.first_order_instability import DT, GROWING, TIMES
from report.figures import look
from tests.experiments.canned.first_order_instability import GROWTH
from tests.experiments.canned.reading import numbers, records
from tests.report.figures.artists import data, marks, text
from tests.report.figures.shown import result, shown


def test_lines_are_the_table() -> None:
    """Thick with markers the distance, thin its part in the fastest mode, in the scheme's colour; zero has no place."""
    *_, axes = shown("first_order_instability").figure.axes
    table = records(result("first_order_instability"), "first_order_instability_over_time")
    times = [row["time [s]"] for row in table]
    for i, name in enumerate(("euler", "heun")):
        thick, thin = marks(axes, color=look(i)["color"])
        assert thick.get_linewidth() > thin.get_linewidth()
        assert (thick.get_marker(), thin.get_marker()) == (look(i)["marker"], "None")
        for line, what in ((thick, "distance from the true motion"), (thin, "its fastest mode")):
            assert data(line)[0] == pytest.approx(times)
            column = np.array([row[f"{name}: {what} [m]"] for row in table])
            assert data(line)[1] == pytest.approx(np.where(column > 0, column, np.nan), nan_ok=True)
        assert text(axes, name).xy == (pytest.approx(times[-1]), data(thick)[1][-1])


def test_the_dotted_line_grows_as_predicted_where_the_mode_is_fitted() -> None:
    """Of Euler only; its factor in a step is said beside it."""
    *_, axes = shown("first_order_instability").figure.axes
    (dotted,) = marks(axes, linestyle=":")
    times, sizes = map(np.array, data(dotted))
    assert np.log(sizes[-1] / sizes[0]) / ((times[-1] - times[0]) / DT) == pytest.approx(np.log(GROWTH["euler"][0]))
    first_beyond = np.log(GROWING[1] / 1e-8) / np.log(GROWTH["euler"][0]) * DT
    assert times[-1] == pytest.approx(first_beyond, abs=2 * DT)
    note = text(axes, "predicted")
    assert numbers(note.get_text()) == [GROWTH["euler"][0]]
    assert note.xy == (times[-1], sizes[-1])


def test_axes_have_units_and_the_title_says_what_is_thin() -> None:
    """Metres on a logarithm."""
    *_, axes = shown("first_order_instability").figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time [s]", "distance from the true motion [m]")
    assert axes.get_yscale() == "log"
    assert "fastest mode (thin)" in axes.get_title(loc="left")


def test_a_row_for_each_scheme_over_the_true_motion() -> None:
    """Grey beneath, at each of the times."""
    *rows, _ = shown("first_order_instability").figure.axes
    for i, (row, name) in enumerate(zip(rows, GROWTH, strict=True)):
        assert row.get_title(loc="left") == f"{name}, dt = {DT:g} s (true motion in grey)"
        grey, own = marks(row, color="#bbbbbb", linewidth=4), marks(row, color=look(i)["color"])
        assert len(grey) == len(own) == len(TIMES)
        assert row.lines.index(grey[0]) < row.lines.index(own[0])
        bottom, top = row.get_ylim()
        assert 0 < top < 1 < -bottom < 2  # a metre of string hangs from the anchor at 0


def test_what_is_nowhere_is_told_in_the_words() -> None:
    """And the growth of each, predicted and measured."""
    assert "heun not a finite number" in shown("first_order_instability", "lost").alt
    alt = shown("first_order_instability").alt
    assert "euler 1.02000 predicted, 1.01950 measured; heun 0.99900 predicted, 0.99910 measured" in alt
