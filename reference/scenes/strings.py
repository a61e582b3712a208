"""The string of the lecture, and its simplest case: one mass on one spring."""

from __future__ import annotations

from math import cos, radians, sin

import numpy as np

from reference.scenes import scene
from reference.scenes.parameters import PerItem, counted, each
from reference.system import MassSpringSystem


@scene(dt=1e-3, duration=2.0, slides="2, 4")
def spring(
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
    """One mass hanging on one spring, moving up and down: the damped oscillator.

    It hangs at (0, y) below an anchor at (0, 0), starting `stretch` [m] below the spring's rest length with a velocity
    upwards [m/s]. Slide 2 has the equation, with y measured from the spring's other end.
    """
    return MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.0, -(rest_length + stretch)]]),
        velocities=np.array([[0.0, 0.0], [0.0, velocity]]),
        springs=np.array([[0, 1]]),
        masses=np.array(mass),
        rest_lengths=np.array(rest_length),
        stiffness=np.array(stiffness),
        damping=np.array(damping),
        drag=drag,
        gravity=np.array(gravity),
        fixed=np.array([True, False]),
    )


@scene(dt=1e-3, duration=0.5, slides="3-5, 9-10, 13")
def string(
    *,
    masses: int = 10,
    mass: PerItem = 0.02,
    rest_length: PerItem = 0.125,
    stiffness: PerItem = 200.0,
    damping: PerItem = 0.0,
    drag: float = 0.0,
    gravity: float = 9.81,
    x0: float = 0.0,
    y0: float = 0.0,
    angle: float = 0.0,
) -> MassSpringSystem:
    """A string of masses and springs, let go straight and unstretched at an angle below the horizontal.

    It hangs from an anchor at (x0, y0), which is mass 0 of the system and fixed; spring j joins masses j and j + 1.
    mass, rest_length, stiffness and damping are one number, or one for each of the masses.
    """
    counted("masses", masses)
    lengths = each("rest_length", rest_length, masses)
    reach = np.concatenate([[0.0], np.cumsum(lengths)])
    if np.ptp(lengths) == 0:
        reach = lengths[0] * np.arange(masses + 1)
    # Exactly horizontal or vertical where that is asked for: cos(90 degrees) is 6e-17 on a computer.
    across, down = (round(f(radians(angle)), 15) if angle % 90 == 0 else f(radians(angle)) for f in (cos, sin))
    carried = each("mass", mass, masses)
    return MassSpringSystem(
        positions=np.column_stack([x0 + across * reach, y0 - down * reach]),
        springs=np.column_stack([np.arange(masses), np.arange(1, masses + 1)]),
        masses=np.concatenate([carried[:1], carried]),
        rest_lengths=lengths,
        stiffness=each("stiffness", stiffness, masses),
        damping=each("damping", damping, masses),
        drag=drag,
        gravity=np.array(gravity),
        fixed=np.arange(masses + 1) == 0,
    )
