"""A string by Heun's step: the whole state at once, not link by link (slides 7-11)."""

from __future__ import annotations

from typing import Any

from experiments.exercises.exercise import Exercise
from experiments.exercises.solutions.force_mistakes import OF_A_SPRING, OF_A_STRING
from experiments.exercises.solutions.on_strings import questions_on_steps
from experiments.exercises.solutions.step_mistakes import IN_PLACE, OF_A_STEP, OF_HEUN, OF_INERTIA, OTHERS
from experiments.exercises.solutions.stepping import step as any_step
from reference.state import Array


def step(x: Array, v: Array, dt: float, string: Any, scheme: str = "heun", **parameters: Any) -> tuple[Array, Array]:
    """Heun's step; see `stepping` for its parameters."""
    return any_step(x, v, dt, string, scheme, **parameters)


EXERCISE = Exercise(
    title="The whole state, not link by link",
    minutes=60,
    goals="Why no mass may see another one advanced; copies and names of arrays.",
    solutions={"step": step},
    questions=questions_on_steps,
    mistakes=[
        *IN_PLACE,
        *OF_HEUN,
        *OF_A_SPRING,
        *OF_A_STRING,
        *OF_INERTIA,
        *OF_A_STEP,
        *(other for other in OTHERS if other.name != "heun"),
    ],
)
