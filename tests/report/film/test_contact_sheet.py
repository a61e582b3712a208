"""A contact sheet says what it shows: a length in metres, strain in percent, names, the time."""

from __future__ import annotations

import numpy as np
import pytest

from reference.outcome import Outcome
from reference.scenes import Setup, find
from report.film.contact_sheet import ContactSheet, Shot, contact_sheet
from report.film.drawing import nice
from report.film.film import Film, look_at
from tests.experiments.canned.reading import numbers
from tests.experiments.canned.scenes import DURATION, STRETCHED, stretched
from tests.report.figures.artists import data, marks

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
