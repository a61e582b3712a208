"""Vertex block descent: Newton's method on one mass at a time, on the energy that backward Euler makes least.

In a step of h from x0, with y = x0 + h (v + h g), C a spring's length l less its rest length L, and l0 its length at
x0, a mass is moved by H^-1 f,

    f = m (y - x)/h^2 - sum of (k C + c/h (l - l0)) e,    H = m/h^2 + sum of k (1 - L/l (1 - e e^T)) + c/h e e^T.

(Chen, Liu, Yang and Yuksel, *Vertex Block Descent*, SIGGRAPH 2024.) The operations are those of Newton's SolverVBD, one
by one, so that in single precision they round as they do there: vectors have three axes, also where a system has less.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from reference.constraint_solvers.solver_numbers import SolverNumbers, numbers_of
from reference.errors import SolverError
from reference.motion import MotionOfSprings
from reference.schemes.catalogue import scheme
from reference.state import Array, State
from reference.system import IntArray

#: Newton leaves a mass where it is if its block's determinant is not beyond this [kg^3/s^6].
SINGULAR = 1e-8

#: Of each of three axes, the next one and the one before.
NEXT, LAST = [1, 2, 0], [2, 0, 1]


@scheme(order=1, kind="constraint_scheme", implicit=True, linear=False, iterated=True)
def vertex_block_descent(
    motion: MotionOfSprings,
    state: State,
    dt: float,
    *,
    iterations: int = 10,
    jacobi: bool = True,
    braked: bool = False,
    single: bool = False,
) -> State:
    """Vertex block descent: Newton's method on one mass at a time, on backward Euler's energy (Newton's SolverVBD).

    Newton colours its masses by triangles: with springs alone all have one colour, and move from the same positions
    (`jacobi`). What it sums is how far a mass has moved since the step began. Newton up to 1.3 took a spring's damping
    for a time [s] and braked each mass by that time, over h, times the spring's part of H without damping and how far
    the mass itself has moved (`braked`): a spring that only falls is braked, too.
    """
    it = numbers_of(motion.system, state, "made", single)
    masses = np.where(motion.system.fixed, 0.0, motion.system.masses).astype(it.x.dtype)
    h, start = it.number(dt), in_space(it.x)
    moved = (in_space(it.v) + in_space(it.weight) * h) * h
    moved[masses == 0] = 0
    blocks = Blocks(it, masses, h, start, start + moved, braked)
    x, free = start + moved, np.flatnonzero(masses)
    for _ in range(iterations):
        for some in [free] if jacobi else free[:, None]:
            moved[some] += blocks.descent(x, some)
            x = start + moved
    it.v[:] = ((x - start) / h)[:, : it.x.shape[1]]
    it.x[:] = x[:, : it.x.shape[1]]
    return it.state(state.time + dt)


def in_space(vectors: Array) -> Array:
    """With three axes, those that were not there 0; shape (n, 3)."""
    return np.pad(vectors, ((0, 0), (0, 3 - vectors.shape[1])))


def lengths(vectors: Array) -> Array:
    """Shape (s,)."""
    x, y, z = vectors.T
    return np.sqrt(x * x + y * y + z * z)


def by_itself(vectors: Array) -> Array:
    """The outer product of each with itself, shape (s, 3, 3)."""
    return vectors[:, :, None] * vectors[:, None, :]


@dataclass(frozen=True, eq=False)
class Blocks:
    """The force f and the matrix H of every mass, in a step of h [s].

    Attributes:
        masses: 0 for those that are fixed [kg], shape (n,).
        start, inertial: positions x0, and y, where no spring would let them go [m], shape (n, 3).
        braked: whether damping brakes each mass by itself.
    """

    it: SolverNumbers
    masses: Array
    h: Array
    start: Array
    inertial: Array
    braked: bool

    @cached_property
    def _one(self) -> Array:
        return np.eye(3, dtype=self.start.dtype)

    @cached_property
    def _lengths_before(self) -> Array:
        a, b = self.it.ends.T
        return lengths(self.start[a] - self.start[b])

    def descent(self, x: Array, some: IntArray) -> Array:
        """How far these masses go from positions x [m], shape (some, 3).

        Raises:
            SolverError: where a block is infinite, as with numbers beyond all bounds.
        """
        force, block = self._springs(x)
        rate = 1 / (self.h * self.h)
        force = (self.masses[:, None] * (self.inertial - x) * rate + force)[some]
        block = ((self.masses * rate)[:, None, None] * self._one + block)[some]
        inverse, determinant = inverted(block)
        if not np.isfinite(determinant).all():
            raise SolverError("vertex block descent: a block of its matrix is infinite at these numbers")
        return np.where(np.abs(determinant)[:, None] > SINGULAR, times(inverse, force), 0)

    def _springs(self, x: Array) -> tuple[Array, Array]:
        """What the springs add to f, shape (n, 3), and to H, shape (n, 3, 3)."""
        it, one, damping = self.it, self._one, self.it.damping / self.h
        a, b = it.ends.T
        gap = x[a] - x[b]
        length = lengths(gap)
        e = gap / length[:, None]
        across = one - by_itself(gap) / (length * length)[:, None, None]
        stiff = it.stiffness[:, None, None] * (one - (it.rest / length)[:, None, None] * across)
        push = (it.stiffness * (it.rest - length) / length)[:, None] * gap
        if self.braked:
            slow = stiff * damping[:, None, None]
            pushes = [push + times(slow, (self.start - x)[a]), -push + times(slow, (self.start - x)[b])]
        else:
            slow, drag = by_itself(e) * damping[:, None, None], e * (damping * (length - self._lengths_before))[:, None]
            pushes = [push - drag, drag - push]
        stiff = stiff + slow
        force, block = np.zeros_like(x), np.zeros((len(x), 3, 3), x.dtype)
        np.add.at(force, it.ends.ravel(), np.stack(pushes, axis=1).reshape(-1, 3))
        np.add.at(block, it.ends.ravel(), np.repeat(stiff, 2, axis=0))
        return force, block


def times(matrices: Array, vectors: Array) -> Array:
    """Products, added up column by column, shape (n, 3)."""
    first, second, third = (matrices[:, :, axis] * vectors[:, axis, None] for axis in range(3))
    return first + second + third


def inverted(matrices: Array) -> tuple[Array, Array]:
    """By cofactors, shape (n, 3, 3), not finite where there is none; and the determinants, shape (n,)."""
    m = matrices.transpose(1, 2, 0)
    below, further = m[NEXT], m[LAST]
    cofactors = below[:, NEXT] * further[:, LAST] - below[:, LAST] * further[:, NEXT]
    first, second, third = m[0] * cofactors[0]
    determinants = first + second + third
    with np.errstate(divide="ignore", invalid="ignore"):
        return (cofactors * (1 / determinants)).transpose(2, 1, 0), determinants
