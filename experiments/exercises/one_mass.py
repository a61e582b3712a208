"""Exercises on one mass that hangs on a spring: their solution and their questions."""

from __future__ import annotations

from typing import Any

import numpy as np

from experiments.exercises.exercise import Question
from experiments.exercises.links import namespace
from experiments.exercises.stepping import DT, M_AND_SPEED, step


def step_of_one(y: float, v: float, dt: float, spring: Any, scheme: str, **knobs: Any) -> tuple[float, float]:
    """A step of a mass at height y [m], below an anchor at height 0: a string of one link, in one dimension."""
    string = namespace(
        {
            "masses": np.array([spring.mass]),
            "stiffness": np.array([spring.stiffness]),
            "rest_lengths": np.array([spring.rest_length]),
            "drag": spring.damping,
            "gravity": spring.gravity,
            "anchor": np.zeros(1),
        }
    )
    x, u = step(np.array([[float(y)]]), np.array([[float(v)]]), dt, string, scheme, **knobs)
    return float(x[0, 0]), float(u[0, 0])


def questions_on_one(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """A few springs, 20 steps of each."""
    questions = []
    for i in range(5 if hidden else 3):
        spring = {
            "mass": float(random.uniform(0.02, 0.06)),
            "stiffness": float(random.uniform(40.0, 80.0)),
            "rest_length": float(random.uniform(0.1, 0.2)),
            "damping": 0.0 if i == 4 else float(random.uniform(0.02, 0.05)),
            "gravity": 9.81 if i < 3 else 1.62,
        }
        y, v = -spring["rest_length"] * float(random.uniform(1.1, 1.4)), float(random.uniform(0.3, 1.0))
        dt = DT * float(random.uniform(0.5, 1.0))
        questions.append(Question("step", (y, v, dt, spring), ("y", "v"), f"spring {i + 1}", 20, units=M_AND_SPEED))
    return questions
