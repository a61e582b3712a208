"""The energy of a string, and what its damping takes (slides 13-14)."""

from __future__ import annotations

from typing import Any

import numpy as np

from experiments.exercises.exercise import Exercise, Question, mistake, mistakes
from experiments.exercises.solutions.force_mistakes import EXAMPLE_GRAVITY
from experiments.exercises.solutions.links import random_string
from experiments.exercises.solutions.on_strings import MOON, elsewhere, wild_string
from reference.state import Array


def energy(
    x: Array, v: Array, string: Any, kinetic: str = "m v^2/2", elastic: str = "k s^2/2", height: str = "m g y"
) -> tuple[float, float, float]:
    """Kinetic, elastic and gravitational energy [J]."""
    m, k = string.masses, string.stiffness
    squares, lengths = (v**2).sum(axis=1), np.linalg.norm(np.diff(x, axis=0, prepend=string.anchor[None]), axis=1)
    elongation = lengths - string.rest_lengths
    moving = {
        "m v^2/2": m * squares / 2,
        "m v^2": m * squares,
        "v^2/2": squares / 2,
        "m v/2": m * np.sqrt(squares) / 2,
        "m y'^2/2": m * v[:, 1] ** 2 / 2,
    }[kinetic]
    spring = {
        "k s^2/2": k * elongation**2 / 2,
        "k s^2": k * elongation**2,
        "k L^2/2": k * lengths**2 / 2,
        "k s/2": k * elongation / 2,
        "k (L^2 - l^2)/2": k * (lengths**2 - string.rest_lengths**2) / 2,
        "one less": k * elongation**2 / 2 * (np.arange(len(k)) > 0),
    }[elastic]
    high = {
        "m g y": m * x[:, 1],
        "-m g y": -m * x[:, 1],
        "g y": x[:, 1],
        "m y": m * x[:, 1],
        "m 9.81 y": m * x[:, 1],
        "m g x": m * x[:, 0],
        "from the anchor": m * (x[:, 1] - string.anchor[1]),
    }[height]
    gravity = {"m y": 1.0, "m 9.81 y": 9.81}.get(height, string.gravity)
    return moving.sum(), spring.sum(), high.sum() * gravity


def power(
    x: Array,
    v: Array,
    string: Any,
    sign: float = -1.0,
    lost: str = "both",
    rate: str = "along",
    half: tuple[float, float] = (1.0, 1.0),
    speed: str = "squared",
) -> float:
    """What damping along the springs and drag add to the energy [W]: never more than nothing.

    Args:
        half: the share of the springs, and of the drag.
    """
    separation = np.diff(x, axis=0, prepend=string.anchor[None])
    unit = separation / np.linalg.norm(separation, axis=1)[:, None]
    relative = np.diff(v, axis=0, prepend=np.zeros((1, 2)))
    square = {
        "along": (relative * unit).sum(axis=1) ** 2,
        "all": (relative**2).sum(axis=1),
        "own": (v * unit).sum(axis=1) ** 2,
        "once": np.abs((relative * unit).sum(axis=1)),
        "sloppy": (relative * separation).sum(axis=1) ** 2,
    }[rate]
    speeds = (v**2).sum(axis=1)
    springs = half[0] * (string.damping @ square) * (lost != "drag")
    drag = half[1] * string.drag * (speeds if speed == "squared" else np.sqrt(speeds)).sum() * (lost != "springs")
    return float(sign * (springs + drag))


