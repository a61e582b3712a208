"""Which engine is it? Trajectories of steppers without a name, to be identified."""

from __future__ import annotations

import hashlib
import json
from itertools import combinations
from typing import Any

import numpy as np

from experiments.exercises.exercise import Exercise, Mistake, Question, mistake, mistakes
from experiments.exercises.solutions.links import namespace, random_string
from experiments.exercises.solutions.stepping import DT, step

#: Whom it may be.
KNOWN = ("euler", "heun", "kick_drift", "drift_kick", "velocity_verlet", "midpoint", "rk4", "heun_link_by_link")

#: What the trajectories are called, and how long they are.
LETTERS, STEPS = "ABCDE", 40


def chosen(seed: str) -> tuple[list[str], np.random.Generator]:
    """Who is behind the letters, for a student's seed with the teacher's key; and random numbers."""
    digest = hashlib.sha256(f"which engine\0{seed}".encode()).digest()
    random = np.random.default_rng(list(digest))
    # these two are always among them: to tell them apart is what the exercise is about
    others = random.permutation([name for name in KNOWN if name not in ("kick_drift", "drift_kick")])[:3]
    return random.permutation(["kick_drift", "drift_kick", *others]).tolist(), random


def names(seed: str, swap: tuple[str, str] = ("", ""), shifted: int = 0, order: int = 1) -> Any:
    """The right names, or with two of them taken for each other."""
    right = chosen(seed)[0]
    swapped = [{swap[0]: swap[1], swap[1]: swap[0]}.get(name, name) for name in right]
    return np.array((swapped[shifted:] + swapped[:shifted])[::order])


def as_in_the_text(question: Question, given: Any) -> Any:
    """Names as the text has them: no capitals, an underscore between words."""
    if given.dtype.kind != "U":
        return given
    return np.strings.replace(np.strings.replace(np.strings.lower(np.strings.strip(given)), "-", "_"), " ", "_")


def diagnose(question: Question, given: Any) -> tuple[str, str, str] | None:
    """A name that is missing, that nobody has, or that two have."""
    if given.shape != (len(LETTERS),):
        return None
    for letter, name in zip(LETTERS, given.tolist(), strict=True):
        if name == "":
            return "name_missing", f"There is no name for {letter}.", "Which of the eight have you not tried on it?"
        if name not in KNOWN:
            return "unknown_name", f"{name[:40]!r} is none of the eight names.", "The text has the names."
    for name in KNOWN:
        who = [letter for letter, other in zip(LETTERS, given.tolist(), strict=True) if other == name]
        if len(who) > 1:
            words = f"You call {', '.join(who[:-1])} and {who[-1]} {name}: no two of them are the same."
            return "name_twice", words, "Which of them is the same to 1e-15 after forty steps?"
    return None


def questions(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """One question, hidden or not."""
    return [Question("names", (), ("the names",), "the trajectories", own={"seed": seed}, item="trajectory")]


def files(seed: str) -> dict[str, str]:
    """The string, and what five steppers make of it, to all digits."""
    chosen_names, random = chosen(seed)
    x, v, string = random_string(random, 3)
    plain = {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in string.items()}
    made = {"string.json": json.dumps({"dt": DT, "x": x.tolist(), "v": v.tolist(), **plain}, indent=1) + "\n"}
    for letter, name in zip(LETTERS, chosen_names, strict=True):
        rows, state = ["step,x0,y0,x1,y1,x2,y2"], (x, v)
        for i in range(STEPS + 1):
            rows.append(",".join([str(i), *map(repr, state[0].ravel().tolist())]))
            state = step(*state, DT, namespace(string), name)
        made[f"{letter}.csv"] = "\n".join(rows) + "\n"
    return made


def _swapped(a: str, b: str, hint: str) -> Mistake:
    return mistake(f"{a}_or_{b}", f"You take {a} for {b}, or {b} for {a}.", hint, swap=(a, b))


#: Those that are most alike, and what tells them apart.
ALIKE = [
    _swapped("kick_drift", "drift_kick", "Look at the very first step: whose velocity moved the masses?"),
    _swapped("heun", "midpoint", "Where is their second slope taken? They part in the third order of dt."),
    _swapped("heun", "heun_link_by_link", "Does the first mass tell them apart, or the second?"),
    _swapped("heun", "velocity_verlet", "Which has dt^2 a / 2 in its first step, and nothing of higher order?"),
    _swapped("midpoint", "velocity_verlet", "Which has dt^2 a / 2 in its first step, and nothing of higher order?"),
    _swapped("heun", "rk4", "Halve dt in your own program: how far does each move?"),
    _swapped("rk4", "velocity_verlet", "Halve dt in your own program: how far does each move?"),
    _swapped("rk4", "midpoint", "Halve dt in your own program: how far does each move?"),
    _swapped("euler", "kick_drift", "Look at the very first step: has gravity moved the masses yet?"),
    _swapped("euler", "drift_kick", "Their first step is the same; look at the second."),
]


EXERCISE = Exercise(
    title="Which engine is it?",
    minutes=60,
    goals="Identify a program by what it does: run candidates beside it, and look at the size of what is left.",
    solutions={"names": names},
    questions=questions,
    seeded=True,
    keyed=True,
    files=files,
    canonical=as_in_the_text,
    searched=False,
    diagnose=diagnose,
    mistakes=[
        *ALIKE,
        *(
            _swapped(a, b, "Run both in your own program: how large is what is left after the second step?")
            for a, b in combinations(KNOWN, 2)
            if not any({a, b} == set(mistake.parameters["swap"]) for mistake in ALIKE)
        ),
        *mistakes(
            "letters_off_by_one",
            "Your names are right, but one letter off.",
            "Which file is the first?",
            {"shifted": 1},
            {"shifted": -1},
        ),
        mistake("letters_reversed", "Your names are right, but from E to A.", "Which file is the first?", order=-1),
    ],
)
