"""What a constraint solver reads of a system, in double or in true single precision.

In single precision every number is rounded before it is used, and every operation is one of single precision: NumPy's
arrays keep to it beside Python's own numbers, and compiled loops are given nothing else.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from reference.constraint_solvers.spring_order import in_order
from reference.errors import Unsupported
from reference.state import Array, State
from reference.system import IntArray, MassSpringSystem


@dataclass(frozen=True, eq=False)
class SolverNumbers:
    """A state and its system, all arrays of one kind of number.

    Attributes:
        x, v: of the masses [m], [m/s], shape (n, d); new arrays, to be written.
        inverse: 1/m, 0 for fixed masses [1/kg], shape (n,).
        weight: gravity on each mass that moves [m/s^2], shape (n, d).
        drag: of each mass, Cd/m [1/s], shape (n, 1).
        ends: of the springs, shape (s, 2).
        rest, stiffness, damping: of the springs, shape (s,).
        both: 1/m_a + 1/m_b of each spring [1/kg], shape (s,).
        order: in which the springs are solved, shape (up to s,).
    """

    x: Array
    v: Array
    inverse: Array
    weight: Array
    drag: Array
    ends: IntArray
    rest: Array
    stiffness: Array
    damping: Array
    both: Array
    order: IntArray

    def number(self, value: float) -> Any:
        """A number of that kind."""
        return self.x.dtype.type(value)

    def state(self, time: float) -> State:
        """What x and v have become, as doubles."""
        return State(time, self.x.astype(np.float64), self.v.astype(np.float64))


def numbers_of(system: MassSpringSystem, state: State, order: str, single: bool) -> SolverNumbers:
    """Of a state.

    Raises:
        InputError: for an unknown order of springs.
        Unsupported: for springs that are not linear, or a force that pulls on a mass.
    """
    if not system.rest_lengths.all():
        raise Unsupported("solvers of constraints have springs of a rest length only")
    if system.pulls.any():
        raise Unsupported("solvers of constraints have no force that pulls on a mass")
    if system.angular_springs is not None:
        raise Unsupported("solvers of constraints have no springs that resist bending")
    if system.nonlinear is not None:
        raise Unsupported("solvers of constraints have linear springs only")
    kind: Any = np.float32 if single else np.float64

    def rounded(values: Array) -> Array:
        return np.array(values, dtype=kind)

    inverse = np.where(system.fixed, kind(0), kind(1) / rounded(system.masses))
    a, b = system.springs.T
    return SolverNumbers(
        x=rounded(state.positions),
        v=rounded(state.velocities),
        inverse=inverse,
        weight=rounded(np.where(system.fixed[:, None], 0.0, system.gravity)),
        drag=rounded(np.where(system.fixed, 0.0, system.drag / system.masses))[:, None],
        ends=np.ascontiguousarray(system.springs),
        rest=rounded(system.rest_lengths),
        stiffness=rounded(system.stiffness),
        damping=rounded(system.damping),
        both=inverse[a] + inverse[b],
        order=in_order(system, order),
    )


def kept(state: State, numbers: SolverNumbers) -> Array:
    """The impulses [N s] that a warm start takes over from the step before, shape (s,); zero at the start."""
    return np.array(state.memory[0], dtype=numbers.x.dtype) if state.memory else np.zeros_like(numbers.rest)
