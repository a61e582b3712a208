"""The forces on a string in two dimensions (slides 5 and 9-10)."""

from __future__ import annotations

from experiments.exercises.exercise import Exercise
from experiments.exercises.solutions.force_mistakes import OF_A_SPRING, OF_A_STRING, OF_FORCES
from experiments.exercises.solutions.links import forces
from experiments.exercises.solutions.on_strings import questions_on_forces

EXERCISE = Exercise(
    title="The forces on a string",
    minutes=45,
    goals="Vectors along springs, action and reaction, the first and the last link.",
    solutions={"forces": forces},
    questions=questions_on_forces,
    mistakes=[*OF_A_SPRING, *OF_A_STRING, *OF_FORCES],
)
