"""The step map: how a scheme's step answers a small perturbation of an equilibrium.

One step is a map z -> Phi(z) of the whole state z = (positions, dt velocities). About an equilibrium a perturbation dz
becomes J dz, with J the Jacobian of Phi. This asks nothing about how a step is made: in-place variants have a J like
any other. What a multistep scheme remembers is part of z.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from reference.schemes.catalogue import Scheme
from reference.state import Array, State
from reference.theory.differences import differences
from reference.theory.equilibria import Equilibrium
from reference.theory.layout import layout_of
from reference.theory.step_on_obstacles import settled_on_obstacles

Complex = npt.NDArray[np.complex128]

#: How far rounding moves a pair of eigenvalues 1 apart.
TORN_APART = 3e-6


def step_jacobian(scheme: Scheme, rest: Equilibrium, dt: float) -> Array:
    """J over the free positions, dt x velocities, and what a multistep scheme remembers: exactly where it can be.

    About an equilibrium of springs, or of a pendulum, a scheme that is `linear` is given the linearised equations of
    motion and the identity matrix in place of a state, and its own function returns J. Others are differenced; so is a
    step from a rest on obstacles (`step_on_obstacles`).
    """
    if rest.contacts is not None:
        return settled_on_obstacles(scheme, rest, dt)[1]
    if rest.linear_motion is not None and scheme.linear:
        return _by_linear_motion(scheme, rest, dt)
    layout, settled = layout_of(scheme, rest, dt)
    return differences(scheme.on(rest.motion), layout, settled)


def settled_state(scheme: Scheme, rest: Equilibrium, dt: float) -> State:
    """Where a scheme's steps stay: at the rest itself; on obstacles near it, as its steps see it (`step_on_obstacles`).

    Raises:
        SolverError: if on obstacles there is no such state.
    """
    return layout_of(scheme, rest, dt)[1] if rest.contacts is None else settled_on_obstacles(scheme, rest, dt)[0]


def resisted(values: Complex, unresisted: int, unit: float) -> Complex:
    """The eigenvalues of a step without those of motion that nothing resists, which goes on as it is begun.

    These are 1, in pairs that rounding tears apart by its own root. Others may lie near 1 too: a step that writes what
    it still reads lets even such motion grow.

    Args:
        values: all of them.
        unresisted: how many there are at most.
        unit: dt over the fastest motion's 1/w.
    """
    return values[is_resisted(values - 1, unresisted, unit)]


def is_resisted(b: Complex, unresisted: int, unit: float) -> npt.NDArray[np.bool_]:
    """The same of eigenvalues 1 + b, by their b: which of them are kept."""
    by_distance = np.argsort(np.abs(b), kind="stable")
    kept = np.ones(len(b), dtype=bool)
    nearest = by_distance[:unresisted]
    kept[nearest] = np.abs(b[nearest]) > TORN_APART * max(1.0, unit)
    return kept


def _by_linear_motion(scheme: Scheme, rest: Equilibrium, dt: float) -> Array:
    assert rest.linear_motion is not None
    layout, _ = layout_of(scheme, rest, dt)
    nothing = np.zeros((*rest.state.positions.shape, layout.size))
    state = layout.state(np.eye(layout.size), State(0.0, nothing, nothing, (nothing,) * layout.remembered))
    return layout.vector(scheme.on(rest.linear_motion)(state, dt))
