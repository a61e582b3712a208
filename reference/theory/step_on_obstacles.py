"""A step from a rest on obstacles: where it stays, and how it answers small perturbations there.

A step leads masses that are pressed a little into their obstacles, and its end projects them out. In between, schemes
with stages have seen the springs of masses inside. So a step stays not at the rest itself but near it, at a state z
with Phi(z) = z of its own, which Newton's method finds; there the step without its end is differenced, which is smooth,
and its end is linearised (`contacts.projection_jacobian`). As it is not at the rest, springs that are not linear have
their own law there, not the tangent at the rest.
"""

from __future__ import annotations

import numpy as np

from reference.errors import SolverError
from reference.schemes.catalogue import Scheme
from reference.simulate import projected
from reference.state import Array, State
from reference.theory.contacts import projection_jacobian
from reference.theory.differences import differences
from reference.theory.equilibria import Equilibrium
from reference.theory.layout import layout_of

#: Newton's steps to where a scheme stays, and how near to it is near enough, as a part of the rest's length.
MOST_STEPS, NEAR = 10, 1e-12

#: Deeper inside than this part of the rest's length a mass is pressed; nearer to the surface it is rounding.
INSIDE = 1e-13

#: What is said of steps that do not end inside: x' = x + dt v leads nowhere from rest, and the next step does.
BY_TURNS = "masses at rest on obstacles enter them in every second step of this scheme only: it has no rest there"


def settled_on_obstacles(scheme: Scheme, rest: Equilibrium, dt: float) -> tuple[State, Array]:
    """The state that a step from near a rest on obstacles comes back to, and the Jacobian of the whole step there.

    Raises:
        SolverError: if there is none, and why.
    """
    require_pressed(scheme, rest, dt)
    layout, state = layout_of(scheme, rest, dt)
    step, system = scheme.on(rest.stepped), rest.system
    for _ in range(MOST_STEPS):
        inside = step(state, dt)
        jacobian = differences(step, layout, state)
        block = 2 * layout.block
        ends = projection_jacobian(system, inside.positions, inside.velocities, dt)
        jacobian[:block] = ends @ jacobian[:block]
        moved = (layout.vector(projected(system, inside, 0.0)) - layout.vector(state))[:, 0]
        if not np.isfinite(moved).all() or np.abs(moved).max() <= NEAR * rest.scale:
            return state, jacobian
        # what slides freely stays where it is
        change = np.asarray(np.linalg.lstsq(np.eye(layout.size) - jacobian, moved, rcond=1e-10)[0], dtype=float)
        state = layout.state(change, state)
    raise SolverError("no state was found that steps of this scheme stay at on the obstacles")


def require_pressed(scheme: Scheme, rest: Equilibrium, dt: float) -> None:
    """Raises SolverError unless a step from rest ends inside obstacles, for their rule to hold masses there."""
    assert rest.contacts is not None
    inside = scheme.on(rest.stepped)(layout_of(scheme, rest, dt)[1], dt)
    for i, k in zip(rest.contacts.masses, rest.contacts.obstacles, strict=True):
        distance, _ = rest.system.obstacles[k].signed_distances(inside.positions[i : i + 1])
        if not distance[0, 0] < -INSIDE * rest.scale:
            raise SolverError(BY_TURNS)
