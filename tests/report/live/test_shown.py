"""What the live page's scene and legend are made of: trucks, ground, colours, the tab's title."""

from __future__ import annotations

import gzip
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from report.live.colours import LANE_COLOURS, as_light, of_strain
from report.live.driven_shapes import DrivenShapes, ground_acceleration, truck_place
from report.live.lab import Lab
from report.live.markup import legend
from report.live.scenes import open_scene
from report.live.title import TITLE, titled
from tests.report.live.labs import open_lab


@pytest.mark.rotating(4)
def test_the_truck_is_where_the_masses_that_came_on_have_their_centre(labs: list[Lab]) -> None:
    """At 20 m/s from the first joint on, as beside it joints share its mass as a beam would (slide 28)."""
    lab = open_lab(labs, "crossing")
    timeline = lab.timeline
    assert truck_place(timeline.opened.system, timeline.opened.system, timeline.lanes[0].state) is None
    lab.advance(500)
    place = truck_place(timeline.opened.system, timeline.system, timeline.lanes[0].state)
    assert place is not None
    # masses are those of the middle of the last step, 1 cm before; joints give way by some centimetres
    assert place == pytest.approx([10.0, 0.0], abs=0.2)
    lab.advance(800)
    assert truck_place(timeline.opened.system, timeline.system, timeline.lanes[0].state) is None


@pytest.mark.rotating(2)
def test_the_ground_s_acceleration_is_what_gravity_lacks(labs: list[Lab]) -> None:
    """A sine of 1 m/s^2 from 0.5 Hz: a(t) = sin(2 pi (f0 t + (f1 - f0) t^2 / 2 T)), in the middle of the last step."""
    lab = open_lab(labs, "earthquake")
    lab.advance(300)
    t = (300 - 0.5) * lab.timeline.dt
    expected = np.sin(2 * np.pi * (0.5 * t + 4.5 * t**2 / (2 * 1.8)))
    assert ground_acceleration(lab.timeline.opened.system, lab.timeline.system) == pytest.approx([expected, 0.0])


class Drawn:
    """In place of a viewer: what is drawn, by its name."""

    def __init__(self) -> None:
        self.lines: dict[str, Any] = {}
        self.labels: list[str] = []
        self.scene = self

    def add_line_segments(self, name: str, points: Any, *colours: Any, **how: Any) -> Any:
        """Kept."""
        self.lines[name] = SimpleNamespace(points=points, **how)
        return self.lines[name]

    def add_label(self, name: str, words: str, **how: Any) -> Any:
        """Kept."""
        self.labels.append(words)
        return SimpleNamespace(**how)


@pytest.mark.rotating(3)
@pytest.mark.parametrize(
    ("table", "words", "bars"),
    [
        ('[[sines]]\nparameter = "gravity"\namplitude = 4.0\nfrequency = 1.0\n', "gravity", 0),
        (
            "[ground_motion]\nfrom_frequency = 1.0\nto_frequency = 3.0\namplitude = 1.0\nduration = 0.5\n",
            "acceleration of the ground, which this is seen from",
            1,
        ),
    ],
)
def test_gravity_that_swings_is_no_moving_ground(tmp_path: Path, table: str, words: str, bars: int) -> None:
    """A string on one fixed mass: a bar under it where the ground moves, an arrow along gravity where it does not."""
    file = tmp_path / "scene.toml"
    file.write_text(f'scene = "string"\ndt = 1e-3\nduration = 0.5\n\n{table}')
    opened, drawn = open_scene(str(file)), Drawn()
    shapes = DrivenShapes(cast(Any, drawn), "lane", opened, np.zeros(3))
    now = replace(opened.system, gravity=np.array([3.0, -4.0]))
    shapes.show(now, opened.system.start)
    assert drawn.labels == [words]
    (line,) = drawn.lines.values()
    shaft = line.points[bars]
    along = (shaft[1] - shaft[0])[:2]
    expected = now.gravity if not bars else opened.system.gravity - now.gravity
    assert along / np.linalg.norm(along) == pytest.approx(expected / np.linalg.norm(expected), abs=1e-5)
    assert len(line.points) == bars + 3


def test_a_spring_has_its_lane_s_colour_the_deeper_the_more_it_is_strained() -> None:
    """Pushed together or pulled apart; where strain is no number it is the deepest."""
    for lane, colour in enumerate(LANE_COLOURS):
        slack, pushed, pulled, torn = of_strain(np.array([0.0, -0.1, 0.2, np.nan]), 0.1, lane).astype(int)
        assert ((pushed == colour) & (pulled == colour) & (torn == colour)).all()
        assert (slack >= pushed).all()
        assert (slack > pushed).any()


def test_light_is_what_a_screen_makes_the_colour_of_again() -> None:
    """By sRGB's own curve, 1.055 l^(1/2.4) - 0.055, to the rounding of a light of 255 steps."""
    colours = np.array([0, 114, 178, 213, 255])
    light = as_light(colours) / 255
    seen = np.where(light > 0.0031308, 1.055 * light ** (1 / 2.4) - 0.055, 12.92 * light)
    assert np.abs(255 * seen - colours).max() < 2
    assert light[1] < 0.2  # not as it was given: that would be seen as 178


def test_the_legend_names_lanes_in_their_order() -> None:
    """Each after its colour."""
    text = legend(["rk4", "<heun>"], 0.05)
    places = [text.index(word) for word in (str(LANE_COLOURS[0]), "rk4", str(LANE_COLOURS[1]), "&lt;heun&gt;", "5 %")]
    assert places == sorted(places)


@pytest.mark.parametrize("zipped", [True, False])
def test_the_tab_has_our_title(zipped: bool) -> None:
    """In the page alone, whichever way it is sent; what is no page is left as it is."""
    page = b"<html><title>Viser</title></html>"
    sent = gzip.compress(page) if zipped else page
    headers = {"Content-Type": "text/html; charset=utf-8", "Content-Length": str(len(sent))}
    headers["Content-Encoding"] = "gzip" if zipped else "identity"
    answer = titled(SimpleNamespace(headers=headers, body=sent))
    text = gzip.decompress(answer.body) if zipped else answer.body
    assert text == f"<html><title>{TITLE}</title></html>".encode()
    assert answer.headers["Content-Length"] == str(len(answer.body))
    script = SimpleNamespace(headers={"Content-Type": "application/javascript"}, body=page)
    assert titled(script).body == page
    assert titled(None) is None
