"""Exercises on strings in two dimensions: their questions."""

from __future__ import annotations

from typing import Any

import numpy as np

from experiments.exercises.exercise import Question
from experiments.exercises.links import random_string
from experiments.exercises.stepping import DT, M_AND_SPEED
from reference.state import Array

#: How many masses the strings of the public and of the hidden check have. One is a string too.
PUBLIC, HIDDEN = (5, 4, 3), (1, 2, 6, 4)

#: Gravity on the Moon [m/s^2].
MOON = 1.62


#: A string, as `links.random_string` makes it.
String = tuple[Array, Array, dict[str, Any]]


def elsewhere(string: String, number: int) -> String:
    """The string, every third of them on the Moon: gravity is given, it is not always 9.81 m/s^2."""
    if number % 3 == 2:
        string[2]["gravity"] = MOON
    return string


def questions_on_steps(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """A few strings, 12 steps of each."""
    questions: list[Question] = []
    for count in HIDDEN if hidden else PUBLIC:
        x, v, string = elsewhere(random_string(random, count), len(questions))
        dt = DT * float(random.uniform(0.5, 1.0))
        questions.append(Question("step", (x, v, dt, string), ("x", "v"), _about(count), 12, units=M_AND_SPEED))
    return questions


def questions_on_forces(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """A few strings, in motion."""
    counts = HIDDEN if hidden else PUBLIC
    strings = [elsewhere(random_string(random, count), i) for i, count in enumerate(counts)]
    return [Question("forces", string, ("the force",), _about(len(string[0])), units=("N",)) for string in strings]


def _about(count: int) -> str:
    return f"string of {count} mass{'es'[: 2 * (count != 1)]}"
