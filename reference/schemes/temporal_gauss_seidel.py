"""Temporal Gauss-Seidel: soft constraints in many short sub-steps of one sweep each (TGS, of PhysX 5).

What others sweep many times for, this takes many sub-steps for: each begins from no impulse, and the elongation of a
spring goes along with the masses, though its direction stays that of the start of the step. (Macklin et al., *Small
Steps in Physics Simulation*, SCA 2019.)
"""

from __future__ import annotations

from math import inf

import numpy as np

from reference.constraint_solvers.solver_numbers import numbers_of
from reference.jit import compiled
from reference.motion import MotionOfSprings
from reference.schemes.catalogue import scheme
from reference.schemes.soft_constraints import axes_of
from reference.state import Array, State
from reference.system import IntArray


@scheme(
    order=1, kind="constraint_scheme", implicit=True, linear=False, iterated=True, ranges={"sweeps_after": (0, inf)}
)
def temporal_gauss_seidel(
    motion: MotionOfSprings,
    state: State,
    dt: float,
    *,
    substeps: int = 10,
    sweeps_after: int = 1,
    damping_as_stiffness: bool = False,
    order: str = "newest_first",
    single: bool = False,
) -> State:
    """Soft constraints in sub-steps of one sweep from no impulse, along the directions of the start (PhysX 5's TGS).

    Gravity kicks once, at the start; drag takes the part dt Cd/m there. In a sub-step of h a spring gives the impulse
    -(h (c + h k) u + h k C)/(1 + h (c + h k)/m), with u the rate of its elongation C and m its effective mass: one
    mass is stepped by backward Euler in each. The sweeps after the last know no elongation, and damp as if it were
    nothing: a velocity is divided by 1 + h (c + h k)/m.

    `damping_as_stiffness`: of what C has gained since the start of the step, a stiffness of as many N/m as the damping
    has N s/m takes h c/(1 + h^2 (k + c)/m), too: SAPIEN 3.0.3 does so. Beside the damper's force that is a part of
    about dt/2, in seconds: it goes to zero with dt, not with the sub-steps alone.
    """
    it = numbers_of(motion.system, state, order, single)
    h = it.number(dt) / it.number(substeps)
    it.v[:] += it.number(dt) * it.weight
    it.v[:] *= np.maximum(1 - it.number(dt) * it.drag, 0)
    axes, lengths = axes_of(it, it.x)
    damped = h * (it.damping + h * it.stiffness)
    rate = damped / (1 + damped * it.both)
    kept = h * it.stiffness / (1 + damped * it.both)
    gained = kept
    if damping_as_stiffness:
        gained = kept + h * it.damping / (1 + h * h * (it.stiffness + it.damping) * it.both)
    moved, nothing = np.zeros_like(it.x), np.zeros_like(it.rest)
    given = (it.ends, it.order, it.inverse, axes)
    for _ in range(substeps):
        _sweep_from_nothing(it.v, moved, *given, rate, kept * (lengths - it.rest), gained)
        moved += h * it.v
    for _ in range(sweeps_after):
        _sweep_from_nothing(it.v, moved, *given, rate, nothing, nothing)
    it.x[:] += moved
    return it.state(state.time + dt)


def sweep_from_nothing(
    v: Array,
    moved: Array,
    ends: IntArray,
    order: IntArray,
    inverse: Array,
    axes: Array,
    rate: Array,
    bias: Array,
    gained: Array,
) -> None:
    """One sweep: of each spring the impulse -(rate u + bias + gained (C - C0)), with u and C - C0 along its axis."""
    for j in order:
        a, b = ends[j, 0], ends[j, 1]
        along = axes[j, 0] * (v[b, 0] - v[a, 0])
        change = axes[j, 0] * (moved[b, 0] - moved[a, 0])
        for axis in range(1, v.shape[1]):
            along += axes[j, axis] * (v[b, axis] - v[a, axis])
            change += axes[j, axis] * (moved[b, axis] - moved[a, axis])
        impulse = -(rate[j] * along + bias[j] + gained[j] * change)
        for axis in range(v.shape[1]):
            push = impulse * axes[j, axis]
            v[a, axis] -= inverse[a] * push
            v[b, axis] += inverse[b] * push


(_sweep_from_nothing,) = compiled(sweep_from_nothing)
