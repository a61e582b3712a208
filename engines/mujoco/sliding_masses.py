"""Point masses in MuJoCo, on one slide joint per axis: what is read from them, and how they step and change."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import partial
from types import ModuleType
from typing import Any

import numpy as np

from engines.vectors import three
from reference.pulls import is_pull
from reference.springs.angular_law import forces_on_masses
from reference.state import Array
from reference.system import MassSpringSystem


class SlidingMasses(ABC):
    """A system in MuJoCo. The coordinates are positions, or with nested bodies the steps from each to the next.

    Args:
        model: complete but for the system's parameters, its bodies those of the free masses in their order, and none of
            the fixed.
        nested: whether each body is inside the one before it.
    """

    def __init__(self, mujoco: ModuleType, model: Any, system: MassSpringSystem, nested: bool = False) -> None:
        self._mujoco, self._model, self._system, self._nested = mujoco, model, system, nested
        self._write_parameters()
        self._data = mujoco.MjData(model)
        # MuJoCo's own memory seen as one row per free mass
        self._q = self._data.qpos.reshape(-1, system.dimension)
        self._v = self._data.qvel.reshape(-1, system.dimension)
        free, fixed = np.flatnonzero(~system.fixed), np.flatnonzero(system.fixed)
        self._q[:] = self._coordinates(system.positions[free])
        self._v[:] = self._coordinates(system.velocities[free])
        # what a state is read from: the free masses first, then the fixed; in order only once taken out
        order = np.concatenate([free, fixed])
        self._order = np.argsort(order, kind="stable")
        self._positions, self._velocities = system.positions[order], system.velocities[order]
        self._free_positions, self._free_velocities = self._positions[: len(free)], self._velocities[: len(free)]
        self._write_pulls()

    @abstractmethod
    def _write_parameters(self) -> None:
        """The system's parameters into the model, in double precision."""

    def go_on_with(self, system: MassSpringSystem, parameter: str) -> None:
        """Let a parameter be that of another system from here on; the state stays where it is, to the last bit."""
        self._system = system
        if is_pull(parameter):
            pass  # of the data, not of the model
        elif parameter == "gravity":  # MuJoCo keeps nothing of it, so it may change at every step at no cost
            self._model.opt.gravity[:] = three(system.gravity)
        else:
            self._write_parameters()
        self._write_pulls()

    def _write_pulls(self) -> None:
        """On every body at its centre, until it is another; body 0 is the world. Of bends as they are now."""
        system = self._system
        pulls = system.pulls
        if system.angular_springs is not None:
            pulls = pulls + forces_on_masses(system.angular_springs, self.state()[0])
        if len(self._data.xfrc_applied) > 1 and (pulls.any() or self._data.xfrc_applied.any()):
            self._data.xfrc_applied[1:, : system.dimension] = pulls[~system.fixed]

    def step(self) -> None:
        """One mj_step."""
        if self._system.angular_springs is not None:
            self._write_pulls()
        self._mujoco.mj_step(self._model, self._data)

    def bare_step(self) -> Callable[[], object]:
        """mj_step."""
        return partial(self._mujoco.mj_step, self._model, self._data)

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities, read from the coordinates alone: nothing is computed in the engine."""
        self._free_positions[:] = self._q.cumsum(axis=0) if self._nested else self._q
        self._free_velocities[:] = self._v.cumsum(axis=0) if self._nested else self._v
        return self._positions.take(self._order, axis=0), self._velocities.take(self._order, axis=0)

    def jacobian(self) -> Array | None:
        """MuJoCo's mjd_transitionFD over (qpos, qvel), centred; None for RK4, which it refuses, and for bends."""
        mujoco, model = self._mujoco, self._model
        if model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4 or self._system.angular_springs is not None:
            return None
        transition = np.zeros((2 * model.nv, 2 * model.nv))
        mujoco.mjd_transitionFD(model, self._data, 1e-6, True, transition, None, None, None)
        return transition

    def _coordinates(self, rows: Array) -> Array:
        return np.diff(rows, axis=0, prepend=0.0) if self._nested else rows
