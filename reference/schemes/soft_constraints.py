"""Soft constraints: how the engines of games step a spring, by impulses along it, one spring after the other.

A spring's impulse L in a step of h is that of a spring and a damper at the end of the step, so that it is stable at any
stiffness where the sweeps come to an end: e.(v_b - v_a) + b C + g L = 0, with C its elongation, e its direction,

    g = 1 / (h (c + h k)),    b = h k g.

(Catto, *Soft constraints*, GDC 2011.) With all springs solved together that is backward Euler, linearised. The engines
differ in how often they sweep, in what they begin from, in what they do after the masses have moved, and in the order
of the springs. A step that begins from the impulses of the step before ("warm start") keeps them in the state's
memory: it is no function of positions and velocities alone.
"""

from __future__ import annotations

from dataclasses import replace
from math import inf

import numpy as np

from reference.constraint_solvers.solver_numbers import SolverNumbers, kept, numbers_of
from reference.jit import compiled
from reference.motion import MotionOfSprings
from reference.schemes.catalogue import scheme
from reference.schemes.position_based import dots
from reference.spring_frequencies import frequencies
from reference.state import Array, State
from reference.system import IntArray, MassSpringSystem


@scheme(order=1, kind="constraint_scheme", implicit=True, linear=False, one_step=False, iterated=True)
def soft_constraints_warm(
    motion: MotionOfSprings, state: State, dt: float, *, sweeps: int = 8, order: str = "island", single: bool = False
) -> State:
    """Soft constraints from the impulses of the step before: velocities in sweeps, then positions (Box2D 2.3).

    Directions and elongations are those at the start of the step. Drag takes the part dt Cd/m of a velocity. One mass
    is stepped by backward Euler. (Catto, GDC 2011; b2DistanceJoint of Box2D 2.3.)
    """
    it = numbers_of(motion.system, state, order, single)
    h = it.number(dt)
    it.v[:] = (it.v + h * it.weight) * np.clip(1 - h * it.drag, 0, 1)
    impulses = kept(state, it) * (1 / h * h)  # for a dt that changes; in single precision that is not always 1
    effective, omega, ratio = as_oscillators(motion.system, it)
    it = replace(it, stiffness=effective * omega * omega, damping=2 * effective * ratio * omega)
    softness, bias, axes = soft_springs(it, it.x, h)
    _push(it.v, it.ends, it.order, it.inverse, axes, impulses)
    for _ in range(sweeps):
        _sweep(it.v, it.ends, it.order, it.inverse, axes, bias, softness, inverse_of(it.both + softness), impulses)
    it.x[:] += h * it.v
    return it.state(state.time + dt).remembering(impulses.astype(np.float64))


@scheme(
    order=1, kind="constraint_scheme", implicit=True, linear=False, iterated=True, ranges={"sweeps_after": (0, inf)}
)
def soft_constraints_cold(
    motion: MotionOfSprings,
    state: State,
    dt: float,
    *,
    substeps: int = 4,
    sweeps: int = 1,
    sweeps_after: int = 1,
    drag_first: bool = False,
    order: str = "fixed_last",
    single: bool = False,
) -> State:
    """Soft constraints from no impulse: in each sub-step sweeps, the masses move, and sweeps again (Rapier, PhysX 5).

    The sweeps after the move have the directions and elongations from before it, which is what they need not to be
    stable at any stiffness. Drag divides a velocity by 1 + dt Cd/m, once a step; or, `drag_first`, takes the part
    h Cd/m of it before the sweeps. One mass is stepped by backward Euler. Rapier has 4 sub-steps, 1 sweep and 1 after;
    PhysX's PGS 1 sub-step, 10 sweeps and 1 after, and drag first.
    """
    it = numbers_of(motion.system, state, order, single)
    h = it.number(dt) / it.number(substeps)
    mass = inverse_of(it.inverse)[:, None]
    kick = it.weight * mass * it.inverse[:, None] * h  # by way of a force, which rounds
    for _ in range(substeps):
        it.v[:] += kick
        if drag_first:
            it.v[:] *= np.maximum(1 - h * it.drag, 0)
        axes, lengths = axes_of(it, it.x)
        damped = h * it.stiffness + it.damping
        bias = (lengths - it.rest) * (it.stiffness * inverse_of(damped))
        softness = inverse_of(h * h * it.stiffness + h * it.damping)
        impulses, along = np.zeros_like(it.rest), dots(axes, it.both[:, None] * axes)  # 1/m_a + 1/m_b, rounded
        given = (it.ends, it.order, it.inverse, axes, bias, softness, inverse_of(along + softness), impulses)
        for _ in range(sweeps):
            _sweep_totals(it.v, *given)
        it.x[:] += h * it.v
        for _ in range(sweeps_after):
            _sweep_totals(it.v, *given)
    if not drag_first:
        it.v[:] *= 1 / (1 + it.number(dt) * it.drag)
    return it.state(state.time + dt)


