"""The scene of slides 16-17: the lecture's string swinging onto a circle."""

from __future__ import annotations

from dataclasses import replace

from reference.obstacles import Circle
from reference.scenes import scene
from reference.scenes.parameters import PerItem
from reference.scenes.strings import string
from reference.system import MassSpringSystem


@scene(dt=1e-3, duration=1.0, slides="16-17")
def barrier(
    *,
    masses: int = 10,
    mass: PerItem = 0.02,
    rest_length: PerItem = 0.125,
    stiffness: PerItem = 200.0,
    damping: PerItem = 0.0,
    drag: float = 0.02,
    gravity: float = 9.81,
    angle: float = 0.0,
    circle_x: float = 0.55,
    circle_y: float = -0.55,
    radius: float = 0.3,
) -> MassSpringSystem:
    """A string that falls and swings onto a circle, which none of its masses may enter.

    The string is that of the scene `string`, hung at (0, 0). The circle stands at (circle_x, circle_y) [m], its radius
    in [m]; the slides give no numbers for it. It stops masses: a spring between two of them may cut across it.
    """
    made: MassSpringSystem = string(
        masses=masses,
        mass=mass,
        rest_length=rest_length,
        stiffness=stiffness,
        damping=damping,
        drag=drag,
        gravity=gravity,
        angle=angle,
    )
    return replace(made, obstacles=(Circle((circle_x, circle_y), radius),))
