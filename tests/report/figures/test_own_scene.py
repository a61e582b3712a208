"""A user's own scene: its end in a picture, all of it in an animation where that is small enough."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments.experiment import Result
from reference.system import MassSpringSystem
from report.figures import own_scene
from report.figures.own_scene import animate, draw
from tests.experiments.canned.own_scene import usual
from tests.experiments.canned.scenes import DURATION, STRETCHED
from tests.report.figures.artists import data, segments
from tests.report.html import Page

#: Two masses that nothing joins.
DUST = MassSpringSystem(
    positions=np.array([[1.0, 2.0], [3.0, -1.0]]),
    springs=np.zeros((0, 2), dtype=np.int64),
    masses=np.array(1.0),
    rest_lengths=np.array(1.0),
    stiffness=np.array(1.0),
)


def test_the_end_is_drawn_with_its_strain() -> None:
    """Every spring where it is in the end, not at the start; strain in percent in the words for it."""
    picture = draw(usual())
    system, motion = usual().data["system"], usual().data["motion"]
    drawn = segments(picture.figure.axes[0])
    assert np.sort(drawn, axis=0) == pytest.approx(np.sort(motion.positions[-1][system.springs], axis=0))
    percent = f"{100 * STRETCHED:.2g}"
    assert picture.alt == (
        f"{len(system.masses)} masses after {DURATION:g} s, springs coloured by strain from {percent} to {percent} %."
    )


def test_masses_without_springs_are_dots() -> None:
    """Where they are in the end, in metres, as wide as high; there is nothing to colour."""
    picture = draw(usual(DUST))
    (axes,) = picture.figure.axes
    (dots,) = axes.lines
    assert np.column_stack(data(dots)) == pytest.approx((1 + STRETCHED) * DUST.positions)
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_aspect()) == ("x [m]", "y [m]", 1)
    assert picture.alt == f"2 masses without springs after {DURATION:g} s."
    deep = np.column_stack([DUST.positions, [5.0, 7.0]])
    space = replace(DUST, positions=deep, velocities=np.zeros((2, 3)), gravity=np.zeros(3))
    (dots,) = draw(usual(space)).figure.axes[0].lines
    assert np.column_stack(data(dots)) == pytest.approx((1 + STRETCHED) * DUST.positions)


def test_what_moves_is_animated_unless_it_is_too_large(monkeypatch: pytest.MonkeyPatch) -> None:
    """Or has no springs, or was at one time only."""
    result = usual()
    springs = len(result.data["system"].springs)
    page = Page(animate(result))
    assert len(page.of("line")) == springs
    assert page.of("figure")[0]["data-name"] == "the scene"
    assert animate(usual(DUST)) == ""
    motion = result.data["motion"]
    once = replace(motion, times=motion.times[:1], positions=motion.positions[:1], velocities=motion.velocities[:1])
    assert animate(Result([], [], {**result.data, "motion": once})) == ""
    monkeypatch.setattr(own_scene, "MOST", springs)
    assert animate(result)
    monkeypatch.setattr(own_scene, "MOST", springs - 1)
    assert animate(result) == ""
