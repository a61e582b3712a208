"""What an animation is made of, on a motion made by hand: colours, widths, dots, its size, and the words for it."""

from __future__ import annotations

import base64
import json
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from reference.state import Trajectory
from reference.system import MassSpringSystem
from report.film.animations import Animation, animated
from tests.report.html import Page

#: Springs of 1 and 2 m, and a mass by itself; the first mass is held.
SYSTEM = MassSpringSystem(
    positions=np.array([[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [0.0, 1.0]]),
    springs=np.array([[0, 1], [1, 2]]),
    masses=np.array(1.0),
    rest_lengths=np.array([1.0, 2.0]),
    stiffness=np.array(5.0),
    fixed=np.array([True, False, False, False]),
)

#: At 0, 0.1 and 0.3 s: at rest; the first spring 10 % longer; the first 10 % shorter, the second 5 %.
PLACES = np.repeat(SYSTEM.positions[None], 3, axis=0)
PLACES[1, 1:3, 0] = [1.1, 3.1]
PLACES[2, 1:3, 0] = [0.9, 2.8]
MOTION = Trajectory(np.array([0.0, 0.1, 0.3]), PLACES, np.zeros_like(PLACES))


def made() -> Animation:
    """Of the motion."""
    return animated("the <row>", SYSTEM, MOTION)


def test_colours_tell_strain_from_blue_by_grey_to_orange() -> None:
    """In the middle no strain; at both ends a tenth: what is most here, or the next 1, 2 or 5 percent."""
    data = json.loads(made().data)
    colours = np.frombuffer(base64.b64decode(data["colours"]), "u1").reshape(3, 2)
    middle, last = (len(data["palette"]) - 1) / 2, len(data["palette"]) - 1
    assert colours.tolist() == [[middle, middle], [last, middle], [0, middle / 2]]
    blue, grey, orange = (to_rgb(data["palette"][i]) for i in (0, int(middle), last))
    assert blue[2] > blue[0] + 0.3
    assert np.ptp(grey) < 0.02
    assert orange[0] > orange[2] + 0.3
    stated = [line["stroke"] for line in Page(made().html()).of("line")]
    assert stated == [data["palette"][0], data["palette"][int(middle / 2)]]


def test_beyond_the_ends_colours_are_those_of_the_ends() -> None:
    """Of a thousand states ten are far out."""
    places = np.repeat(SYSTEM.positions[None], 1000, axis=0)
    places[:, 1, 0] = np.where(np.arange(1000) < 10, 1.9, 1.01)
    places[:, 2, 0] = places[:, 1, 0] + 2
    motion = Trajectory(np.arange(1000) * 1e-3, places, np.zeros_like(places))
    data = json.loads(animated("out", SYSTEM, motion).data)
    colours = np.frombuffer(base64.b64decode(data["colours"]), "u1").reshape(1000, 2)
    assert set(colours[:10, 0].tolist()) == {len(data["palette"]) - 1} == set(colours[10:, 0].tolist())


def test_data_are_what_the_script_reads() -> None:
    """Times, ends of springs, masses that are seen, places in whole parts of a pixel."""
    data = json.loads(made().data)
    assert data["duration"] == pytest.approx(8 * 0.3)
    assert (data["frames"], data["springs"], data["dotted"]) == (3, [0, 1, 1, 2], [0, 1, 2, 3])
    places = np.frombuffer(base64.b64decode(data["places"]), "<i2").reshape(3, 4, 2) / data["parts"]
    (svg,) = Page(made().html()).of("svg")
    wide, high = float(svg["width"]), float(svg["height"])
    assert svg["viewbox"] == f"0 0 {wide:g} {high:g}"
    assert max(wide, high) == 420
    assert 0.4 < high / wide < 0.6
    metre = (places[0, 2, 0] - places[0, 1, 0]) / 2
    assert places[0, 0, 1] - places[0, 3, 1] == pytest.approx(metre, abs=0.3)
    seen = places.reshape(-1, 2)
    assert (seen.min(axis=0) > 0).all()
    assert (seen.max(axis=0) < [wide, high]).all()
    assert wide - seen[:, 0].max() == pytest.approx(seen[:, 0].min(), abs=1)


def test_the_still_is_the_end_with_larger_dots_for_what_is_held() -> None:
    """Lines from place to place of the last state."""
    data = json.loads(made().data)
    last = np.frombuffer(base64.b64decode(data["places"]), "<i2").reshape(3, 4, 2)[-1] / data["parts"]
    page = Page(made().html())
    for line, (a, b) in zip(page.of("line"), SYSTEM.springs, strict=True):
        drawn = [float(line[key]) for key in ("x1", "y1", "x2", "y2")]
        assert drawn == pytest.approx([*last[a], *last[b]], abs=1e-3)
    dots = page.of("circle")
    places = np.array([[float(dot["cx"]), float(dot["cy"])] for dot in dots])
    assert places == pytest.approx(last, abs=1e-3)
    held, *free = (float(dot["r"]) for dot in dots)
    assert held > free[0]
    assert len(set(free)) == 1


def row_of(masses: int) -> tuple[MassSpringSystem, Trajectory]:
    """A string of springs of 1, 2 and 4 m by turns, the last mass of which is held; it keeps still."""
    lengths = np.resize([1.0, 2.0, 4.0], masses - 1)
    places = np.column_stack([np.concatenate([[0.0], np.cumsum(lengths)]), np.zeros(masses)])
    system = MassSpringSystem(
        positions=places,
        springs=np.column_stack([np.arange(masses - 1), np.arange(1, masses)]),
        masses=np.array(1.0),
        rest_lengths=lengths,
        stiffness=np.array(5.0),
        fixed=np.arange(masses) == masses - 1,
    )
    still = np.stack([places, places])
    return system, Trajectory(np.array([0.0, 0.1]), still, np.zeros_like(still))


@pytest.mark.parametrize(
    ("masses", "shares", "dots"),
    [
        pytest.param(30, [1, 1, 1], 30, id="thirty: all alike, and each with its dot"),
        pytest.param(31, [1, 0.5, 0.4], 1, id="more: the longer the thinner, down to 40 %; a dot for what is held"),
    ],
)
def test_many_masses_are_drawn_in_thinner_lines_without_dots(masses: int, shares: list[float], dots: int) -> None:
    """By how many times a spring is as long as the shortest."""
    page = Page(animated("row", *row_of(masses)).html())
    widths = [float(line["stroke-width"]) for line in page.of("line")][:3]
    assert [width / widths[0] for width in widths] == pytest.approx(shares, abs=0.02)
    assert len(page.of("circle")) == dots
    assert (widths[0] > 2) == (masses <= 30)


def test_springs_without_rest_length_are_as_the_shortest() -> None:
    """Nothing is divided by."""
    system, motion = row_of(31)
    loose = replace(system, rest_lengths=np.where(system.rest_lengths == 4, 0.0, system.rest_lengths))
    widths = [float(line["stroke-width"]) for line in Page(animated("row", loose, motion).html()).of("line")]
    assert widths[2] == widths[0] > widths[1]


def test_the_words_for_it_tell_all_of_it() -> None:
    """How many, for how long, how slowly, and what colours mean; a name may have any letters."""
    page = Page(made().html())
    assert made().alt == (
        "the <row>: 4 masses and 2 springs move for 0.3 s, shown 8 times slower; strain from -10 to 10 %, coloured "
        "from blue, pushed together by 10 %, over grey to orange and brown, pulled apart by as much."
    )
    assert page.of("svg")[0]["aria-label"] == made().alt
    assert page.of("figure")[0]["data-name"] == "the <row>"
