"""MuJoCo Warp with point masses on slide joints, joined by tendons that are springs. 2D and 3D, single precision.

The model is made by MuJoCo, of the version that MuJoCo Warp asks for, and then given to Warp's kernels. They are
compiled at the first step: that takes minutes, once.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from engines.engine import LINEAR_SPRINGS, Precision, changed, refuse_beyond
from engines.mujoco.common import mujoco_module, without
from engines.mujoco.tendons import MujocoTendons, TendonSimulation, tendon_spec
from reference.state import Array
from reference.system import MassSpringSystem, Value

Integrator = Literal["Euler", "RK4"]

#: The scheme of each.
SCHEMES: Mapping[Integrator, str] = {"Euler": "kick_drift", "RK4": "rk4"}

#: Parts of the step the lab does without. It has no autoreset that could be switched off.
OFF = ("CONTACT", "CONSTRAINT", "ACTUATION", "SENSOR", "EULERDAMP")


@dataclass(frozen=True)
class MujocoWarpTendons:
    """As MujocoTendons, by the same model."""

    name: str
    integrator: Integrator
    package: str = "mujoco-warp"
    precision: Precision = "single"
    capabilities: frozenset[str] = LINEAR_SPRINGS

    @property
    def identified_as(self) -> Mapping[str, str]:
        """The schemes written out above, with damping and drag too."""
        return dict.fromkeys(("plain", "damping", "drag"), SCHEMES[self.integrator])

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen, and what of the step is switched off."""
        return {"integrator": self.integrator, "disabled": list(OFF), "device": "cpu"}

    @property
    def semantics(self) -> str:
        """What its numbers mean."""
        return (
            "stiffness is k [N/m] and damping c [N s/m] of each tendon, explicit; drag is Cd [N s/m] as damping of "
            "every slide joint, explicit"
        )

    def start(self, system: MassSpringSystem, dt: float) -> MujocoWarpSimulation:
        """The system as bodies and tendons. Raises Unsupported beyond the capabilities."""
        refuse_beyond(self, system)
        return MujocoWarpSimulation(self, system, dt)


class MujocoWarpSimulation:
    """A model of MuJoCo's on Warp's side, one world of it."""

    def __init__(self, engine: MujocoWarpTendons, system: MassSpringSystem, dt: float) -> None:
        warp: Any = importlib.import_module("warp")
        warp.config.quiet = True
        warp.set_device("cpu")
        self._warp: Any = importlib.import_module("mujoco_warp")
        self._engine, self._system = engine, system
        mujoco = mujoco_module()
        self._made = tendon_spec(mujoco, system, False, dt).compile()
        self._made.opt.timestep = dt
        self._made.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{engine.integrator.upper()}")
        self._made.opt.disableflags = without(mujoco, OFF)
        # writes parameters into the model, and is never stepped
        self._writer = TendonSimulation(MujocoTendons("mujoco_tendons", engine.integrator), mujoco, self._made, system)
        self._hand_on()
        self._data = self._warp.make_data(self._made)
        for coordinates, rows in ((self._data.qpos, system.positions), (self._data.qvel, system.velocities)):
            coordinates.assign(rows[~system.fixed].reshape(1, -1).astype(np.float32))

    def step(self) -> None:
        """One mujoco_warp.step."""
        self._warp.step(self._model, self._data)

    def bare_step(self) -> Callable[[], object]:
        """Its arguments are what the adapter gives it, so the adapter's step is the engine's."""
        return self.step

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities: a coordinate for each axis of each free mass."""
        system = self._system
        x, v = system.positions.copy(), np.zeros_like(system.positions)
        x[~system.fixed] = self._data.qpos.numpy()[0].reshape(-1, system.dimension)
        v[~system.fixed] = self._data.qvel.numpy()[0].reshape(-1, system.dimension)
        return x, v

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter can change between two steps: the model is handed on anew, the state stays."""
        self._system = changed(self._engine, self._system, parameter, value)
        self._writer.go_on_with(self._system, parameter)
        self._hand_on()

    def _hand_on(self) -> None:
        self._model = self._warp.put_model(self._made)


ENGINES = (
    MujocoWarpTendons("mujoco_warp_tendons", "Euler"),
    MujocoWarpTendons("mujoco_warp_tendons_rk4", "RK4"),
)
