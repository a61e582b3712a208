"""One mass on a spring, by Euler's step (slides 2 and 15)."""

from __future__ import annotations

from typing import Any

from experiments.exercises.exercise import Exercise
from experiments.exercises.solutions.force_mistakes import OF_A_SPRING
from experiments.exercises.solutions.one_mass import on_one_mass, questions_on_one, step_of_one
from experiments.exercises.solutions.step_mistakes import OF_A_STEP, OF_EULER, OF_INERTIA, OTHERS

#: On one mass, whose motion is linear, these are the same as Heun's step.
SAME = ("midpoint", "ralston")


def step(y: float, v: float, dt: float, spring: Any, scheme: str = "euler", **parameters: Any) -> tuple[float, float]:
    """Euler's step; see `one_mass` for its parameters."""
    return step_of_one(y, v, dt, spring, scheme, **parameters)


EXERCISE = Exercise(
    title="One mass on a spring, by Euler",
    minutes=30,
    goals="Turn a force into a step: F = m a, and what dt does. See Euler's step gain energy.",
    solutions={"step": step},
    questions=questions_on_one,
    mistakes=[
        *on_one_mass((*OF_A_SPRING, *OF_INERTIA, *OF_A_STEP)),
        *OF_EULER,
        *(other for other in OTHERS if other.name not in ("euler", *SAME)),
    ],
)
