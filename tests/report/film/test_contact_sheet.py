"""A contact sheet says what it shows: a length in metres, strain in percent, names, the time."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.transforms import Bbox

from reference.outcome import Outcome
from reference.scenes import Setup, find
from report.film.contact_sheet import (
    BAR,
    BETWEEN,
    HIGH,
    HIGHEST,
    LEAST,
    TITLES,
    TOP,
    WIDE,
    ContactSheet,
    Shot,
    _title,
    contact_sheet,
    grid,
)
from report.film.drawing import nice
from report.film.film import Film, look_at
from tests.experiments.canned.reading import numbers
from tests.experiments.canned.scenes import DURATION, STRETCHED, stretched
from tests.report.figures.artists import cut_off, data, laid_out, marks

SYSTEM = find("string").system({"masses": 3})
SHOTS = (
    Shot(("heun", "rk4"), "identified as heun", Outcome("done", "", stretched(SYSTEM))),
    Shot(("euler",), "identified as euler", Outcome("done", "", stretched(SYSTEM)), left=0.2),
)


def sheet() -> ContactSheet:
    """Two panels."""
    return contact_sheet(SYSTEM, SHOTS, look_at(SYSTEM, [stretched(SYSTEM)]), "string, dt = 0.001 s")


def test_every_panel_has_a_bar_as_long_as_it_says() -> None:
    """In metres; a tenth of what is seen, or the next 1, 2 or 5."""
    *panels, _ = sheet().figure.axes
    assert len(panels) == len(SHOTS)
    for axes in panels:
        (bar,) = marks(axes, color="#444444", linewidth=2)
        (x0, x1), _ = data(bar)
        (words,) = [t for t in axes.texts if t.get_text().endswith(" m")]
        assert numbers(words.get_text()) == pytest.approx([x1 - x0])
        assert words.xy[0] == x1
        assert x1 - x0 == pytest.approx(nice((axes.get_xlim()[1] - axes.get_xlim()[0]) / 10))


def test_the_bar_of_colours_is_strain_in_percent() -> None:
    """As far as the strain of the motion goes, both ways."""
    *_, bar = sheet().figure.axes
    assert bar.get_ylabel().startswith("strain [%]")
    assert bar.get_ylim() == pytest.approx((-100 * STRETCHED, 100 * STRETCHED))


def test_names_and_schemes_stand_above_their_panels() -> None:
    """And a mass that leaves is told, with its time."""
    *panels, _ = sheet().figure.axes
    for axes, shot in zip(panels, SHOTS, strict=True):
        said = [t.get_text() for t in axes.texts]
        assert ", ".join(shot.names) in said
        assert shot.caption in said
        assert ("left the picture\nat t = 0.200 s" in said) == (shot.left is not None)


def test_the_clock_tells_the_time_of_what_is_shown() -> None:
    """In seconds of the motion; springs are those of that step; the note comes when the mass has left."""
    setup = Setup("string", SYSTEM, DURATION / 4, DURATION)
    steps = [0, 1, 2, 4]
    film = Film(setup, SHOTS, steps, look_at(SYSTEM, [stretched(SYSTEM)]))
    made = []

    def keep(*arguments: object) -> ContactSheet:
        made.append(contact_sheet(*arguments))  # type: ignore[arg-type]
        return made[0]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("report.film.film.contact_sheet", keep)
        for step, _ in zip(steps, film.frames(lambda _: None), strict=True):
            (shown,) = made
            assert shown.clock.get_text() == f"t = {step * DURATION / 4:.3f} s"
            places = stretched(SYSTEM).positions[step]
            drawn = np.array(shown.drawings[0].front.get_segments())
            assert np.sort(drawn, axis=0) == pytest.approx(np.sort(places[SYSTEM.springs], axis=0))
            assert [note.get_visible() for note in shown.notes] == [False, step * DURATION / 4 >= 0.2]


@pytest.mark.parametrize(("count", "ratio"), [(1, 1.0), (2, 2.2), (3, 0.5), (3, 1.0), (5, 1.0), (7, 2.0)])
def test_panels_stand_in_rows_each_below_its_titles(count: int, ratio: float) -> None:
    """Of the window's shape, all on the sheet, none over another, in reading order; an even number of pixels."""
    names = [(f"engine_{i}", "another_engine_of_the_same_motion", "and_a_third") for i in range(count)]
    shots = [Shot(name, "not identified; nearest kick_drift", Outcome("done", "", stretched(SYSTEM))) for name in names]
    look = replace(look_at(SYSTEM, [stretched(SYSTEM)]), window=(0.0, ratio, 0.0, 1.0))
    made = contact_sheet(SYSTEM, shots, look, "string, dt = 0.001 s").figure
    *panels, bar = laid_out(made).axes
    boxes = [axes.get_window_extent() for axes in panels]
    titles = [Bbox.union([text.get_window_extent() for text in axes.texts[:2]]) for axes in panels]
    for box in boxes:
        assert box.width / box.height == pytest.approx(ratio, rel=0.01)
        assert (box.width, box.height) == pytest.approx((boxes[0].width, boxes[0].height))
    places = [Bbox.union([box, title]) for box, title in zip(boxes, titles, strict=True)]
    assert all(title.y0 >= box.y1 for box, title in zip(boxes, titles, strict=True))
    assert not [i for i, one in enumerate(places) if any(one.overlaps(other) for other in places[:i])]
    assert not any(one.overlaps(bar.get_tightbbox()) for one in places)
    assert cut_off(made) == []
    assert bar.get_window_extent().height <= 4.0 * made.dpi
    assert max(len(line) for line in panels[0].texts[1].get_text().splitlines()) > 20
    page = made.bbox.padded(1)
    assert all(page.contains(*box.min) and page.contains(*box.max) for box in [*places, bar.get_window_extent()])
    assert [axes.texts[1].get_text().split(",")[0] for axes in sorted(panels, key=reading_order)] == [
        n[0] for n in names
    ]
    wide, high = made.canvas.get_width_height()
    assert (wide % 2, high % 2) == (0, 0)
    assert max(wide / 1240, high / 860) <= 1.01


