"""What permutations change, stepper by stepper, beside what is predicted; and Pymunk's differences by rounds."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.axes import Axes

from experiments.numbering import DAMPINGS, ROUNDS, ROUNDS_DAMPINGS
from experiments.runs.permutation import CHANGES
from report.figures.numbering import FLOOR
from tests.experiments.canned.numbering import LEFT
from tests.experiments.canned.reading import numbers, records
from tests.report.figures.artists import data, horizontals, legend, line, marks, text, tick_labels, verticals
from tests.report.figures.shown import result, shown


def left() -> Axes:
    """Dots."""
    return shown("numbering").figure.axes[0]


def right() -> Axes:
    """Rounds."""
    return shown("numbering").figure.axes[1]


def test_dots_are_the_table_of_damped_springs() -> None:
    """For each permutation a marker, near its stepper's row; what could not be run has none; zero is at `none`."""
    table = records(result("numbering"), f"numbering_damping_{DAMPINGS[0]:g}")
    names = [row["stepper"] for row in table]
    assert [*tick_labels(left().yaxis).values()] == names
    assert tick_labels(left().xaxis)[FLOOR] == "none"
    for change in CHANGES:
        expected = {
            row["stepper"]: max(row[f"{change} [m]"], FLOOR) for row in table if row[f"{change} [m]"] is not None
        }
        x, y = data(line(left(), change))
        assert dict(zip((names[round(at)] for at in y), x, strict=True)) == expected
    assert [*legend(left())] == [*CHANGES]
    first = [data(line(left(), change))[1][0] for change in CHANGES]
    assert first == sorted(first)
    assert np.diff(first) == pytest.approx([first[1] - first[0]] * 2)
    assert 0.4 < first[2] - first[0] < 0.6  # one under the other, well within their row
    assert len({(handle.get_color(), handle.get_marker()) for handle in legend(left()).values()}) == 3


def test_what_is_predicted_stands_beside_each_row() -> None:
    """Bold where an order is predicted to show."""
    beside = [t for t in left().texts if t.get_position()[0] == 1.02 and "predicted" not in t.get_text()]
    found = {t.get_position()[1]: (t.get_text(), t.get_fontweight()) for t in beside}
    assert found == {
        0: ("none", "normal"),
        1: ("masses", "bold"),
        2: ("springs", "bold"),
        3: ("-", "normal"),
        4: ("none", "normal"),
    }


def test_lines_are_the_differences_by_rounds_and_dotted_what_is_predicted() -> None:
    """From the default of ten rounds on, by the predicted part in each."""
    table = records(result("numbering"), "numbering_rounds")
    solid, dotted = marks(right(), linestyle="-"), marks(right(), linestyle=":")
    solid = [line for line in solid if line.get_marker() != "None"]
    for i, (damping, (predicted, _)) in enumerate(zip(ROUNDS_DAMPINGS, LEFT, strict=True)):
        rows = [row for row in table if row["damping [N s/m]"] == damping]
        assert data(solid[i]) == (list(ROUNDS), [max(row["springs reversed [m]"], FLOOR) for row in rows])
        x, y = map(np.array, data(dotted[i]))
        assert x[0] == 10
        assert y[0] == rows[ROUNDS.index(10)]["springs reversed [m]"]
        assert y[1:] / y[:-1] == pytest.approx(np.full(len(y) - 1, predicted))
        assert x[-1] == ROUNDS[-1] or y[-1] * predicted <= result("numbering").data["rounding"] < y[-1]
        note = text(right(), f"damping {damping:g} N s/m")
        assert numbers(note.get_text())[-1] == predicted
        assert note.xy[0] == x[-1]


def test_rounding_is_where_it_is_and_shaded_below() -> None:
    """In both."""
    rounding = result("numbering").data["rounding"]
    assert verticals(left()) == [rounding]
    assert horizontals(right()) == [rounding]
    assert left().patches[0].get_x() <= left().get_xlim()[0]
    assert right().patches[0].get_y() <= right().get_ylim()[0]
    assert left().patches[0].get_x() + left().patches[0].get_width() == pytest.approx(rounding)
    assert right().patches[0].get_y() + right().patches[0].get_height() == pytest.approx(rounding)


def test_axes_have_units() -> None:
    """And titles say what is measured."""
    assert left().get_xlabel() == right().get_ylabel() == "largest distance from the motion before the permutation [m]"
    assert right().get_xlabel() == "rounds of sequential impulses in a step [1]"
    assert (left().get_xscale(), right().get_xscale(), right().get_yscale()) == ("log", "linear", "log")
    assert left().get_title(loc="left") == f"Measured: springs damped with {DAMPINGS[0]:g} N s/m"
    assert right().get_title(loc="left") == "Measured: Pymunk, springs reversed"


def test_the_words_for_it_name_who_sees_something() -> None:
    """With the largest difference; nobody else."""
    alt = shown("numbering").alt
    assert "euler_in_place 2.0e-03 m, pymunk_springs 5.0e-06 m, stranger 7.0e-07 m." in alt
    assert "kick_drift" not in alt


def test_all_rounds_have_their_place_and_nothing_else_much() -> None:
    """From none to the most there are, with room for a note: no panel that is mostly empty."""
    low, high = right().get_xlim()
    assert low == 0
    assert ROUNDS[-1] < high < 1.3 * ROUNDS[-1]
