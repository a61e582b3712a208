"""The forces on a mesh of springs, and so its equations of motion: the lecture's slides 4-5 and 9-10, on any mesh.

A spring pulls the two masses it joins together with the force that the law of a spring gives (`springs.linear_law`),
and a mass feels its springs, its weight m g, the drag -Cd v, and what pulls on it besides. Every spring is computed
once; then each mass sums the forces of its own springs in their order. A mass alone (`acceleration_of`) is given
exactly the bits it has within the whole. A spring of no length, which has no direction, gives forces that are not
numbers, and so a run that diverges, unless its rest length is zero, too: then it has no force. A spring that is not
linear (`springs.nonlinear_law`) has at every state the stiffness and damping that make its force there. What resists
bending at a mass is added to all that (`springs.angular_law`).

The functions at the top are compiled (`jit`): they are loops over numbers.
"""

from __future__ import annotations

import numpy as np

from reference.assembly import Blocks
from reference.block_loops import blocks_by_loop
from reference.jit import array, compiled
from reference.springs.angular_law import forces_on_masses
from reference.springs.linear_law import spring_force
from reference.springs.nonlinear_law import damping_at, secant_stiffness, stretches
from reference.state import Array, Slope, State, Trajectory
from reference.system import BoolArray, IntArray, MassSpringSystem


def force_of_spring(
    j: int, x: Array, v: Array, springs: IntArray, rest_lengths: Array, stiffness: Array, damping: Array, forces: Array
) -> None:
    """Write the force of spring j on its first mass [N] to forces[j]; on its second mass it is the opposite."""
    a, b = springs[j, 0], springs[j, 1]
    dimension = x.shape[1]
    squares = 0.0
    for axis in range(dimension):
        separation = x[b, axis] - x[a, axis]
        forces[j, axis] = separation
        squares += separation * separation
    length = np.sqrt(squares)
    divisor = length if length > 0.0 else 1.0 if rest_lengths[j] == 0.0 else length
    rate = 0.0
    for axis in range(dimension):
        forces[j, axis] /= divisor
        rate += forces[j, axis] * (v[b, axis] - v[a, axis])
    force = spring_force(stiffness[j], length - rest_lengths[j], damping[j], rate)
    for axis in range(dimension):
        forces[j, axis] *= force


def acceleration_of_mass(
    i: int,
    v: Array,
    forces: Array,
    masses: Array,
    drag: float,
    gravity: Array,
    fixed: BoolArray,
    first: IntArray,
    spring: IntArray,
    sign: Array,
    out: Array,
) -> None:
    """Write the acceleration of mass i [m/s^2] to out[i], from its weight, the forces of its springs and its drag."""
    for axis in range(out.shape[1]):
        force = masses[i] * gravity[axis]
        for entry in range(first[i], first[i + 1]):
            force += sign[entry] * forces[spring[entry], axis]
        force -= drag * v[i, axis]
        out[i, axis] = 0.0 if fixed[i] else force / masses[i]


def all_accelerations(
    x: Array,
    v: Array,
    springs: IntArray,
    rest_lengths: Array,
    stiffness: Array,
    damping: Array,
    masses: Array,
    drag: float,
    gravity: Array,
    fixed: BoolArray,
    first: IntArray,
    spring: IntArray,
    sign: Array,
    forces: Array,
    out: Array,
) -> None:
    """Springs first, each once; then every mass sums its own."""
    for j in range(len(springs)):
        force_of_spring(j, x, v, springs, rest_lengths, stiffness, damping, forces)
    for i in range(len(masses)):
        acceleration_of_mass(i, v, forces, masses, drag, gravity, fixed, first, spring, sign, out)


def one_acceleration(
    i: int,
    x: Array,
    v: Array,
    springs: IntArray,
    rest_lengths: Array,
    stiffness: Array,
    damping: Array,
    masses: Array,
    drag: float,
    gravity: Array,
    fixed: BoolArray,
    first: IntArray,
    spring: IntArray,
    sign: Array,
    forces: Array,
    out: Array,
) -> None:
    """The springs of mass i, then mass i."""
    for entry in range(first[i], first[i + 1]):
        force_of_spring(spring[entry], x, v, springs, rest_lengths, stiffness, damping, forces)
    acceleration_of_mass(i, v, forces, masses, drag, gravity, fixed, first, spring, sign, out)


