"""Slides of a mass on a circle by each rule, and strings that turn into the scene's circle."""

from __future__ import annotations

import numpy as np

from experiments import barrier
from experiments.barrier import ALONG, INWARDS, OWN, PRINTED, STEPS, Slide
from experiments.experiment import Result
from reference.scenes import find
from reference.state import Trajectory
from tests.experiments.canned.motions import turning

#: Where the mass leaves or stays with the smallest step [deg], and how deep it sinks in then [m], by stepper and rule.
FOUND: dict[tuple[str, str], tuple[float, float]] = {
    ("heun", INWARDS): (48.4, 0.0),
    ("kick_drift", INWARDS): (48.4, 1e-16),
    ("drift_kick", INWARDS): (47.0, 2e-16),
    ("heun", ALONG): (48.4, 0.0),
    ("kick_drift", ALONG): (60.1, 1e-16),
    ("lecture_barrier", PRINTED): (5.9, 1e-16),
    ("bullet_softbody", OWN): (48.5, 0.0),
    ("mujoco_flex", OWN): (49.5, 1e-5),
    ("mujoco_tendons", OWN): (49.5, 1e-5),
    ("pymunk_springs", OWN): (46.0, 3e-6),
}

ENGINES = [name for name, rule in FOUND if rule == OWN]


def slides() -> dict[tuple[str, str], list[Slide | None]]:
    """With larger steps the angle is off by a tenth of a degree for every ms, and the depth grows with the step."""
    found: dict[tuple[str, str], list[Slide | None]] = {}
    for key, (degrees, depth) in FOUND.items():
        made: list[Slide | None] = []
        for dt in STEPS:
            angle = float(np.radians(degrees + 1e2 * (dt - STEPS[-1])))
            leaves = None if key[1] == PRINTED else angle
            made.append(Slide(leaves, angle, depth * dt / STEPS[-1], 1e-3 * dt))
        found[key] = made
    found["pymunk_springs", OWN][0] = None
    return found


def strings() -> dict[str, Trajectory]:
    """By stepper, turning a little differently."""
    times = np.linspace(0, 1, 101)
    names = ("heun", "kick_drift", "drift_kick", "lecture_barrier", *ENGINES)
    return {name: turning(times, 1 + 0.05 * i, masses=10) for i, name in enumerate(names)}


def usual() -> Result:
    """Of these."""
    return barrier.result_of(slides(), find("barrier").system({}), strings(), ["mujoco_rope: unsupported, circle"])
