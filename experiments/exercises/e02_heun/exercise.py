"""One mass on a spring, by Heun's step (slide 6)."""

from __future__ import annotations

from typing import Any

from experiments.exercises.exercise import Exercise
from experiments.exercises.force_mistakes import OF_A_SPRING
from experiments.exercises.one_mass import on_one_mass, questions_on_one, step_of_one
from experiments.exercises.step_mistakes import OF_A_STEP, OF_HEUN, OF_INERTIA, OTHERS

#: On one mass, whose motion is linear, these are the same as Heun's step.
SAME = ("midpoint", "ralston")


def step(y: float, v: float, dt: float, spring: Any, scheme: str = "heun", **parameters: Any) -> tuple[float, float]:
    """Heun's step; see `one_mass` for its parameters."""
    return step_of_one(y, v, dt, spring, scheme, **parameters)


EXERCISE = Exercise(
    title="The same mass, by Heun",
    minutes=30,
    goals="A guess and its correction: two slopes, their average, second order.",
    solutions={"step": step},
    questions=questions_on_one,
    mistakes=(
        *OF_HEUN,
        *on_one_mass((*OF_A_SPRING, *OF_INERTIA, *OF_A_STEP)),
        *(other for other in OTHERS if other.name not in ("heun", *SAME)),
    ),
)
