"""Labs without a page: opened, moved at random, compared."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

import numpy as np

from reference.changes import Change
from reference.state import State
from report.live.lab import Lab

#: Of a scheme every bit is the same; an engine that is given its present state again rounds it once.
ROUNDING = 1e-12

#: What is moved, and how far.
MOVES = {"stiffness": (100, 300), "mass": (0.015, 0.03), "drag": (0, 0.1), "gravity": (1, 20), "damping": (0, 0.02)}


def open_lab(labs: list[Lab], scene: str = "string", steppers: Sequence[str] = ("kick_drift",), **settings: str) -> Lab:
    """A lab that is ended after the test."""
    labs.append(Lab(scene, steppers, settings))
    return labs[-1]


def apart(one: State, other: State) -> float:
    """The largest difference of a position [m] or velocity [m/s]."""
    return max(
        float(np.abs(one.positions - other.positions).max()), float(np.abs(one.velocities - other.velocities).max())
    )


def go_on(lab: Lab, steps: int) -> None:
    """So many steps, in frames, or until something stops."""
    for _ in range(0, steps, 20):
        lab.advance(20)


def move_at_random(lab: Lab, seed: int, moves: int = 12) -> list[Change]:
    """Move sliders at random between frames; what was moved, and when."""
    random, made = Random(seed), []
    for _ in range(moves):
        lab.advance(random.randint(1, 30))
        name = random.choice(list(MOVES))
        value = random.uniform(*MOVES[name])
        lab.set_parameter(name, value)
        made.append(Change(lab.timeline.segment.steps * lab.timeline.dt, name, value))
    lab.advance(20)
    return made
