"""Whether a scheme's step, with masses that rest on flat obstacles, is its step along the surfaces alone.

At the end of a step masses are projected out of obstacles. A scheme that takes forces only where masses are at the ends
of steps never sees one inside: what it does along a surface is what it would do if nothing but that were. One with
stages, or that solves for velocities that lead inwards, sees the springs of masses inside; its steps along the surface
have a part of that. And one that moves masses before it pushes them leads those at rest inside in every second step.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

from reference.forces import SpringMotion
from reference.schemes.catalogue import Scheme
from reference.state import Array
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.step_map import step_jacobian

#: Steps at which that is looked at, in a swing's 1/w; and to what two steps agree.
STEPS, AGREEMENT = (0.3, 1.1), 1e-10


@cache
def keeps_to_surfaces(scheme: Scheme) -> bool:
    """Seen on one mass on a spring at 45 degrees to a floor: along it that has half the stiffness and half the damping.

    With a spring's direction u, the part of k u u^T along the floor is k / 2. And with weight the first step from rest
    leads into the floor.
    """
    if not (scheme.one_step and scheme.linear) or scheme.needs == "distance constraints":
        return False
    inclined, along = _rest([1.0, 1.0], 1.0), _rest([1.0], 0.5)
    both = [(step_jacobian(scheme, inclined, h), step_jacobian(scheme, along, h)) for h in STEPS]
    tangent = [0, 2]  # of (x, y, dt x', dt y')
    alike = all(bool(np.abs(whole[np.ix_(tangent, tangent)] - part).max() < AGREEMENT) for whole, part in both)
    heavy = replace(inclined.system, gravity=np.array([0.0, -1.0]))
    pressed = scheme.on(SpringMotion(heavy))(heavy.start, STEPS[0]).positions[1, 1] < heavy.positions[1, 1]
    return alike and bool(pressed)


def _rest(towards: list[float], part: float) -> Equilibrium:
    """One mass on one spring that is as long as at rest, without weight."""
    place: Array = np.array(towards) / np.linalg.norm(towards)
    system = MassSpringSystem(
        positions=np.array([np.zeros_like(place), place]),
        masses=np.ones(2),
        springs=np.array([[0, 1]]),
        rest_lengths=np.ones(1),
        stiffness=np.array([part]),
        damping=np.array([0.3 * part]),
        drag=0.1,
        fixed=np.array([True, False]),
        gravity=np.zeros_like(place),
    )
    return spring_equilibrium(system)
