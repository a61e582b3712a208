"""The step map: how a scheme's step answers a small perturbation of an equilibrium.

One step is a map z -> Phi(z) of the whole state z = (positions, dt velocities). About an equilibrium a perturbation dz
becomes J dz, with J the Jacobian of Phi. This asks nothing about how a step is made: in-place variants have a J like
any other. What a multistep scheme remembers is part of z.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from reference.schemes.catalogue import Scheme
from reference.state import Array, State
from reference.theory.equilibria import Equilibrium

Complex = npt.NDArray[np.complex128]

#: How far rounding moves a pair of eigenvalues 1 apart.
TORN_APART = 3e-6


def step_jacobian(scheme: Scheme, rest: Equilibrium, dt: float) -> Array:
    """J over the free positions, dt x velocities, and what a multistep scheme remembers: exactly where it can be.

    About an equilibrium of springs a scheme that is `linear` is given the linearised equations of motion and the
    identity matrix in place of a state, and its own function returns J. Others are differenced.
    """
    exact = rest.linear is not None and scheme.linear
    return _by_linear_motion(scheme, rest, dt) if exact else _by_differences(scheme, rest, dt)


@dataclass(frozen=True)
class Layout:
    """How a whole state is one vector z: free positions, dt x velocities, dt x what is remembered.

    Attributes:
        rest: about which it is told.
        dt: the step [s].
        remembered: how many arrays the scheme remembers.
    """

    rest: Equilibrium
    dt: float
    remembered: int

    @property
    def block(self) -> int:
        """How many numbers of z are positions."""
        return self.rest.state.positions[self.rest.free].size

    @property
    def size(self) -> int:
        """Of z."""
        return (2 + self.remembered) * self.block

    def state(self, z: Array, about: State) -> State:
        """The state z away from another one; z is one vector, or many as columns."""
        parts = z.reshape(2 + self.remembered, *self.rest.state.positions[self.rest.free].shape, *z.shape[1:])
        whole = [np.array(q) for q in (about.positions, about.velocities, *about.memory)]
        for array, part, unit in zip(whole, parts, self._units, strict=True):
            array[self.rest.free] += part / unit
        return State(0.0, whole[0], whole[1], tuple(whole[2:]))

    def vector(self, state: State) -> Array:
        """The reverse, of one state or of many, as columns."""
        whole = (state.positions, state.velocities, *state.memory)
        parts = [unit * q[self.rest.free] for q, unit in zip(whole, self._units, strict=True)]
        return np.concatenate([part.reshape(self.block, -1) for part in parts])

    @property
    def _units(self) -> list[float]:
        """Of what is remembered nobody knows the unit, and none matters to eigenvalues."""
        return [1.0, *[self.dt] * (1 + self.remembered)]


def resisted(values: Complex, unresisted: int, unit: float) -> Complex:
    """The eigenvalues of a step without those of motion that nothing resists, which goes on as it is begun.

    These are 1, in pairs that rounding tears apart by its own root. Others may lie near 1 too: a step that writes what
    it still reads lets even such motion grow.

    Args:
        values: all of them.
        unresisted: how many there are at most.
        unit: dt over the fastest motion's 1/w.
    """
    by_distance = np.argsort(np.abs(values - 1), kind="stable")
    nearest, others = values[by_distance[:unresisted]], values[by_distance[unresisted:]]
    return np.concatenate([nearest[np.abs(nearest - 1) > TORN_APART * max(1.0, unit)], others])


def layout_of(scheme: Scheme, rest: Equilibrium, dt: float) -> tuple[Layout, State]:
    """How states are vectors, and the state at rest with all that a scheme remembers of having been there."""
    if scheme.one_step:
        return Layout(rest, dt, 0), rest.state
    memory = scheme.on(rest.motion)(rest.state, dt).memory
    return Layout(rest, dt, len(memory)), rest.state.remembering(*memory)


def _by_linear_motion(scheme: Scheme, rest: Equilibrium, dt: float) -> Array:
    assert rest.linear is not None
    layout, _ = layout_of(scheme, rest, dt)
    nothing = np.zeros((*rest.state.positions.shape, layout.size))
    state = layout.state(np.eye(layout.size), State(0.0, nothing, nothing, (nothing,) * layout.remembered))
    return layout.vector(scheme.on(rest.linear.motion)(state, dt))


def _by_differences(scheme: Scheme, rest: Equilibrium, dt: float) -> Array:
    """Central differences of fourth order.

    Their truncation goes as the fourth power of the perturbation and their rounding as its inverse; at the fifth root
    of rounding both are about 1e-12.
    """
    layout, settled = layout_of(scheme, rest, dt)
    small = np.finfo(float).eps ** 0.2 * rest.scale
    step = scheme.on(rest.motion)

    def after(z: Array) -> Array:
        return layout.vector(step(layout.state(z, settled), dt))[:, 0]

    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        columns = [8 * (after(z) - after(-z)) - (after(2 * z) - after(-2 * z)) for z in small * np.eye(layout.size)]
    return np.stack(columns, axis=1) / (12 * small)
