"""Error against wall time, and speed against masses: engines solid, our own dashed, a scheme in its colour in both."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from experiments.cost import DURATION, MASSES
from report.figures.cost import Group
from tests.experiments.canned.reading import records
from tests.report.figures.artists import data, legend, line, lines, looks
from tests.report.figures.shown import result, shown

#: What is in the legend, and the stepper that is the cheapest of those.
LABELS = {
    "kick_drift:\nmujoco_tendons, bullet_softbody": "mujoco_tendons",
    "rk4:\nmujoco_flex_rk4": "mujoco_flex_rk4",
    "kick_drift (kernel)": "kick_drift",
    "rk4 (kernel)": "rk4",
    "heun (Python)": "heun",
}


def column(table: str, stepper: str, name: str) -> list[float]:
    """Of a stepper."""
    rows = [row for row in records(result("cost"), table) if row["stepper"] == stepper]
    return [np.nan if row[name] is None else row[name] for row in rows]


def test_lines_on_the_left_are_errors_by_wall_time() -> None:
    """Of the cheapest of those that are the same scheme; who has blown up has no place."""
    left, _ = shown("cost").figure.axes
    for label, name in LABELS.items():
        seconds, errors = data(line(left, label))
        assert seconds == pytest.approx(column("cost_error", name, "wall time [s]"))
        assert errors == pytest.approx(column("cost_error", name, "error [m]"), nan_ok=True)


def test_lines_on_the_right_are_steps_per_second_by_masses() -> None:
    """In the same look."""
    left, right = shown("cost").figure.axes
    for label, name in LABELS.items():
        look = (*looks(line(left, label)), line(left, label).get_linestyle())
        (found,) = [drawn for drawn in lines(right) if (*looks(drawn), drawn.get_linestyle()) == look]
        assert data(found) == (column("cost_masses", name, "masses"), column("cost_masses", name, "steps/s [1/s]"))


def test_engines_are_solid_ours_dashed_and_a_scheme_has_one_colour() -> None:
    """As the legend's title says."""
    figure = shown("cost").figure
    handles = legend(figure)
    assert [*handles] == [*LABELS]
    assert {label: handle.get_linestyle() for label, handle in handles.items()} == {
        label: "--" if "(" in label else "-" for label in LABELS
    }
    for scheme in ("kick_drift", "rk4"):
        assert len({looks(handle) for label, handle in handles.items() if label.startswith(scheme)}) == 1
    assert "engines (solid), our own (dashed)" in figure.legends[0].get_title().get_text()
    for case in ("usual", "full"):
        drawn = shown("cost", case).figure
        lines_of_text = sum(1 + label.count("\n") for label in legend(drawn))
        assert drawn.get_figheight() >= max(6.0, 0.17 * lines_of_text)
        assert drawn.get_figheight() < max(6.5, 0.2 * (lines_of_text + 4))


def test_what_lies_between_cheapest_and_dearest_is_shaded() -> None:
    """From 30 to 90 times the anchor's step: on the left over thrice the wall time; on the right as far as all came."""
    left, right = shown("cost").figure.axes
    (band,), (speeds,) = left.collections, right.collections
    (corners,) = [path.vertices for path in band.get_paths()]
    cheapest, dearest = (
        column("cost_error", name, "wall time [s]")[1:] for name in ("mujoco_tendons", "bullet_softbody")
    )
    assert corners[:, 0].min() == pytest.approx(min(cheapest))
    assert corners[:, 0].max() == pytest.approx(max(dearest))
    (corners,) = [path.vertices for path in speeds.get_paths()]
    assert corners[:, 0].max() == MASSES[2]


def test_axes_have_units_and_are_logarithmic() -> None:
    """All four."""
    left, right = shown("cost").figure.axes
    assert left.get_title(loc="left") == f"Measured: a string of {MASSES[0]} masses, five dt"
    assert right.get_title(loc="left") == "Measured: speed on larger strings"
    assert left.get_xlabel() == f"wall time of {DURATION:g} s of motion [s]"
    assert left.get_ylabel() == "largest distance of any mass from the true motion at the end [m]"
    assert (right.get_xlabel(), right.get_ylabel()) == ("masses [1]", "steps per second [1/s]")
    assert {axis.get_scale() for axes in (left, right) for axis in (axes.xaxis, axes.yaxis)} == {"log"}


def test_the_words_for_it_have_errors_and_ratios() -> None:
    """At the common step; who did not run is not in it."""
    alt = shown("cost").alt
    for row in records(result("cost")):
        error, slower = row["error, dt 1 ms [m]"], row["step / anchor's"]
        assert f"{row['stepper']} ({row['runs as']}) {error:.1e} m, {slower:.0f}" in alt
    assert "Segfaults" not in alt


def cost(seconds: list[float], errors: list[float], speeds: list[tuple[int, float]]) -> Any:
    """Of one stepper."""
    points = [SimpleNamespace(seconds=s, error=e) for s, e in zip(seconds, errors, strict=True)]
    return SimpleNamespace(points=points, steps_per_second=speeds)


def test_a_group_has_the_largest_error_and_the_least_and_most_of_times_and_speeds() -> None:
    """Not a number where one of them has none, or did not come so far."""
    one = cost([1.0, 4.0, 2.0], [0.25, 0.5, np.inf], [(10, 900.0), (100, 80.0), (1000, 7.0)])
    other = cost([3.0, 2.0, 1.0], [0.125, 0.75, 0.5], [(10, 700.0), (100, 90.0)])
    group = Group("heun", "engine", [one, other])
    least, most, errors = group.errors
    assert (least.tolist(), most.tolist()) == ([1.0, 2.0, 1.0], [3.0, 4.0, 2.0])
    assert errors == pytest.approx([0.25, 0.75, np.nan], nan_ok=True)
    masses, slowest, fastest = group.speeds
    assert (masses.tolist(), fastest.tolist()) == ([10, 100, 1000], [900.0, 90.0, 7.0])
    assert slowest == pytest.approx([700.0, 80.0, np.nan], nan_ok=True)


def test_axes_are_open_above_and_to_the_right_and_the_legend_has_no_frame() -> None:
    """As all of the report's."""
    figure = shown("cost").figure
    for axes in figure.axes:
        assert {side for side, spine in axes.spines.items() if spine.get_visible()} == {"left", "bottom"}
        assert any(line.get_visible() for line in axes.get_xgridlines())
    assert not figure.legends[0].get_frame_on()
