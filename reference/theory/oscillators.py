"""How a scheme steps single oscillators, many at once: x'' + g x' + w^2 x = 0, each on a spring of its own."""

from __future__ import annotations

import numpy as np

from reference.schemes.catalogue import Scheme
from reference.state import Array, State
from reference.system import MassSpringSystem
from reference.theory.linear_motion import LinearMotion


def step_matrices(
    scheme: Scheme, dt: float, masses: Array, stiffness: Array, damping: Array, drag: float = 0.0
) -> Array:
    """The matrices by which a step multiplies (x, dt v, dt of what is remembered) of oscillators on springs at rest.

    Shape (s, k, k), with k = 2 for a scheme that remembers nothing of the masses.

    Args:
        dt: the step [s].
        masses: [kg], shape (s,), each on a spring to a fixed point.
        stiffness: of that spring [N/m], shape (s,).
        damping: of that spring [N s/m], shape (s,).
        drag: of every mass [N s/m].
    """
    s = len(masses)
    along = np.arange(2 * s)
    system = MassSpringSystem(
        positions=np.stack([along % 2, along // 2], axis=1).astype(float),
        springs=along.reshape(s, 2),
        masses=np.repeat(masses, 2),
        rest_lengths=np.array(1.0),
        stiffness=stiffness,
        damping=damping,
        drag=drag,
        gravity=np.array(0.0),
        fixed=along % 2 == 0,
    )
    step = scheme.on(LinearMotion(system, system.start))
    nothing = np.zeros_like(system.positions)
    at_rest = State(0.0, nothing, nothing)
    memory = () if scheme.one_step else step(at_rest, dt).memory
    remembered = [q for q in memory if q.shape == nothing.shape]
    units = [1.0, dt, *[dt] * len(remembered)]
    columns = []
    for i, unit in enumerate(units):
        parts = [nothing.copy() for _ in units]
        parts[i][1::2, 0] = 1 / unit
        end = step(State(0.0, parts[0], parts[1], tuple(parts[2:])), dt)
        ends = (end.positions, end.velocities, *end.memory)
        columns.append(np.stack([unit * q[1::2, 0] for unit, q in zip(units, ends, strict=False)], axis=1))
    return np.stack(columns, axis=2)


def growth_of_oscillators(scheme: Scheme, dt: float, squares: Array, damping: Array) -> Array:
    """The growth factors of oscillators with w^2 [1/s^2] and g [1/s], shape (s,)."""
    matrices = step_matrices(scheme, dt, np.ones(len(squares)), squares, damping)
    return np.asarray(np.abs(np.linalg.eigvals(matrices)).max(axis=1))
