"""Along a line: the damped oscillator (slide 2), and the chain of masses and springs (slide 4). In one dimension.

The line points upwards, and gravity along it downwards. They are the scenes `spring` and `string`, hung straight down,
less the axis across: how they move up and down is the same, and nothing can move, or be unstable, to the side.
"""

from __future__ import annotations

import numpy as np

from reference.line import system_on_line
from reference.scenes import scene
from reference.scenes.parameters import PerItem, counted
from reference.scenes.strings import spring, string
from reference.system import MassSpringSystem


@scene(dt=1e-3, duration=2.0, slides="2, 5")
def oscillator(
    *,
    mass: float = 0.02,
    rest_length: float = 0.125,
    stiffness: float = 200.0,
    damping: float = 0.0,
    drag: float = 0.0,
    gravity: float = 9.81,
    stretch: float = 0.01,
    velocity: float = 0.0,
) -> MassSpringSystem:
    """One mass hanging on one damped spring, along a line: the damped oscillator in one dimension.

    It hangs at y below an anchor at 0, starting `stretch` [m] below the spring's rest length with a velocity upwards
    [m/s].
    """
    hanging: MassSpringSystem = spring(
        mass=mass,
        rest_length=rest_length,
        stiffness=stiffness,
        damping=damping,
        drag=drag,
        gravity=gravity,
        stretch=stretch,
        velocity=velocity,
    )
    return system_on_line(hanging)


@scene(dt=1e-3, duration=0.5, slides="4")
def chain(
    *,
    masses: int = 10,
    mass: PerItem = 0.02,
    rest_length: PerItem = 0.125,
    stiffness: PerItem = 200.0,
    damping: PerItem = 0.0,
    drag: float = 0.0,
    gravity: float = 9.81,
) -> MassSpringSystem:
    """Masses on springs, each hanging below the one before it, along a line: the string in one dimension.

    They are let go unstretched, below an anchor at 0, which is mass 0 of the system and fixed; spring j joins masses j
    and j + 1. mass, rest_length, stiffness and damping are one number, or one for each of the masses.
    """
    hanging: MassSpringSystem = string(
        masses=masses,
        mass=mass,
        rest_length=rest_length,
        stiffness=stiffness,
        damping=damping,
        drag=drag,
        gravity=gravity,
        angle=90.0,
    )
    return system_on_line(hanging)


@scene(dt=1e-3, duration=0.5, slides="4")
def slinky(
    *,
    masses: int = 50,
    mass: float = 1.0,
    stiffness: float = 10.0,
    damping: float = 0.0,
    drag: float = 0.0,
    gravity: float = 9.81,
) -> MassSpringSystem:
    """A slinky that hangs at rest and is let go at its top: its lower end stays where it is for sqrt(mass/stiffness).

    mass [kg] and stiffness [N/m] are of the whole, damping [N s/m] of each spring, whose rest length is 0. With `radii`
    its coils close, one after the other, and reach the lower end after sqrt(mass / (3 stiffness)).
    """
    counted("masses", masses, least=2)
    each, springs = mass / masses, masses - 1
    below = each * gravity * np.arange(springs, 0, -1)
    heights = -np.concatenate([[0.0], np.cumsum(below / (stiffness * springs))])
    return MassSpringSystem(
        positions=heights[:, None],
        springs=np.column_stack([np.arange(springs), np.arange(1, masses)]),
        masses=np.array(each),
        rest_lengths=np.array(0.0),
        stiffness=np.array(stiffness * springs),
        damping=np.array(damping),
        drag=drag,
        gravity=np.array(gravity),
    )