#: Whoever may write what: each function is compiled once.
KINDS = {
    "i": "int64",
    **dict.fromkeys(("x", "v"), array(2)),
    "springs": array(2, "int64"),
    **dict.fromkeys(("rest_lengths", "stiffness", "damping", "masses", "gravity", "sign"), array(1)),
    "drag": "float64",
    "fixed": array(1, "boolean"),
    **dict.fromkeys(("first", "spring"), array(1, "int64")),
    **dict.fromkeys(("forces", "out"), array(2, written=True)),
}

*_, _all_accelerations, _one_acceleration = compiled(
    spring_force, force_of_spring, acceleration_of_mass, all_accelerations, one_acceleration, kinds=KINDS
)


class SpringMotion:
    """The equations of motion of a mass-spring system, as a scheme sees them.

    Args:
        system: what moves.
    """

    def __init__(self, system: MassSpringSystem) -> None:
        self.system = system
        self.start = system.start
        self._masses_and_weight = (system.masses, system.drag, system.gravity, system.fixed, *springs_of_masses(system))
        self._pulled = None
        if system.pulls.any():
            self._pulled = np.where(system.fixed[:, None], 0.0, system.pulls / system.masses[:, None])
        self._none = np.zeros(len(system.springs))
        self._forces = np.empty((len(system.springs), system.dimension))

    def acceleration(self, state: State, damping: bool = True) -> Array:
        """Accelerations of all masses [m/s^2], shape (n, d), as a new array; zero for fixed masses.

        Args:
            damping: False leaves out the damping of the springs, for schemes that treat it apart. Drag stays in.
        """
        out = np.empty_like(state.positions)
        springs = self._springs_at(state, damping)
        _all_accelerations(*_rows(state), *springs, *self._masses_and_weight, self._forces, out)
        besides = self._besides(state)
        return out if besides is None else out + besides

    def acceleration_of(self, i: int, state: State) -> Array:
        """Acceleration of mass i alone [m/s^2], shape (d,): all the lecture's per-link function sees."""
        out = np.empty_like(state.positions)
        springs = self._springs_at(state)
        _one_acceleration(i, *_rows(state), *springs, *self._masses_and_weight, self._forces, out)
        besides = self._besides(state)
        return out[i] if besides is None else out[i] + besides[i]

    def _besides(self, state: State) -> Array | None:
        """What pulls and angular springs give all masses besides [m/s^2], shape (n, d); None where there are none."""
        angular = self.system.angular_springs
        if angular is None:
            return self._pulled
        bent = forces_on_masses(angular, state.positions) / self.system.masses[:, None]
        bent[self.system.fixed] = 0.0
        return bent if self._pulled is None else bent + self._pulled

    def _springs_at(self, state: State, damping: bool = True) -> tuple[IntArray, Array, Array, Array]:
        """What springs join, their rest lengths, and the stiffness and damping they have at a state."""
        system = self.system
        stiffness, damped = system.stiffness, system.damping
        if system.nonlinear:
            stretch = stretches(system, state.positions)
            stiffness, damped = secant_stiffness(system, stretch), damping_at(system, stretch)
        return system.springs, system.rest_lengths, stiffness, damped if damping else self._none

    def slope(self, state: State) -> Slope:
        """The rate of change of the whole state: velocities and accelerations."""
        return Slope(1.0, state.velocities, self.acceleration(state))

    def placed(self, state: State) -> State:
        """Where springs have their directions: where the masses are."""
        return state

    def jacobians(self, state: State) -> tuple[Blocks, Blocks]:
        """The derivatives of the forces by positions [N/m] and by velocities [N s/m], spring by spring."""
        return blocks_by_loop(self.system, state)

    def state_of(self, state: State) -> State:
        """A state of the masses is one of its own."""
        return state

    def trajectory(self, states: list[State]) -> Trajectory:
        """The states of a run as the trajectory of the masses."""
        return Trajectory.of(states)


def _rows(state: State) -> tuple[Array, Array]:
    """Positions and velocities as the compiled functions take them: row by row."""
    return np.ascontiguousarray(state.positions, np.float64), np.ascontiguousarray(state.velocities, np.float64)


def springs_of_masses(system: MassSpringSystem) -> tuple[IntArray, IntArray, Array]:
    """Which springs each mass feels: (first, spring, sign), the springs of mass i at first[i]:first[i + 1].

    The sign is +1 where the mass is the spring's first, -1 where it is its second. Springs stay in their order.
    """
    ends = system.springs.ravel()
    spring = np.repeat(np.arange(len(system.springs)), 2)
    sign = np.tile([1.0, -1.0], len(system.springs))
    by_mass = np.argsort(ends, kind="stable")
    first = np.concatenate([[0], np.cumsum(np.bincount(ends, minlength=len(system.masses)))])
    return first.astype(np.int64), spring[by_mass], sign[by_mass]
