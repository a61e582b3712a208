"""Exercises on one mass that hangs on a spring: their solution and their questions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from experiments.exercises.exercise import Mistake, Question
from experiments.exercises.solutions.links import namespace
from experiments.exercises.solutions.on_strings import MOON
from experiments.exercises.solutions.stepping import DT, M_AND_SPEED, step

#: The numbers at the end of the starter.
EXAMPLE = {"mass": 0.05, "stiffness": 50.0, "rest_length": 0.15, "damping": 0.0, "gravity": 9.81}


def step_of_one(
    y: float, v: float, dt: float, spring: Any, scheme: str, own: Sequence[str] = (), **parameters: Any
) -> tuple[float, float]:
    """A step of a mass at height y [m], below an anchor at height 0: a string of one link, in one dimension.

    Args:
        own: which numbers are those of the starter's example.
    """
    given = {name: EXAMPLE[name] if name in own else getattr(spring, name) for name in EXAMPLE}
    string = namespace(
        {
            "masses": np.array([given["mass"]]),
            "stiffness": np.array([given["stiffness"]]),
            "rest_lengths": np.array([given["rest_length"]]),
            "drag": given["damping"],
            "gravity": given["gravity"],
            "anchor": np.zeros(1),
        }
    )
    x, u = step(np.array([[float(y)]]), np.array([[float(v)]]), dt, string, scheme, **parameters)
    return float(x[0, 0]), float(u[0, 0])


def on_one_mass(mistakes: Iterable[Mistake]) -> tuple[Mistake, ...]:
    """Mistakes in forces, and what comes with one mass.

    Some let the mass fly above its anchor. There -y, and the distance to the anchor, are no longer the same length:
    who takes the one makes the same mistake as who takes the other.
    """
    made = tuple(mistakes)
    above = (replace(m, parameters={**m.parameters, "length": "signed"}) for m in made if m.name in FLY)
    return (*made, *above, Y_FOR_THE_LENGTH, *NUMBERS_OF_THE_EXAMPLE)


#: Mistakes with which masses fly above their anchor.
FLY = ("spring_sign", "rest_length_added", "dt_missing")


#: The text says that heights are less than zero.
Y_FOR_THE_LENGTH = Mistake(
    "y_for_the_length",
    "You take y for the length of the spring, but y is less than zero.",
    "How long is the spring when its mass is at y = -0.2 m?",
    {"length": "y"},
)


#: Numbers are to be taken from what is given. The damping of the example is 0: none at all.
NUMBERS_OF_THE_EXAMPLE = tuple(
    Mistake(
        "numbers_of_the_example",
        "You take numbers of the example at the end of the file in place of those that you are given.",
        "The same step is to work for other springs. From where do you have mass, stiffness, lengths, gravity?",
        {"own": own},
    )
    for own in (
        *((name,) for name in EXAMPLE if name != "damping"),
        ("mass", "stiffness", "rest_length"),
        ("mass", "stiffness", "rest_length", "gravity"),
        tuple(EXAMPLE),
    )
)


def questions_on_one(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """A few springs, 20 steps of each: one stretched, and its mass on its way up; the next pressed, on its way down."""
    questions = []
    for i in range(5 if hidden else 3):
        spring = {
            "mass": float(random.uniform(0.02, 0.06)),
            "stiffness": float(random.uniform(40.0, 80.0)),
            "rest_length": float(random.uniform(0.1, 0.2)),
            "damping": 0.0 if i == 4 else float(random.uniform(0.02, 0.05)),
            "gravity": MOON if i == 2 else 9.81,
        }
        share, v = float(random.uniform(1.1, 1.4)), float(random.uniform(0.3, 1.0))
        y, v = -spring["rest_length"] * (share - 0.5 * (i % 2)), v * (-1) ** i
        dt = DT * float(random.uniform(0.5, 1.0))
        questions.append(Question("step", (y, v, dt, spring), ("y", "v"), f"spring {i + 1}", 20, units=M_AND_SPEED))
    return [*questions, *_far_out(random)]


#: How long the spring is, as a share of its rest length; how stiff, as a multiple; v [m/s]; dt [s].
FAR_OUT = {
    "spring of four times its length": (4.0, 1.0, 3.0, DT),
    "spring pressed to a fifth": (0.2, 1.0, -30.0, DT),
    "stiff spring": (1.2, 5.0, -12.0, DT),
    "spring with a long dt": (1.1, 1.0, -0.5, 0.03),
}


def _far_out(random: np.random.Generator) -> Iterator[Question]:
    """One step of springs out of the ordinary, whose masses stay below the anchor, also by most wrong steps."""
    for i, (about, (share, stiffer, v, dt)) in enumerate(FAR_OUT.items()):
        spring = {
            "mass": float(random.uniform(0.02, 0.06)),
            "stiffness": float(random.uniform(40.0, 80.0)) * stiffer,
            "rest_length": float(random.uniform(0.1, 0.2)),
            "damping": float(random.uniform(0.02, 0.05)) * (i != 2),
            "gravity": MOON if i % 2 else 9.81,
        }
        near = random.uniform(0.95, 1.05, 3)
        given = (-share * near[0] * spring["rest_length"], v * near[1], dt * near[2], spring)
        yield Question("step", given, ("y", "v"), about, 1, units=M_AND_SPEED)
