"""Stills of scenes at their ends: springs at their places in the colours of their strain, with scales."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_hex

from reference.scenes import find
from report.figures import draw
from report.film.drawing import STRAIN_COLOURS
from tests.experiments.canned import own_scene
from tests.experiments.canned.reading import numbers
from tests.experiments.canned.scenes import DURATION, STRETCHED
from tests.report.figures.artists import data, marks, segments
from tests.report.figures.shown import result, shown


def panels() -> dict[str, Axes]:
    """By the scene's name."""
    axes = [a for a in shown("scenes").figure.axes if a.get_visible()]
    return dict(zip(result("scenes").data["motions"], axes, strict=True))


def check_length(axes: Axes) -> None:
    """The bar in the corner is as long as the words beside it say [m]."""
    (bar,) = marks(axes, color="#444444", linewidth=2)
    (x0, x1), (y0, y1) = data(bar)
    (words,) = axes.texts
    assert y0 == y1
    assert numbers(words.get_text()) == pytest.approx([x1 - x0])
    assert words.get_text().endswith(" m")
    assert words.xy == (x1, y1)


def check_strain(axes: Axes, percent: float) -> None:
    """The bar of colours goes from minus so many percent to as many, and says what it is."""
    (bar,) = axes.child_axes
    assert bar.get_ylabel() == "strain [%]"
    assert bar.get_ylim() == pytest.approx((-percent, percent))


def test_springs_are_where_they_end_and_in_the_colour_of_their_strain() -> None:
    """In the plane at the places themselves; all are stretched by a tenth, which is the end of the colours."""
    axes, (system, motion) = panels()["string"], result("scenes").data["motions"]["string"]
    drawn, expected = segments(axes), motion.positions[-1][system.springs]
    assert np.sort(drawn, axis=0) == pytest.approx(np.sort(expected, axis=0))
    colours = {to_hex(c) for collection in axes.collections for c in np.atleast_2d(collection.get_color()) if len(c)}
    assert STRAIN_COLOURS[-1][1] in colours
    held, masses = marks(axes, marker="s"), marks(axes, marker="o")
    assert pytest.approx(motion.positions[-1][system.fixed]) == np.array(data(held[0])).T
    assert pytest.approx(motion.positions[-1][~system.fixed]) == np.array(data(masses[0])).T


@pytest.mark.parametrize("name", ["string", "barrier", "cloth"])
def test_every_panel_has_its_scales_and_its_name(name: str) -> None:
    """A length in metres, strain in percent; the scene, its time and its dt."""
    axes = panels()[name]
    check_length(axes)
    check_strain(axes, 100 * STRETCHED)
    assert axes.get_title(loc="left") == f"{name}, {DURATION:g} s, dt {find(name).dt:g} s"
    assert axes.get_aspect() == 1.0


def test_obstacles_are_painted_where_they_are() -> None:
    """The barrier's circle, over the whole window."""
    axes = panels()["barrier"]
    (image,) = axes.images
    assert image.get_extent() == pytest.approx([*axes.get_xlim(), *axes.get_ylim()])
    assert not panels()["string"].images


def test_no_scene_is_no_panel() -> None:
    """Nothing is shown."""
    assert not [a for a in shown("scenes", "no scene").figure.axes if a.get_visible()]


def test_the_words_for_it_have_the_strains() -> None:
    """Of every scene."""
    assert f"string, 11 masses after {DURATION:g} s, strain 10 to 10 %" in shown("scenes").alt


def test_a_users_own_scene_has_the_same_scales() -> None:
    """One still."""
    axes = shown("own_scene").figure.axes[0]
    check_length(axes)
    check_strain(axes, 100 * STRETCHED)
    assert "4 masses after 0.4 s, springs coloured by strain from 10 to 10 %" in shown("own_scene").alt


def test_a_user_s_masses_without_springs_are_dots_in_metres() -> None:
    """Where they end."""
    system, _ = result("scenes").data["motions"]["string"]
    none = np.zeros(0)
    springs = {"springs": np.zeros((0, 2), int), "rest_lengths": none, "stiffness": none, "damping": none}
    alone = replace(system, **springs)
    made = own_scene.usual(alone)
    picture = draw("own_scene", made)
    axes = picture.figure.axes[0]
    assert pytest.approx(made.data["motion"].positions[-1]) == np.array(data(axes.lines[0])).T
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [m]", "y [m]")
    assert axes.get_aspect() == 1.0
    assert "11 masses without springs" in picture.alt
