"""A string that every scheme has moved, and what the tests of identification play back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from reference.changes import Change
from reference.identification import (
    candidates,
)
from reference.outcome import Outcome
from reference.state import Trajectory
from reference.system import MassSpringSystem
from tests.reference.systems import moving_string

DT, STEPS = 1e-3, 100


#: Where theory says that two schemes are one: the catalogue's first is named. Without damping or drag there is nothing
#: to treat implicitly; springs that give up 1 - exp(-0.03) of their rate need fewer than ten rounds.
SAME_AS = {
    "plain": {
        "kick_drift_implicit_damping": "kick_drift",
        "kick_drift_implicit_drag": "kick_drift",
        "kick_drift_implicit_damping_and_drag": "kick_drift",
        "kick_drift_truncated_damping": "kick_drift",
        "drift_kick_implicit_damping": "drift_kick",
        "drift_kick_sequential_damping": "drift_kick",
        "drift_kick_exponential_damping": "drift_kick",
    },
    "dragged": {
        "kick_drift_implicit_damping": "kick_drift",
        "kick_drift_implicit_damping_and_drag": "kick_drift_implicit_drag",
        "kick_drift_truncated_damping": "kick_drift",
        "drift_kick_implicit_damping": "drift_kick",
        "drift_kick_sequential_damping": "drift_kick",
        "drift_kick_exponential_damping": "drift_kick",
    },
    "damped": {
        "kick_drift_implicit_drag": "kick_drift",
        "kick_drift_implicit_damping_and_drag": "kick_drift_implicit_damping",
        "drift_kick_exponential_damping": "drift_kick_sequential_damping",
    },
    "both": {"drift_kick_exponential_damping": "drift_kick_sequential_damping"},
}


PARAMETERS: dict[str, dict[str, Any]] = {
    "plain": {},
    "dragged": {"drag": 0.05},
    "damped": {"damping": 0.3},
    "both": {"damping": 0.3, "drag": 0.05},
}


@cache
def known(case: str) -> tuple[MassSpringSystem, dict[str, Trajectory]]:
    """A moving string, and the whole catalogue's trajectories of it."""
    system = moving_string(4, **PARAMETERS[case])
    return system, candidates(system, DT, STEPS)


@dataclass(frozen=True)
class Recorded:
    """A stepper that plays an outcome."""

    outcome: Outcome
    name: str = "recorded"
    kind: str = "engine"
    version: str | None = None

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """The outcome, whatever is asked."""
        return self.outcome


def shifted(system: MassSpringSystem, by: float, length: int = 3) -> Trajectory:
    """A trajectory that stands still, its last mass off by so much."""
    positions = np.repeat(system.positions[None], length, axis=0)
    positions[1:, -1, 0] += by
    return Trajectory(np.linspace(0.0, DT * (length - 1), length), positions, np.zeros_like(positions))


#: Of the wide catalogue, which scheme each is without damping and drag.
WIDE_SAME_AS = {
    "kick_drift_drag_afterwards": "kick_drift",
    "kick_drift_exponential_drag": "kick_drift",
    "leapfrog_kick_drift_kick": "velocity_verlet",
    "stormer_verlet": "velocity_verlet",
}