def reading_order(axes: Axes) -> tuple[float, float]:
    """From the top row to the bottom, from left to right."""
    box = axes.get_position()
    return -round(box.y0, 3), box.x0


@pytest.mark.parametrize(
    ("count", "ratio", "columns"),
    [
        pytest.param(1, 1.0, 1, id="one"),
        pytest.param(4, 4.0, 1, id="flat ones below one another"),
        pytest.param(3, 1.0, 3, id="square ones in a row"),
        pytest.param(4, 1.0, 2, id="or in two rows"),
        pytest.param(12, 0.5, 4, id="narrow ones, no narrower than their titles"),
    ],
)
def test_as_many_columns_as_make_the_panels_largest(count: int, ratio: float, columns: int) -> None:
    """And no other number of them has room for larger ones."""
    shots = SHOTS[:1] * count
    found = grid(shots, (0.0, ratio, 0.0, 1.0))
    assert found.columns == columns
    assert len(found.titles) == math.ceil(count / columns)
    assert found.size[0] == pytest.approx(ratio * found.size[1])
    across = columns * (max(found.size[0], TITLES) + BETWEEN)
    down = sum(found.titles) + len(found.titles) * found.size[1]
    slack = [WIDE - BAR - BETWEEN - across, HIGH - TOP - BETWEEN - down, HIGHEST - found.size[1]]
    assert min(slack) == pytest.approx(0, abs=1e-9)


def test_titles_of_a_row_have_room_for_the_longest() -> None:
    """Wherever it stands; the row with short ones needs less."""
    short, long = SHOTS[0], replace(SHOTS[0], names=tuple(f"an_engine_{i}" for i in range(12)))
    for shots in ([short, long, short, short], [long, short, short, short]):
        found = grid(shots, (0.0, 1.0, 0.0, 1.0))
        assert found.columns == 2
        needed = [sum(map(len, _title(shot, found.size[0]))) for shot in (long, short)]
        assert found.titles == pytest.approx([0.165 * lines + 0.1 for lines in needed])
        assert needed[0] > needed[1] == 2
    in_lines = [len(_title(long, width)[0]) for width in (1.0, TITLES, 2 * TITLES)]
    assert in_lines[0] == in_lines[1] > in_lines[2]


def test_very_many_panels_are_small_and_in_few_rows() -> None:
    """Thirty, four in a row, on a sheet that is longer than others."""
    found = grid(SHOTS[:1] * 30, (0.0, 1.0, 0.0, 1.0))
    assert (found.columns, len(found.titles)) == (4, 8)
    assert found.size[1] == LEAST
    assert HIGH < found.sheet[1] < 1.5 * HIGH
