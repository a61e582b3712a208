"""How a whole state is one vector z: free positions, dt x velocities, dt x what a multistep scheme remembers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from reference.schemes.catalogue import Scheme
from reference.state import Array, State
from reference.theory.equilibria import Equilibrium

#: So many steps, each from rest, and the impulses that hold springs there have come to what they are.
WARM_STEPS = 200


@dataclass(frozen=True)
class Layout:
    """How a whole state is one vector z: free positions, dt x velocities, dt x what is remembered.

    Attributes:
        rest: about which it is told.
        dt: the step [s].
        remembered: how many arrays of the masses the scheme remembers.
        of_springs: how many numbers it remembers of the springs, one array: the impulses of a warm start.
    """

    rest: Equilibrium
    dt: float
    remembered: int
    of_springs: int = 0

    @cached_property
    def block(self) -> int:
        """How many numbers of z are positions."""
        return self.rest.state.positions[self.rest.free].size

    @property
    def size(self) -> int:
        """Of z."""
        return (2 + self.remembered) * self.block + self.of_springs

    def state(self, z: Array, about: State) -> State:
        """The state z away from another one; z is one vector, or many as columns."""
        of_masses, of_springs = z[: self.size - self.of_springs], z[self.size - self.of_springs :]
        parts = of_masses.reshape(2 + self.remembered, *self.rest.state.positions[self.rest.free].shape, *z.shape[1:])
        whole = [np.array(q) for q in (about.positions, about.velocities, *about.memory)]
        for array, part, unit in zip(whole[: 2 + self.remembered], parts, self._units, strict=True):
            array[self.rest.free] += part / unit
        if self.of_springs:
            whole[-1] += of_springs / self.dt
        return State(0.0, whole[0], whole[1], tuple(whole[2:]))

    def vector(self, state: State) -> Array:
        """The reverse, of one state or of many, as columns."""
        whole = (state.positions, state.velocities, *state.memory)
        parts = [unit * q[self.rest.free] for q, unit in zip(whole[: 2 + self.remembered], self._units, strict=True)]
        columns = [part.reshape(self.block, -1) for part in parts]
        if self.of_springs:
            columns.append(self.dt * state.memory[-1].reshape(self.of_springs, -1))
        return np.concatenate(columns)

    @cached_property
    def _units(self) -> list[float]:
        """Of what is remembered nobody knows the unit, and none matters to eigenvalues."""
        return [1.0, *[self.dt] * (1 + self.remembered)]


def layout_of(scheme: Scheme, rest: Equilibrium, dt: float) -> tuple[Layout, State]:
    """How states are vectors, and the state at rest with all that a scheme remembers of having been there."""
    if scheme.one_step:
        return Layout(rest, dt, 0), rest.state
    memory = scheme.on(rest.motion)(rest.state, dt).memory
    if memory and memory[-1].shape != rest.state.positions.shape:
        return _warm_layout(scheme, rest, dt)
    return Layout(rest, dt, len(memory)), rest.state.remembering(*memory)


def _warm_layout(scheme: Scheme, rest: Equilibrium, dt: float) -> tuple[Layout, State]:
    """Of a scheme that keeps impulses of springs: what it keeps at rest is what stays the same in a step from there."""
    step, state = scheme.on(rest.motion), rest.state
    for _ in range(WARM_STEPS):
        kept = step(state, dt).memory
        state = rest.state.remembering(*kept)
    return Layout(rest, dt, len(kept) - 1, len(kept[-1])), state
