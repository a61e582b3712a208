"""One mass on a spring, by Heun's step (slide 6)."""

from __future__ import annotations

from typing import Any

import numpy as np

from experiments.exercises.exercise import Exercise, Question
from experiments.exercises.solutions.force_mistakes import OF_A_SPRING
from experiments.exercises.solutions.one_mass import EXAMPLE, on_one_mass, questions_on_one, step_of_one
from experiments.exercises.solutions.step_mistakes import OF_A_STEP, OF_HEUN, OF_INERTIA, OTHERS

#: On one mass, whose motion is linear, these are the same as Heun's step. They part where drag grows with the speed.
SAME = ("midpoint", "ralston")


def step(y: float, v: float, dt: float, spring: Any, scheme: str = "heun", **parameters: Any) -> tuple[float, float]:
    """Heun's step; see `one_mass` for its parameters."""
    return step_of_one(y, v, dt, spring, scheme, **parameters)


def where_drag_grows(random: np.random.Generator) -> list[Question]:
    """One step where the damping is a number that grows with the square of the speed it is multiplied by.

    A program that writes the force as in the text then computes another motion, one that is not linear, and its scheme
    shows. One that has the damping in a matrix, or multiplies it by dt first, answers in a way of its own.
    """
    spring = {**EXAMPLE, "damping": {"growing": 0.4}}
    return [
        Question("step", (-0.2, v, 0.01, spring), ("y", "v"), "drag that grows with the speed") for v in (1.5, -2.5)
    ]


def near_the_largest_number() -> list[Question]:
    """One step where a whole dt of the first slope is more than the largest number, and half of it is not.

    Heun's guess is infinite there; midpoint's is not, nor in the first question Ralston's, which goes 2/3 of dt. The
    spring does not pull, so that nothing else is large: v' = -c/m v, with c/m dt less than 2.5.
    """
    given = ((1.3, 1.3e308), (1.5684, 1.1e308))
    return [
        Question("step", (-0.2, v, rate, {**EXAMPLE, "mass": 1.0, "stiffness": 0.0, "damping": rate}), ("y", "v"), "")
        for rate, v in given
    ]


EXERCISE = Exercise(
    title="The same mass, by Heun",
    minutes=30,
    goals="A guess and its correction: two slopes, their average, second order.",
    solutions={"step": step},
    questions=questions_on_one,
    aside=where_drag_grows,
    aside_in_c=near_the_largest_number,
    told_aside=[other for other in OTHERS if other.name in SAME],
    mistakes=[
        *OF_HEUN,
        *on_one_mass((*OF_A_SPRING, *OF_INERTIA, *OF_A_STEP)),
        *(other for other in OTHERS if other.name not in ("heun", *SAME)),
    ],
)
