"""Position-based solvers: positions are moved first, then corrected spring by spring; velocities follow from them.

XPBD holds a spring of stiffness k [N/m] and damping c [N s/m] as a constraint C = length - rest length of compliance
1/k. In a step of h, with a = 1/(k h^2), g = c/(k h), W = 1/m_a + 1/m_b, a correction is

    dL = -(C + a L + g h e.(v_b - v_a)) / ((1 + g) W + a),

with L the sum of the corrections so far. (Macklin, Mueller and Chentanez, *XPBD*, MIG 2016, equations 18 and 26.)
Solved to the end that is backward Euler, but for the directions, which are those that springs had at each correction.
In single precision v = (x - x0)/h is as coarse as a position's last digit over h: with more sub-steps, velocities get
worse.
"""

from __future__ import annotations

import numpy as np

from reference.constraint_solvers.solver_numbers import SolverNumbers, numbers_of
from reference.jit import compiled
from reference.motion import MotionOfSprings
from reference.schemes.catalogue import scheme
from reference.state import Array, State
from reference.system import IntArray


@scheme(order=1, kind="constraint_scheme", implicit=True, linear=False, iterated=True)
def xpbd_jacobi(
    motion: MotionOfSprings,
    state: State,
    dt: float,
    *,
    iterations: int = 2,
    accumulated: bool = True,
    single: bool = False,
) -> State:
    """XPBD, all springs corrected from the same positions, and the corrections summed (Newton's SolverXPBD).

    Neither averaged nor relaxed, so it blows up where too many springs meet at a mass. Two iterations are Newton's
    default; it has no drag. Newton up to 1.7 took L for zero in each iteration (not `accumulated`): with more of them a
    spring then gets stiffer, and is a rigid rod in the end.
    """
    it = numbers_of(motion.system, state, "made", single)
    h, (a, b) = it.number(dt), it.ends.T
    with np.errstate(divide="ignore", invalid="ignore"):
        compliance, damping = 1 / (it.stiffness * h * h), it.damping / (it.stiffness * h)
    moves = (it.both > 0) & (it.stiffness > 0)
    start, sums = it.x.copy(), np.zeros_like(it.rest)
    slow_down(it, h)
    it.x[:] += it.v * h
    for _ in range(iterations):
        gap, relative = it.x[b] - it.x[a], it.v[b] - it.v[a]
        lengths = norms(gap)
        e = gap / lengths[:, None]
        with np.errstate(invalid="ignore"):
            wanted = lengths - it.rest + compliance * sums + damping * (h * dots(e, relative))
            change = np.where(moves, -wanted / ((1 + damping) * it.both + compliance), 0)
        sums = sums + change if accumulated else sums
        moved = np.zeros_like(it.x)
        ends = np.concatenate([(it.inverse[b] * change)[:, None] * e, -(it.inverse[a] * change)[:, None] * e], axis=1)
        np.add.at(moved, it.ends[:, ::-1].ravel(), ends.reshape(-1, it.x.shape[1]))
        it.x[:] += moved
        it.v[:] = (it.x - start) / h
    return it.state(state.time + dt)


@scheme(order=1, kind="constraint_scheme", implicit=True, linear=False, iterated=True)
def xpbd_gauss_seidel(
    motion: MotionOfSprings,
    state: State,
    dt: float,
    *,
    substeps: int = 5,
    sweeps: int = 1,
    order: str = "made",
    single: bool = False,
) -> State:
    """XPBD, one spring after the other, each from what those before it have left (Jolt's soft bodies, PyPBD).

    Jolt calls its 5 sub-steps of one sweep each iterations. Drag takes the part h Cd/m of a velocity.
    """
    it = numbers_of(motion.system, state, order, single)
    h = it.number(dt) / it.number(substeps)
    with np.errstate(divide="ignore", invalid="ignore"):
        compliance, damping = 1 / it.stiffness * (1 / (h * h)), it.damping / (it.stiffness * h)
    constraints = it.order[it.stiffness[it.order] > 0]  # without stiffness a spring is none
    for _ in range(substeps):
        slow_down(it, h)
        start, sums = it.x.copy(), np.zeros_like(it.rest)
        it.x[:] += h * it.v
        for _ in range(sweeps):
            _correct(it.x, start, it.ends, constraints, it.inverse, it.rest, it.both, compliance, damping, sums)
        it.v[:] = (it.x - start) / h
    return it.state(state.time + dt)


def slow_down(it: SolverNumbers, h: Array) -> None:
    """Weight, and what drag leaves of the velocities in a step of h [s]."""
    it.v[:] += it.weight * h
    if it.drag.any():
        it.v[:] *= np.maximum(1 - h * it.drag, 0)


def norms(vectors: Array) -> Array:
    """Lengths, shape (s,), added up axis by axis as engines do."""
    return np.sqrt(dots(vectors, vectors))


def dots(one: Array, other: Array) -> Array:
    """Scalar products, shape (s,)."""
    total = one[:, 0] * other[:, 0]
    for axis in range(1, one.shape[1]):
        total = total + one[:, axis] * other[:, axis]
    return total


def correct(
    x: Array,
    start: Array,
    ends: IntArray,
    order: IntArray,
    inverse: Array,
    rest: Array,
    both: Array,
    compliance: Array,
    damping: Array,
    sums: Array,
) -> None:
    """One sweep over the springs in their order: positions are corrected along each."""
    for j in order:
        a, b = ends[j, 0], ends[j, 1]
        gap = x[b, 0] - x[a, 0]
        squares = gap * gap
        approach = gap * ((x[b, 0] - start[b, 0]) - (x[a, 0] - start[a, 0]))
        for axis in range(1, x.shape[1]):
            gap = x[b, axis] - x[a, axis]
            squares += gap * gap
            approach += gap * ((x[b, axis] - start[b, axis]) - (x[a, axis] - start[a, axis]))
        length = np.sqrt(squares)
        wanted = (length - rest[j]) + compliance[j] * sums[j] + damping[j] * (approach / length)
        resisting = both[j] + damping[j] * both[j] + compliance[j]
        sums[j] -= wanted / resisting
        for axis in range(x.shape[1]):
            moved = (x[b, axis] - x[a, axis]) * wanted / (length * resisting)
            x[a, axis] += inverse[a] * moved
            x[b, axis] -= inverse[b] * moved


(_correct,) = compiled(correct)
