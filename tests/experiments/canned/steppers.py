"""Steppers of whom only names and kinds are asked: no engine is started."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from reference.changes import Change
from reference.outcome import Outcome
from reference.system import MassSpringSystem

#: Engines, and the schemes that they are taken to be here: as many, and as long names, as the registry has.
SCHEME_OF = {
    "bullet_softbody": "kick_drift",
    "exudyn_springs": "rk4",
    "exudyn_springs_euler": "euler",
    "exudyn_springs_verlet": "velocity_verlet",
    "mujoco_cable": "pendulum_kick_drift",
    "mujoco_cable_rk4": "pendulum_rk4",
    "mujoco_flex": "kick_drift",
    "mujoco_flex_rk4": "rk4",
    "mujoco_rope": "rope_kick_drift",
    "mujoco_tendons": "kick_drift",
    "mujoco_tendons_eulerdamp": "kick_drift",
    "mujoco_tendons_rk4": "rk4",
    "mujoco_tendons_implicit": "kick_drift",
    "pymunk_springs": "drift_kick",
    "pymunk_springs_backward": "drift_kick",
}


@dataclass(frozen=True)
class Named:
    """A stepper that has a name, and must not be run."""

    name: str
    kind: str = "engine"
    version: str | None = "1.0"

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """Nobody may ask."""
        raise AssertionError(f"{self.name} was run")
