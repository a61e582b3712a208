"""A scheme's stability limit, measured: it is run from rest perturbed along its fastest mode, and that mode is watched.

Theory says which mode that is, the eigenvector of the step's Jacobian whose eigenvalue is largest; what becomes of it
is seen in a run of the scheme itself. In one mode alone growth of a millionth in a step shows within some hundred
steps.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from reference.errors import SolverError
from reference.limit import Limit
from reference.measured_stability import GROWN, PERTURBATION, mode_growth
from reference.schemes.catalogue import Scheme
from reference.state import Array
from reference.theory.equilibria import Equilibrium
from reference.theory.limits import fastest_rate, find_limit
from reference.theory.step_map import layout_of, step_jacobian

#: How many steps a mode is watched.
STEPS = 200

#: What a run shows of growth in a step where there is none: rounding, and what is not linear.
MARGIN = 1e-8

#: The limit is found to this part of itself.
PRECISION = 1e-5


@dataclass(frozen=True)
class FastestMode:
    """The mode of a scheme's step that grows fastest, as vectors (`step_map.Layout`).

    Attributes:
        shape: the real part of the eigenvector.
        left: the left eigenvector, which tells the mode from all others.
    """

    shape: Array
    left: Array


def measured_mode_limit(scheme: Scheme, rest: Equilibrium) -> Limit:
    """The dt up to which a scheme, run from a perturbation along its fastest mode, does not let it grow."""
    return find_limit(lambda dt: measured_mode_growth(scheme, rest, dt), 1 / fastest_rate(rest), MARGIN, PRECISION)


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def measured_mode_growth(scheme: Scheme, rest: Equilibrium, dt: float) -> float:
    """By how much of itself the fastest mode grows in a step [1]; infinite where the scheme comes to no next state."""
    try:
        mode = fastest_mode_of_step(scheme, rest, dt)
        return np.inf if mode is None else mode_growth(np.array([*offsets(scheme, rest, dt, mode.shape)]), mode.left)
    except (SolverError, np.linalg.LinAlgError):
        return np.inf


def fastest_mode_of_step(scheme: Scheme, rest: Equilibrium, dt: float) -> FastestMode | None:
    """The eigenvectors of the step's largest eigenvalue; None where its Jacobian is not finite."""
    jacobian = step_jacobian(scheme, rest, dt)
    if not np.isfinite(jacobian).all():
        return None
    values, modes = np.linalg.eig(jacobian)
    fastest = int(np.argmax(np.abs(values)))
    return FastestMode(modes[:, fastest].real, np.linalg.inv(modes)[fastest].conj())


def offsets(scheme: Scheme, rest: Equilibrium, dt: float, shape: Array) -> Iterator[Array]:
    """How far from rest a run is after every step, the start first, as vectors like the shape it starts in.

    It ends after STEPS, or once the perturbation is GROWN times as large: what comes then says no more.
    """
    size = PERTURBATION * rest.scale
    layout, settled = layout_of(scheme, rest, dt)
    at_rest, step = layout.vector(settled), scheme.on(rest.motion)
    state = layout.state(shape * (size / np.abs(shape).max()), settled)
    for _ in range(STEPS + 1):
        offset = (layout.vector(state) - at_rest)[:, 0]
        yield offset
        if not np.abs(offset[: layout.block]).max() <= GROWN * size:
            return
        state = step(state, dt)