@scheme(order=1, kind="constraint_scheme", implicit=True, linear=False, one_step=False, iterated=True)
def soft_constraints_relaxed(
    motion: MotionOfSprings, state: State, dt: float, *, substeps: int = 4, order: str = "colours", single: bool = False
) -> State:
    """Soft constraints in sub-steps of one sweep, a move, and a sweep to relax (Box2D 3).

    Each sub-step begins from the impulses of the one before. The sweep after the move acts on springs, too, with their
    new directions and elongations: so numerical damping is twice that of backward Euler. One mass m on a spring w^2 =
    k/m does u = (v - h w^2 x)/(1 + h^2 w^2), x' = x + h u, v' = (v - h w^2 x')/(1 + h^2 w^2) in a sub-step of h.
    Drag divides a velocity by 1 + h Cd/m. (Catto, *Solver2D*, 2024; b2SolveDistanceJoint of Box2D 3.)
    """
    it = numbers_of(motion.system, state, order, single)
    h = it.number(dt / substeps)
    effective, omega, ratio = as_oscillators(motion.system, it)
    a1 = 2 * ratio + h * omega
    a2 = h * omega * a1
    kept_part = 1 / (1 + a2)
    bias_rate = np.divide(omega, a1, out=np.zeros_like(a1), where=a1 > 0)
    given = (bias_rate, a2 * kept_part, kept_part, effective)
    moved, impulses = np.zeros_like(it.x), kept(state, it)
    room, one = np.zeros(it.x.shape[1], it.x.dtype), it.number(1)
    springs = (it.x, it.ends, it.order, it.inverse, it.rest)
    for _ in range(substeps):
        it.v[:] = h * it.weight + it.v * (1 / (1 + h * it.drag))
        _push_where_they_are(it.v, moved, it.x, it.ends, it.order, it.inverse, impulses, room, one)
        _sweep_where_they_are(it.v, moved, *springs, *given, impulses, room, one)
        moved += h * it.v
        _sweep_where_they_are(it.v, moved, *springs, *given, impulses, room, one)
    it.x[:] += moved
    return it.state(state.time + dt).remembering(impulses.astype(np.float64))


def soft_springs(it: SolverNumbers, x: Array, h: Array) -> tuple[Array, Array, Array]:
    """The softness g, the bias b C and the directions e of all springs at positions, in a step of h [s]."""
    axes, lengths = axes_of(it, x)
    softness = inverse_of(h * (it.damping + h * it.stiffness))
    return softness, (lengths - it.rest) * h * it.stiffness * softness, axes


def axes_of(it: SolverNumbers, x: Array) -> tuple[Array, Array]:
    """The directions of all springs, shape (s, d), and their lengths [m], shape (s,)."""
    a, b = it.ends.T
    axes = x[b] - x[a]
    squares = axes[:, 0] * axes[:, 0]
    for axis in range(1, axes.shape[1]):
        squares = squares + axes[:, axis] * axes[:, axis]
    lengths = np.sqrt(squares)
    return axes * (1 / lengths)[:, None], lengths


def inverse_of(values: Array) -> Array:
    """1 / values; 0 where they are."""
    return np.divide(1, values, out=np.zeros_like(values), where=values > 0)


def as_oscillators(system: MassSpringSystem, it: SolverNumbers) -> tuple[Array, Array, Array]:
    """Springs as Box2D is told of them: effective mass m [kg], w = 2 pi f [1/s], damping ratio; shape (s,) each.

    f = (k/m)^(1/2) / (2 pi) and c / (2 m w) are rounded to the solver's numbers before anything is made of them.
    """
    _, hertz, ratio = (np.array(q, dtype=it.x.dtype) for q in frequencies(system))
    return inverse_of(it.both), it.number(2 * np.pi) * hertz, ratio


def push(v: Array, ends: IntArray, order: IntArray, inverse: Array, axes: Array, impulses: Array) -> None:
    """Give the masses the impulses that their springs have kept."""
    for j in order:
        a, b = ends[j, 0], ends[j, 1]
        for axis in range(v.shape[1]):
            impulse = impulses[j] * axes[j, axis]
            v[a, axis] -= inverse[a] * impulse
            v[b, axis] += inverse[b] * impulse


