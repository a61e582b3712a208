"""The Jacobian of an engine's own step: by the engine's own derivatives where it has them, else by differences.

An engine is a black box that can be started anywhere. From a state perturbed one way and the other, one coordinate
at a time, a step of each says how the step answers: the same matrix that theory makes of a scheme. Needs NumPy only.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol, runtime_checkable

import numpy as np

from engines.engine import Engine
from engines.line import started
from reference.state import Array
from reference.system import MassSpringSystem

#: A perturbation, as a part of the shortest rest length: differences of second order are best at the cube root of
#: rounding.
PERTURBATION = float(np.cbrt(np.finfo(float).eps))


@runtime_checkable
class KnowsItsJacobian(Protocol):
    """A simulation whose engine gives the derivatives of its step itself."""

    def jacobian(self) -> Array | None:
        """Of the step from the present state, in the engine's own coordinates; None where the engine refuses."""


def step_jacobian(engine: Engine, system: MassSpringSystem, dt: float) -> Array:
    """J over the free positions and dt x velocities about a system at rest, by central differences of second order.

    Raises:
        Unsupported: where the engine cannot start with stretched springs or in motion.
    """
    free = ~system.fixed
    count = int(free.sum()) * system.dimension
    size = PERTURBATION * system.shortest

    def after(z: Array) -> Array:
        x, v = system.positions.copy(), system.velocities.copy()
        x[free] += z[:count].reshape(-1, system.dimension)
        v[free] += z[count:].reshape(-1, system.dimension) / dt
        simulation = started(engine, replace(system, positions=x, velocities=v), dt)
        simulation.step()
        x, v = simulation.state()
        return np.concatenate([x[free], dt * v[free]], axis=None)

    columns = [after(z) - after(-z) for z in size * np.eye(2 * count)]
    return np.stack(columns, axis=1) / (2 * size)


def own_jacobian(engine: Engine, system: MassSpringSystem, dt: float) -> Array | None:
    """J by the engine's own derivatives, in its own coordinates (its eigenvalues are the same in any); None without."""
    simulation = started(engine, system, dt)
    return simulation.jacobian() if isinstance(simulation, KnowsItsJacobian) else None
