"""Limits in seconds: a black bar is predicted, a dot measured, in its stepper's row and its case's panel."""

from __future__ import annotations

from matplotlib.axes import Axes

from report.figures import COLOURS
from tests.experiments.canned.reading import records
from tests.experiments.canned.stability import rows
from tests.report.figures.artists import data, marks, tick_labels
from tests.report.figures.shown import result, shown


def panels() -> list[Axes]:
    """Undamped, and with drag."""
    return shown("stability").figure.axes


def test_bars_are_predicted_and_dots_measured() -> None:
    """As in the table, each at its stepper's height; a bar without a dot has a reason beside it."""
    names = list(dict.fromkeys(row.stepper for row in rows()))
    for axes, drag in zip(panels(), (0.0, 0.1), strict=True):
        table = [row for row in records(result("stability")) if row["drag [N s/m]"] == drag]
        bars, dots = marks(axes, marker="", linestyle="-"), marks(axes, marker="o", fillstyle="full")
        predicted = {names[round(sum(data(bar)[1]) / 2)]: data(bar)[0] for bar in bars}
        assert predicted == {r["stepper"]: [r["predicted dt [s]"]] * 2 for r in table if r["predicted dt [s]"]}
        measured = {names[int(data(dot)[1][0])]: data(dot)[0] for dot in dots}
        assert measured == {r["stepper"]: [r["measured dt [s]"]] for r in table if r["measured dt [s]"]}
        assert {bar.get_color() for bar in bars} == {COLOURS[6]}
        assert {dot.get_color() for dot in dots} == {COLOURS[1]}
        assert all(top - bottom > 0.5 for bottom, top in (data(bar)[1] for bar in bars))
        for said, name, dt in (("not measured", "exudyn_springs", 0.03), ("tried", "exudyn_springs_euler", 0.025)):
            (beside,) = [t for t in axes.texts if t.get_position()[0] > 0.02 and said in t.get_text()]
            assert beside.get_position()[1] == names.index(name)
            assert dt < beside.get_position()[0] < 1.5 * dt


def test_axes_are_in_seconds_and_rows_have_names() -> None:
    """Logarithmic; the words above say what bar and dot are."""
    figure = shown("stability").figure
    assert figure.get_suptitle() == "largest stable dt: predicted (bar) and measured (dot)"
    assert len({(axes.get_xlim(), axes.get_ylim()) for axes in panels()}) == 1
    for axes in panels():
        assert axes.get_xlabel() == "dt [s]"
        assert axes.get_xscale() == "log"
    assert [axes.get_title(loc="left") for axes in panels()] == ["undamped", "drag 0.1 N s/m"]
    assert [*tick_labels(panels()[0].yaxis).values()] == list(dict.fromkeys(row.stepper for row in rows()))


def test_who_has_no_limit_is_told_apart() -> None:
    """Unstable at any dt, stable at any, not run: each at its row."""
    names = list(dict.fromkeys(row.stepper for row in rows()))
    told = {
        "euler": "unstable at any dt",
        "backward_euler": "stable at any dt",
        "exudyn_springs": "not measured",
        "mujoco_rope": "unsupported",
        "stranger": "unstable at any dt tried",
        "exudyn_springs_euler": "unstable at any dt tried",
    }
    axes = panels()[0]
    assert {names[int(found.get_position()[1])]: found.get_text() for found in axes.texts} == told


def test_the_words_for_it_have_the_widest_difference() -> None:
    """A hundredth, of four limits."""
    assert "4 stability limits" in shown("stability").alt
    assert "differ by 1.0e-02 of the limit" in shown("stability").alt
