"""A mass on a circle: where it leaves and how deep it sinks by dt, beside the predicted angles; strings below."""

from __future__ import annotations

import numpy as np
import pytest

from experiments.barrier import STEPS, predicted
from report.figures.barrier import FLOOR, RULES, TIMES
from tests.experiments.canned.barrier import ENGINES
from tests.experiments.canned.reading import records
from tests.report.figures.artists import data, horizontals, legend, line, lines, looks, text, tick_labels
from tests.report.figures.shown import result, shown


def column(stepper: str, rule: str, name: str) -> list[float]:
    """From the table, by STEPS; not a number where nothing ran."""
    rows = [row for row in records(result("barrier")) if (row["stepper"], row["rule"]) == (stepper, rule)]
    return [next((row[name] for row in rows if row["dt [s]"] == dt), np.nan) for dt in STEPS]


def test_lines_are_the_table_with_one_for_all_that_are_alike() -> None:
    """The angle on the left, the depth on the right, in the same look; no depth is at `none`."""
    angles, depths, *_ = shown("barrier").figure.axes
    known = {
        "heun: takes v inwards,\nheun: keeps v along": ("heun", "takes v inwards"),
        "kick_drift: keeps v along": ("kick_drift", "keeps v along"),
        "lecture_barrier: as printed": ("lecture_barrier", "as printed"),
        "mujoco_flex,\nmujoco_tendons": ("mujoco_flex", "its own"),
        "pymunk_springs": ("pymunk_springs", "its own"),
    }
    # As deep is not as far, and the other way round.
    assert set(legend(angles)) == {
        *known,
        "kick_drift: takes v inwards",
        "drift_kick: takes v inwards",
        "bullet_softbody",
    }
    for label, key in known.items():
        angle = line(angles, label)
        assert data(angle) == (
            list(STEPS),
            pytest.approx(column(*key, "is at, in the end or then [deg]"), nan_ok=True),
        )
        (depth,) = [found for found in lines(depths) if looks(found) == looks(angle)]
        expected = np.maximum(column(*key, "deepest inside [m]"), FLOOR)
        assert data(depth) == (list(STEPS), pytest.approx(expected, nan_ok=True))
    assert tick_labels(depths.yaxis)[FLOOR] == "none"


def test_predicted_angles_are_where_they_are() -> None:
    """Where cos is 2/3, and 1/2, of the cosine at the start; each with its words just above."""
    angles = shown("barrier").figure.axes[0]
    right, held = (float(np.degrees(predicted(fraction=f))) for f in (2 / 3, 1 / 2))
    assert horizontals(angles) == pytest.approx([right, held])
    assert text(angles, "predicted, cos = 2/3: true").get_position()[1] == pytest.approx(right, abs=2)
    assert text(angles, "predicted, cos = 1/2: held on").get_position()[1] == pytest.approx(held, abs=2)
    assert {said.get_position()[0] for said in angles.texts} == {min(STEPS)}


def test_axes_have_units() -> None:
    """Steps and depths on logarithms."""
    angles, depths, *_ = shown("barrier").figure.axes
    assert angles.get_xlabel() == depths.get_xlabel() == "dt [s]"
    assert angles.get_ylabel().endswith("[deg]")
    assert depths.get_ylabel() == "deepest inside [m]"
    assert (angles.get_xscale(), angles.get_yscale()) == ("log", "linear")
    assert (depths.get_xscale(), depths.get_yscale()) == ("log", "log")


def test_strings_are_drawn_at_their_times_over_the_circle() -> None:
    """Rules in one row, engines in the other, each in the look of its name; the circle of the scene in each frame."""
    *_, rules, engines = shown("barrier").figure.axes
    strings, circle = result("barrier").data["strings"], result("barrier").data["circle"]
    for axes, names in ((rules, RULES), (engines, ENGINES)):
        assert [*legend(axes)] == list(names)
        for name in names:
            drawn = [found for found in lines(axes) if looks(found) == looks(legend(axes)[name])]
            places = [strings[name].positions[round(100 * time)] for time in TIMES]
            for found, place in zip(drawn, places, strict=True):
                middle = found.get_xdata()[0]
                assert np.array(data(found)).T - [middle, 0] == pytest.approx(place)
        discs = [(disc.center, disc.radius) for disc in axes.patches]
        assert {radius for _, radius in discs} == {circle.radius}
        assert len(discs) == len(TIMES)
        middles = [tick.get_loc() for tick in axes.xaxis.get_major_ticks()]
        x, y = circle.centre
        assert [centre for centre, _ in discs] == [pytest.approx((middle + x, y)) for middle in middles]


def test_the_words_for_it_say_who_leaves_where() -> None:
    """And who stays on."""
    alt = shown("barrier").alt
    assert "kick_drift (keeps v along) leaves at 60.1 degrees" in alt
    assert "lecture_barrier (as printed) stays on, at 5.9 degrees" in alt
