"""The forces on a mesh of springs, and so its equations of motion: the lecture's slides 4-5 and 9-10, on any mesh.

A spring pulls the two masses it joins together with the force

    F = k (length - rest length) + c (rate at which it lengthens)

and a mass feels its springs, its weight m g, and the drag -Cd v. The kernels are compiled by Numba and cached on disk.
Every spring is computed once; then each mass sums the pulls of its own springs in their order. A mass alone
(`acceleration_of`) is given exactly the bits it has within the whole. A spring of no length, which has no direction,
gives forces that are not numbers (Numba's "numpy" error model), and so a run that diverges.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from reference.assembly import Blocks, spring_blocks
from reference.state import Array, Slope, State, Trajectory
from reference.system import IntArray, MassSpringSystem


@njit(cache=True, error_model="numpy")
def spring_force(stiffness, stretch, damping, lengthening):  # type: ignore[no-untyped-def]
    """The force law [N]: k times how much longer than at rest, plus c times how fast it lengthens."""
    return stiffness * stretch + damping * lengthening


@njit(cache=True, error_model="numpy")
def spring_pull(j, x, v, springs, rest_lengths, stiffness, damping, pull):  # type: ignore[no-untyped-def]
    """Write the force of spring j on its first mass [N] to pull[j]; on its second mass it is the opposite."""
    a, b = springs[j, 0], springs[j, 1]
    dimension = x.shape[1]
    squares = 0.0
    for axis in range(dimension):
        gap = x[b, axis] - x[a, axis]
        pull[j, axis] = gap
        squares += gap * gap
    length = np.sqrt(squares)
    lengthening = 0.0
    for axis in range(dimension):
        pull[j, axis] /= length
        lengthening += pull[j, axis] * (v[b, axis] - v[a, axis])
    force = spring_force(stiffness[j], length - rest_lengths[j], damping[j], lengthening)
    for axis in range(dimension):
        pull[j, axis] *= force


@njit(cache=True, error_model="numpy")
def mass_acceleration(i, v, pull, masses, drag, gravity, fixed, first, spring, sign, out):  # type: ignore[no-untyped-def]
    """Write the acceleration of mass i [m/s^2] to out[i], from its weight, its springs' pulls and its drag."""
    for axis in range(out.shape[1]):
        force = masses[i] * gravity[axis]
        for entry in range(first[i], first[i + 1]):
            force += sign[entry] * pull[spring[entry], axis]
        force -= drag * v[i, axis]
        out[i, axis] = 0.0 if fixed[i] else force / masses[i]


@njit(cache=True, error_model="numpy")
def all_accelerations(  # type: ignore[no-untyped-def]
    x, v, springs, rest_lengths, stiffness, damping, masses, drag, gravity, fixed, first, spring, sign, pull, out
):
    """Springs first, each once; then every mass sums its own."""
    for j in range(len(springs)):
        spring_pull(j, x, v, springs, rest_lengths, stiffness, damping, pull)
    for i in range(len(masses)):
        mass_acceleration(i, v, pull, masses, drag, gravity, fixed, first, spring, sign, out)


@njit(cache=True, error_model="numpy")
def one_acceleration(  # type: ignore[no-untyped-def]
    i, x, v, springs, rest_lengths, stiffness, damping, masses, drag, gravity, fixed, first, spring, sign, pull, out
):
    """The springs of mass i, then mass i."""
    for entry in range(first[i], first[i + 1]):
        spring_pull(spring[entry], x, v, springs, rest_lengths, stiffness, damping, pull)
    mass_acceleration(i, v, pull, masses, drag, gravity, fixed, first, spring, sign, out)


class SpringMotion:
    """The equations of motion of a mass-spring system, as a scheme sees them.

    Args:
        system: what moves.
    """

    def __init__(self, system: MassSpringSystem) -> None:
        self.system = system
        self.start = system.start
        self._masses_and_weight = (system.masses, system.drag, system.gravity, system.fixed, *springs_of_masses(system))
        self._law = (system.springs, system.rest_lengths, system.stiffness)
        self._none = np.zeros(len(system.springs))
        self._pull = np.empty((len(system.springs), system.dimension))

    def acceleration(self, state: State, damping: bool = True) -> Array:
        """Accelerations of all masses [m/s^2], shape (n, d), as a new array; zero for fixed masses.

        Args:
            damping: False leaves out the damping of the springs, for schemes that treat it apart. Drag stays in.
        """
        out = np.empty_like(state.positions)
        law = (*self._law, self.system.damping if damping else self._none)
        all_accelerations(state.positions, state.velocities, *law, *self._masses_and_weight, self._pull, out)
        return out

    def acceleration_of(self, i: int, state: State) -> Array:
        """Acceleration of mass i alone [m/s^2], shape (d,): all the lecture's per-link function sees."""
        out = np.empty_like(state.positions)
        law = (*self._law, self.system.damping)
        one_acceleration(i, state.positions, state.velocities, *law, *self._masses_and_weight, self._pull, out)
        return out[i]

    def slope(self, state: State) -> Slope:
        """The rate of change of the whole state: velocities and accelerations."""
        return Slope(1.0, state.velocities, self.acceleration(state))

    def placed(self, state: State) -> State:
        """Where springs have their directions: where the masses are."""
        return state

    def jacobians(self, state: State) -> tuple[Blocks, Blocks]:
        """The derivatives of the forces by positions [N/m] and by velocities [N s/m], spring by spring."""
        return spring_blocks(self.system, state)

    def trajectory(self, states: list[State]) -> Trajectory:
        """The states of a run as the trajectory of the masses."""
        return Trajectory.of(states)


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