def questions(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """Strings in motion."""
    asked = []
    for i, count in enumerate((1, 7, 4) if hidden else (4, 3)):
        x, v, string = elsewhere(random_string(random, count), i + 1)
        string["damping"] = random.uniform(0.01, 0.1, count)
        about = f"string of {count}"
        asked.append(Question("energy", (x, v, string), ("kinetic", "elastic", "gravitational"), about))
        asked.append(Question("power", (x, v, string), ("power",), about))
    return [*asked, *_out_of_the_ordinary(random)]


def _out_of_the_ordinary(random: np.random.Generator) -> list[Question]:
    """One mass; energies far from rest; the power of masses above and below, left and right of what holds them."""
    single, flung, hung = random_string(random, 1), wild_string(random, MOON), wild_string(random)
    for _, _, string in (single, flung, hung):
        string["damping"] = random.uniform(0.01, 0.1, len(string["masses"]))
    slowly = random.uniform(0.3, 1.0, hung[1].shape) * np.sign(hung[1])
    return [
        Question("energy", single, ("kinetic", "elastic", "gravitational"), "string of 1"),
        Question("power", single, ("power",), "string of 1"),
        Question("energy", flung, ("kinetic", "elastic", "gravitational"), "string flung about"),
        Question("power", (hung[0], slowly, hung[2]), ("power",), "string all over the place"),
    ]


EXERCISE = Exercise(
    title="Energy and damping",
    minutes=45,
    goals="Where energy is in a mesh of springs, and where it goes: the first check of any simulation.",
    solutions={"energy": energy, "power": power},
    questions=questions,
    mistakes=[
        mistake(
            "kinetic_half_missing", "Your kinetic energy is twice too large.", "Integrate m v dv.", kinetic="m v^2"
        ),
        mistake(
            "kinetic_mass_missing",
            "There is no mass in your kinetic energy.",
            "What is the unit of v^2?",
            kinetic="v^2/2",
        ),
        mistake(
            "speed_not_squared",
            "Your kinetic energy has the speed in it, not its square.",
            "What is the unit of m v?",
            kinetic="m v/2",
        ),
        mistake(
            "one_axis_only",
            "Your kinetic energy is that of one axis.",
            "A mass also moves sideways.",
            kinetic="m y'^2/2",
        ),
        mistake(
            "elastic_half_missing", "Your elastic energy is twice too large.", "Integrate k s ds.", elastic="k s^2"
        ),
        mistake(
            "rest_length_missing",
            "Your elastic energy is not zero at the rest length.",
            "What is it that is squared?",
            elastic="k L^2/2",
        ),
        mistake(
            "stretch_not_squared",
            "Your elastic energy has the stretch in it, not its square.",
            "Can it be less than zero?",
            elastic="k s/2",
        ),
        mistake(
            "difference_of_squares",
            "Your elastic energy has L^2 - l^2 in it: the stretch is to be squared as a whole.",
            "What is (a - b)^2?",
            elastic="k (L^2 - l^2)/2",
        ),
        mistake(
            "anchor_spring_missing",
            "The spring at the anchor is not in your elastic energy.",
            "How many springs are there?",
            elastic="one less",
        ),
        mistake(
            "height_sign",
            "Your energy in the field of gravity falls with the height.",
            "Where has a mass more of it, up or down?",
            height="-m g y",
        ),
        mistake(
            "height_without_mass",
            "There is no mass in your energy of gravity.",
            "What is the unit of g y?",
            height="g y",
        ),
        mistake(
            "height_without_g", "There is no g in your energy of gravity.", "What is the unit of m y?", height="m y"
        ),
        mistake(
            "height_from_the_anchor",
            "You measure heights from the anchor.",
            "At which height is the energy of the weight to be 0?",
            height="from the anchor",
        ),
        mistake(
            *EXAMPLE_GRAVITY,
            height="m 9.81 y",
        ),
        mistake("sideways", "You take x for the height.", "Which axis points up?", height="m g x"),
        mistake("power_sign", "Your damping adds energy.", "Which sign has what is lost?", sign=1.0),
        mistake("drag_missing", "The drag is not in your power.", "There are two kinds of damping.", lost="springs"),
        mistake(
            "spring_damping_missing",
            "The damping of the springs is not in your power.",
            "There are two kinds of damping.",
            lost="drag",
        ),
        mistake(
            "all_directions",
            "You damp all of the relative velocity, not what is along the spring.",
            "Does a spring that turns get longer?",
            rate="all",
        ),
        mistake(
            "not_relative",
            "You take the velocity of one end of a spring.",
            "What does a spring feel whose two ends move alike?",
            rate="own",
        ),
        mistake(
            "rate_not_squared",
            "In your power the rate of stretching is not squared.",
            "Power is force times velocity: how often is the velocity in it?",
            rate="once",
        ),
        mistake(
            "drag_not_squared",
            "In your power the drag has the speed in it, not its square.",
            "Power is force times velocity: how often is the velocity in it?",
            speed="once",
        ),
        mistake(
            "not_normalised",
            "The direction in your rate of stretching is not of length 1.",
            "By how much does a spring get longer when its end moves 1 mm along it?",
            rate="sloppy",
        ),
        *mistakes(
            "power_halved",
            "There is a half in your power.",
            "Power is force times velocity. From where would a half come?",
            {"half": (0.5, 1.0)},
            {"half": (1.0, 0.5)},
            {"half": (0.5, 0.5)},
        ),
    ],
)
