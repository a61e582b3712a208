"""Pictures of systems along a line: upwards, where their masses are; a floor across."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from experiments.experiment import Result
from experiments.runs.comparison import compare
from reference.line import in_plane, system_in_plane
from reference.obstacles import Plane
from reference.scenes import Setup, find
from reference.stepper import catalogued
from reference.system import MassSpringSystem
from report.figures.own_scene import draw
from report.film.animations import animated
from report.film.drawing import colour_map, lines
from report.film.film import film, look_at

CHAIN = find("chain").system({"masses": 4})

#: Its third mass comes down to -0.44 m.
OVER_A_FLOOR = replace(CHAIN, obstacles=(Plane((-0.52,), (1.0,)),))


def test_a_film_shows_a_line_upwards() -> None:
    """At every step, to the bit: springs from (0, y) to (0, y)."""
    comparison = compare(Setup("chain", CHAIN, 1e-3, 0.1), [catalogued()["heun"]])
    made = film(comparison)
    motion = comparison.runs[0].outcome.trajectory
    assert motion is not None
    for step in made.steps:
        drawn = lines(CHAIN, made.positions(made.shots[0], step), made.look, colour_map())
        right = in_plane(motion.positions[step])[CHAIN.springs]
        assert np.array_equal(np.sort(drawn.segments, axis=0), np.sort(right, axis=0))
        assert (right[..., 0] == 0).all()
    assert made.look.window[0] < 0 < made.look.window[1]


def test_it_looks_as_the_same_motion_in_the_plane() -> None:
    """Window, colours, obstacles, and the animation for pages."""
    line, plane = (moved(system) for system in (OVER_A_FLOOR, system_in_plane(OVER_A_FLOOR)))
    one, other = (look_at(system, [motion]) for system, motion in (line, plane))
    assert (one.window, one.most) == (other.window, other.most)
    assert one.obstacles is not None
    assert other.obstacles is not None
    assert np.array_equal(one.obstacles.image, other.obstacles.image)
    shown = one.obstacles.image[..., 3]
    assert shown[0].min() > 0  # the floor, from side to side
    assert shown[-1].max() == 0
    assert animated("the scene", *line).html() == animated("the scene", *plane).html()


def moved(system: MassSpringSystem) -> tuple:  # type: ignore[type-arg]
    """A system, and how it moves by Heun."""
    motion = catalogued()["heun"].run(system, 1e-3, 100).trajectory
    assert motion is not None
    return system, motion


def test_masses_without_springs_are_drawn_upwards_too() -> None:
    """Two that fall along a line."""
    system = MassSpringSystem(
        positions=np.array([[0.0], [0.3]]),
        springs=np.zeros((0, 2), dtype=np.int64),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
    )
    _, motion = moved(system)
    picture = draw(Result([], [], {"system": system, "motion": motion}))
    (dots,) = picture.figure.axes[0].lines
    assert np.array_equal(np.column_stack(dots.get_data()), in_plane(motion.positions[-1]))
