"""How a whole state is one vector z: free positions, dt x velocities, and what a multistep scheme remembers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from reference.schemes.catalogue import Scheme
from reference.state import Array, State
from reference.theory.equilibria import Equilibrium

#: So many steps, each from rest, and the impulses that hold springs there have come to what they are.
WARM_STEPS = 200

#: Moves that tell in which units a scheme remembers, as a part of the length they are to be small against.
SMALL = 1e-6


@dataclass(frozen=True)
class Layout:
    """How a whole state is one vector z: free positions, dt x velocities, and what is remembered.

    Attributes:
        rest: about which it is told.
        dt: the step [s].
        remembered: how many arrays of the masses the scheme remembers.
        units: by what each of these is multiplied; dt where none are given.
        of_springs: how many numbers it remembers of the springs, one array: the impulses of a warm start.
    """

    rest: Equilibrium
    dt: float
    remembered: int
    of_springs: int = 0
    units: tuple[float, ...] = ()

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
        return [1.0, self.dt, *(self.units or [self.dt] * self.remembered)]


def layout_of(scheme: Scheme, rest: Equilibrium, dt: float) -> tuple[Layout, State]:
    """How states are vectors, and the state at rest with all that a scheme remembers of having been there."""
    if scheme.one_step:
        return Layout(rest, dt, 0), rest.state
    memory = scheme.on(rest.motion)(rest.state, dt).memory
    if memory and memory[-1].shape != rest.state.positions.shape:
        return _warm_layout(scheme, rest, dt)
    return Layout(rest, dt, len(memory), units=_units(scheme, rest, dt, memory)), rest.state.remembering(*memory)


def _units(scheme: Scheme, rest: Equilibrium, dt: float, at_rest: tuple[Array, ...]) -> tuple[float, ...]:
    """By what arrays that are remembered are multiplied to be as large as the moves that they are of.

    To eigenvalues no unit matters, to differences it does: a position over dt would be moved far from rest.
    """
    size = SMALL * rest.scale
    moves = np.where(rest.free[:, None], size, 0.0) * np.random.default_rng(0).uniform(
        -1, 1, rest.state.positions.shape
    )
    moved = State(0.0, rest.state.positions + moves, rest.state.velocities + moves / dt)
    changes = [np.abs(q - r).max() for q, r in zip(scheme.on(rest.motion)(moved, dt).memory, at_rest, strict=True)]
    return tuple(float(size / change) if change > 0 else dt for change in changes)


def _warm_layout(scheme: Scheme, rest: Equilibrium, dt: float) -> tuple[Layout, State]:
    """Of a scheme that keeps impulses of springs: what it keeps at rest is what stays the same in a step from there."""
    step, state = scheme.on(rest.motion), rest.state
    for _ in range(WARM_STEPS):
        kept = step(state, dt).memory
        state = rest.state.remembering(*kept)
    return Layout(rest, dt, len(kept) - 1, len(kept[-1])), state
