"""Scenes whose springs are all as much longer than at rest, and engines on them."""

from __future__ import annotations

import numpy as np

from experiments import scenes
from experiments.experiment import Result
from reference.identification import Identification, Match
from reference.outcome import Outcome
from reference.scenes import Scene, find
from reference.state import Trajectory
from reference.system import MassSpringSystem
from tests.experiments.canned.steppers import Named

#: In the end springs are longer by this part of themselves, and the motion has taken this time [s].
STRETCHED, DURATION = 0.1, 0.4


def stretched(system: MassSpringSystem) -> Trajectory:
    """From its start a system is stretched about the origin, straight on."""
    times = np.linspace(0, DURATION, 5)
    positions = (1 + STRETCHED * times / DURATION)[:, None, None] * system.positions
    return Trajectory(times, positions, np.zeros_like(positions))


def run(scene: Scene, name: str, scheme: str, error: float, compared: str = "trajectories") -> scenes.Run:
    """An engine that moved, as near to a scheme [m]: identified up to 1e-12 m."""
    system = scene.system({})
    why = "" if error <= 1e-12 else f"nearest {scheme} at {error:.2g} m"
    ranking = (Match(scheme, error), Match("heun", 1.0))
    found = Identification(name, ranking, 1e-12, why, compared=compared)
    return scenes.Run(scene, system, Named(name), Outcome("done", "", stretched(system)), found)


def stopped(scene: Scene, name: str, outcome: Outcome) -> scenes.Run:
    """An engine that left nothing."""
    return scenes.Run(scene, scene.system({}), Named(name), outcome, Identification(name, (), 1e-12, "none"))


def usual(*names: str) -> Result:
    """Some scenes, by default three, with engines that are a scheme, none, crashed or unsupported there."""
    found = [find(name) for name in names or ("string", "barrier", "cloth")]
    runs = []
    for scene in found:
        runs += [
            run(scene, "pymunk_springs", "drift_kick", 1e-15),
            run(scene, "mujoco_flex", "kick_drift", 3e-14, "single steps"),
            run(scene, "bullet_softbody", "rk4", 5e-4),
            stopped(scene, "Segfaults", Outcome("crashed", "killed by SIGSEGV")),
            stopped(scene, "mujoco_cable", Outcome("unsupported", "mujoco_cable cannot do mesh")),
        ]
    motions = {scene.name: scenes.Shown(scene.system({}), stretched(scene.system({})), scene.dt) for scene in found}
    return scenes.result_of(runs, motions)


def nothing() -> Result:
    """No scene."""
    return scenes.result_of([], {})
