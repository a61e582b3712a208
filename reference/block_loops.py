"""The derivatives of springs' forces in a compiled loop, for schemes that ask for them several times in every step.

What `assembly.spring_blocks` writes for all springs at once, where the formula stands, but for rounding: in space sums
of three squares may be taken in another order. That one has no loops; the page in a browser is written from it.
"""

from __future__ import annotations

import numpy as np

from reference.assembly import Blocks, as_blocks
from reference.jit import array, compiled
from reference.springs.linear_law import force_by_rate, spring_force
from reference.springs.nonlinear_law import damping_at, secant_stiffness, stretches, tangent_stiffness
from reference.state import Array, State
from reference.system import IntArray, MassSpringSystem


def write_blocks(
    x: Array,
    v: Array,
    springs: IntArray,
    rest_lengths: Array,
    secant: Array,
    tangent: Array,
    damped: Array,
    u: Array,
    by_position: Array,
    by_velocity: Array,
) -> None:
    """Write the blocks of every spring to by_position [N/m] and by_velocity [N s/m], shape (s, d, d).

    Args:
        secant: the stiffness that makes the force of every spring [N/m]; `tangent`, the force's derivative.
        damped: the damping that springs have there [N s/m].
        u: written, the direction of the last spring, shape (d,).
    """
    dimension = x.shape[1]
    for j in range(len(springs)):
        a, b = springs[j, 0], springs[j, 1]
        squares = 0.0
        for axis in range(dimension):
            u[axis] = x[b, axis] - x[a, axis]
            squares += u[axis] * u[axis]
        length = np.sqrt(squares)
        divisor = 1.0 if length == 0.0 and rest_lengths[j] == 0.0 else length
        rate = 0.0
        for axis in range(dimension):
            u[axis] /= divisor
            rate += u[axis] * (v[b, axis] - v[a, axis])
        force = spring_force(secant[j], length - rest_lengths[j], damped[j], rate)
        over_length = force / divisor if divisor == length else secant[j]
        by_rate = force_by_rate(damped[j])
        for axis in range(dimension):
            for other in range(dimension):
                along = u[axis] * u[other]
                across = (1.0 if axis == other else 0.0) - along
                turning = u[axis] * ((v[b, other] - v[a, other]) - rate * u[other])
                by_velocity[j, axis, other] = by_rate * along
                by_position[j, axis, other] = tangent[j] * along + over_length * across + (by_rate / divisor) * turning


KINDS = {
    **dict.fromkeys(("x", "v"), array(2)),
    "springs": array(2, "int64"),
    **dict.fromkeys(("rest_lengths", "secant", "tangent", "damped"), array(1)),
    "u": array(1, written=True),
    **dict.fromkeys(("by_position", "by_velocity"), array(3, written=True)),
}

*_, _write_blocks = compiled(spring_force, force_by_rate, write_blocks, kinds=KINDS)


def blocks_by_loop(system: MassSpringSystem, state: State) -> tuple[Blocks, Blocks]:
    """The derivatives of the forces at a state, by positions [N/m] and by velocities [N s/m]: `spring_blocks`."""
    secant = tangent = system.stiffness
    damped = system.damping
    if system.nonlinear is not None:
        stretch = stretches(system, state.positions)
        secant, tangent = secant_stiffness(system, stretch), tangent_stiffness(system, stretch)
        damped = damping_at(system, stretch)
    s, d = len(system.springs), system.dimension
    by_position, by_velocity = np.empty((s, d, d)), np.empty((s, d, d))
    x, v = (np.ascontiguousarray(rows, np.float64) for rows in (state.positions, state.velocities))
    stiffness = np.ascontiguousarray(secant), np.ascontiguousarray(tangent)
    _write_blocks(x, v, system.springs, system.rest_lengths, *stiffness, damped, np.empty(d), by_position, by_velocity)
    return as_blocks(system, state, by_position, by_velocity)