def sweep(
    v: Array,
    ends: IntArray,
    order: IntArray,
    inverse: Array,
    axes: Array,
    bias: Array,
    softness: Array,
    effective: Array,
    impulses: Array,
) -> None:
    """One sweep over the springs in their order: what each lacks of e.(v_b - v_a) + b C + g L = 0, as its impulse."""
    for j in order:
        a, b = ends[j, 0], ends[j, 1]
        rate = axes[j, 0] * (v[b, 0] - v[a, 0])
        for axis in range(1, v.shape[1]):
            rate += axes[j, axis] * (v[b, axis] - v[a, axis])
        change = -effective[j] * (rate + bias[j] + softness[j] * impulses[j])
        impulses[j] += change
        for axis in range(v.shape[1]):
            impulse = change * axes[j, axis]
            v[a, axis] -= inverse[a] * impulse
            v[b, axis] += inverse[b] * impulse


def sweep_totals(
    v: Array,
    ends: IntArray,
    order: IntArray,
    inverse: Array,
    axes: Array,
    bias: Array,
    softness: Array,
    effective: Array,
    impulses: Array,
) -> None:
    """The same, where what acts is by how much the whole impulse has changed: it rounds otherwise."""
    for j in order:
        a, b = ends[j, 0], ends[j, 1]
        rate = axes[j, 0] * (v[b, 0] - v[a, 0])
        for axis in range(1, v.shape[1]):
            rate += axes[j, axis] * (v[b, axis] - v[a, axis])
        total = impulses[j] - effective[j] * (rate + bias[j] + softness[j] * impulses[j])
        change = total - impulses[j]
        impulses[j] = total
        for axis in range(v.shape[1]):
            impulse = axes[j, axis] * change
            v[a, axis] -= impulse * inverse[a]
            v[b, axis] += impulse * inverse[b]


def direction(a: int, b: int, moved: Array, x: Array, out: Array, one: float) -> float:
    """The unit vector from mass a to mass b, written to out; their distance. Masses are at x + moved."""
    for axis in range(x.shape[1]):
        out[axis] = (moved[b, axis] - moved[a, axis]) + (x[b, axis] - x[a, axis])
    squares = out[0] * out[0]
    for axis in range(1, x.shape[1]):
        squares += out[axis] * out[axis]
    length = np.sqrt(squares)
    for axis in range(x.shape[1]):
        out[axis] *= one / length
    return length


def push_where_they_are(
    v: Array,
    moved: Array,
    x: Array,
    ends: IntArray,
    order: IntArray,
    inverse: Array,
    impulses: Array,
    room: Array,
    one: float,
) -> None:
    """Give the masses the impulses that their springs have kept, along the directions of now."""
    for j in order:
        a, b = ends[j, 0], ends[j, 1]
        direction(a, b, moved, x, room, one)
        for axis in range(v.shape[1]):
            impulse = impulses[j] * room[axis]
            v[a, axis] -= inverse[a] * impulse
            v[b, axis] += inverse[b] * impulse


def sweep_where_they_are(
    v: Array,
    moved: Array,
    x: Array,
    ends: IntArray,
    order: IntArray,
    inverse: Array,
    rest: Array,
    bias_rate: Array,
    mass_part: Array,
    kept_part: Array,
    effective: Array,
    impulses: Array,
    room: Array,
    one: float,
) -> None:
    """One sweep with the directions and elongations of now."""
    for j in order:
        a, b = ends[j, 0], ends[j, 1]
        length = direction(a, b, moved, x, room, one)
        rate = room[0] * (v[b, 0] - v[a, 0])
        for axis in range(1, v.shape[1]):
            rate += room[axis] * (v[b, axis] - v[a, axis])
        wanted = rate + bias_rate[j] * (length - rest[j])
        change = -mass_part[j] * effective[j] * wanted - kept_part[j] * impulses[j]
        impulses[j] += change
        for axis in range(v.shape[1]):
            impulse = change * room[axis]
            v[a, axis] -= inverse[a] * impulse
            v[b, axis] += inverse[b] * impulse


_push, _sweep, _sweep_totals = compiled(push, sweep, sweep_totals)
_direction, _push_where_they_are, _sweep_where_they_are = compiled(direction, push_where_they_are, sweep_where_they_are)
