"""Exercises on strings in two dimensions: their questions."""

from __future__ import annotations

from typing import Any

import numpy as np

from experiments.exercises.exercise import Question
from experiments.exercises.solutions.links import random_string
from experiments.exercises.solutions.stepping import DT, M_AND_SPEED
from reference.state import Array

#: How many masses the strings of the public and of the hidden check have. One is a string too.
PUBLIC, HIDDEN = (5, 4, 3, 1), (1, 2, 6, 4)

#: A step longer than others [s].
LONG_DT = 0.02

#: Gravity on the Moon [m/s^2].
MOON = 1.62


#: A string, as `links.random_string` makes it.
String = tuple[Array, Array, dict[str, Any]]


def elsewhere(string: String, number: int) -> String:
    """The string, every third of them on the Moon: gravity is given, it is not always 9.81 m/s^2."""
    if number % 3 == 2:
        string[2]["gravity"] = MOON
    return string


def wild_string(random: np.random.Generator, gravity: float = 9.81) -> String:
    """A string with all that a law of springs must hold for, and a program may not: in every check, whatever the key.

    Springs lead in all four quarters, so that masses are above and below, left and right of those that hold them and of
    the anchor; one is longer than four times its rest length, one shorter than a third of it, one pulls with more than
    a kilonewton. Masses move in all four quarters too, some by a hundred metres a second.
    """
    count, quarters = 6, np.array([3, 0, 1, 2, 1, 3])
    angles = (quarters + random.uniform(0.2, 0.8, count)) * np.pi / 2
    rest_lengths = random.uniform(0.1, 0.2, count)
    lengths = rest_lengths * np.array([0.7, 4.2, 1.3, 0.25, 1.8, 0.6]) * random.uniform(0.95, 1.05, count)
    string = {
        "masses": random.uniform(0.05, 0.3, count),
        "stiffness": random.uniform(40.0, 80.0, count) * np.array([1, 1, 4e3, 1, 1, 1]),
        "rest_lengths": rest_lengths,
        "drag": float(random.uniform(0.1, 0.3)),
        "gravity": gravity,
        "anchor": random.uniform(-0.3, -0.1, 2),
    }
    steps = lengths[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    speeds = random.uniform(0.8, 1.2, count) * np.array([60.0, 1.0, 5.0, 100.0, 20.0, 0.5])
    ways = (np.array([1, 0, 3, 2, 0, 1]) + random.uniform(0.2, 0.8, count)) * np.pi / 2
    v = speeds[:, None] * np.stack([np.cos(ways), np.sin(ways)], axis=1)
    return string["anchor"] + np.cumsum(steps, axis=0), v, string


def crumpled_string(random: np.random.Generator) -> String:
    """Two masses without drag, the first half a millimetre from its anchor, the second above it."""
    _, v, string = random_string(random, 2)
    string |= {"anchor": random.uniform(0.01, 0.02, 2), "drag": 0.0, "gravity": MOON}
    first = string["anchor"] + 5e-4 * np.array([0.8, 0.6]) * random.choice([-1.0, 1.0], 2)
    second = first + random.uniform(0.06, 0.09, 2) * np.array([random.choice([-1.0, 1.0]), 1.0])
    return np.array([first, second]), v * np.array([[0.1], [1.0]]), string


def questions_on_steps(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """A few strings, 12 steps of each; then one step of such as are out of the ordinary, and a few long ones."""
    questions: list[Question] = []
    for count in HIDDEN if hidden else PUBLIC:
        x, v, string = elsewhere(random_string(random, count), len(questions))
        dt = DT * float(random.uniform(0.5, 1.0))
        questions.append(Question("step", (x, v, dt, string), ("x", "v"), _about(count), 12, units=M_AND_SPEED))
    for string_made, dt, steps, about in (
        (wild_string(random), DT, 1, "string flung about"),
        (crumpled_string(random), DT / 4, 1, "crumpled string"),
        (random_string(random, 3), LONG_DT, 2, "string of 3 masses, a long dt"),
    ):
        x, v, string = string_made
        took = dt * float(random.uniform(0.9, 1.1))
        questions.append(Question("step", (x, v, took, string), ("x", "v"), about, steps, units=M_AND_SPEED))
    return questions


def questions_on_forces(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """A few strings, in motion; then such as are out of the ordinary."""
    counts = HIDDEN if hidden else PUBLIC
    strings = [(elsewhere(random_string(random, count), i), _about(count)) for i, count in enumerate(counts)]
    strings += [(wild_string(random), "string flung about"), (crumpled_string(random), "crumpled string")]
    return [Question("forces", string, ("the force",), about, units=("N",)) for string, about in strings]


def _about(count: int) -> str:
    return f"string of {count} mass{'es'[: 2 * (count != 1)]}"
