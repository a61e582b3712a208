"""The largest stable dt, predicted, for numbers of the student's own (slides 14-15)."""

from __future__ import annotations

import hashlib
import json
from math import pi, sin, sqrt
from typing import Any

import numpy as np

from experiments.exercises.exercise import Exercise, Question
from experiments.exercises.force_mistakes import mistake

#: What students predict: functions without arguments, and of which step.
FUNCTIONS = {
    "kick_drift": "kick-drift, one mass without damping",
    "runge_kutta": "classic Runge-Kutta, one mass without damping",
    "euler": "Euler, one mass with damping",
    "string": "kick-drift, a string",
}


def parameters(seed: str) -> dict[str, float]:
    """The student's own numbers, to be had from the seed by anybody."""
    random = np.random.default_rng(list(hashlib.sha256(seed.encode()).digest()))
    return {
        "mass": round(float(random.uniform(0.02, 0.2)), 3),
        "stiffness": round(float(random.uniform(50, 500)), 1),
        "damping": round(float(random.uniform(0.05, 0.3)), 3),
        "masses": float(random.integers(5, 20)),
    }


def kick_drift(mass: float, stiffness: float, limit: str = "2", rate: str = "root", **_: Any) -> float:
    """Stable while dt w < 2, w the root of k/m."""
    factor = {"2": 2.0, "1": 1.0, "period": 2 * pi}[limit]
    return factor / (sqrt(stiffness / mass) if rate == "root" else stiffness / mass)


def runge_kutta(mass: float, stiffness: float, reach: str = "2.83", rate: str = "root", **_: Any) -> float:
    """Stable while dt w < 2 sqrt 2: so far its region reaches up the imaginary axis."""
    factor = {"2.83": sqrt(8), "2": 2.0, "2.79": 2.7853}[reach]
    return factor / (sqrt(stiffness / mass) if rate == "root" else stiffness / mass)


def euler(mass: float, stiffness: float, damping: float, bound: str = "c/k", **_: Any) -> float:
    """Stable while dt < c/k: |1 + dt z|^2 = 1 - dt c/m + dt^2 k/m for the pair of roots z."""
    bounds = {"c/k": damping / stiffness, "2c/k": 2 * damping / stiffness, "2m/c": 2 * mass / damping}
    return {**bounds, "2/w": 2 / sqrt(stiffness / mass)}[bound]


def string(mass: float, stiffness: float, masses: float, mode: str = "highest", rate: str = "root", **_: Any) -> float:
    """Stable while dt w < 2, w that of the highest mode: 2 sqrt(k/m) sin((2n - 1) pi / (4n + 2))."""
    n = masses
    share = {
        "highest": 2 * sin((2 * n - 1) * pi / (4 * n + 2)),
        "lowest": 2 * sin(pi / (4 * n + 2)),
        "one": 1.0,
        "together": 1 / n,
    }[mode]
    square = share**2 * stiffness / mass
    return 2 / (sqrt(square) if rate == "root" else square)


def questions(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """The same four, hidden or not."""
    own = parameters(seed)
    return [Question(name, (), ("dt",), about, own=own, item="") for name, about in FUNCTIONS.items()]


def files(seed: str) -> dict[str, str]:
    """The student's numbers."""
    return {"parameters.json": json.dumps(parameters(seed), indent=2) + "\n"}


EXERCISE = Exercise(
    title="The largest stable step",
    minutes=60,
    goals="Predict before you run: frequency, damping, stability limits of four steps.",
    solutions={"kick_drift": kick_drift, "runge_kutta": runge_kutta, "euler": euler, "string": string},
    questions=questions,
    seeded=True,
    tolerance=5e-3,
    files=files,
    mistakes=(
        mistake("root_forgotten", "You take k/m for the frequency.", "What is the unit of k/m?", rate="square"),
        mistake(
            "limit_of_one",
            "Your limit for kick-drift is that of dt w = 1.",
            "When does the step's matrix get an eigenvalue -1?",
            limit="1",
        ),
        mistake(
            "a_whole_period",
            "Your limit for kick-drift is a whole period.",
            "What happens in half a period?",
            limit="period",
        ),
        mistake(
            "kick_drifts_limit",
            "Your limit for Runge-Kutta is kick-drift's.",
            "How far up the imaginary axis does its region of stability reach?",
            reach="2",
        ),
        mistake(
            "real_axis",
            "Your limit for Runge-Kutta is where its region ends on the real axis.",
            "On which axis are the eigenvalues of a motion without damping?",
            reach="2.79",
        ),
        mistake(
            "euler_undamped",
            "Your limit for Euler is kick-drift's.",
            "What does Euler do to an undamped motion, at any dt?",
            bound="2/w",
        ),
        mistake(
            "euler_twice",
            "Your limit for Euler is twice too large.",
            "For which dt is |1 + dt z| = 1? Square it.",
            bound="2c/k",
        ),
        mistake(
            "euler_creeping",
            "Your limit for Euler is that of a mass without a spring.",
            "Which of the eigenvalues leaves the circle first?",
            bound="2m/c",
        ),
        mistake(
            "one_spring",
            "For the string you take the frequency of one mass on one spring.",
            "How many springs pull on a mass when its neighbours move against it?",
            mode="one",
        ),
        mistake(
            "lowest_mode",
            "For the string you take the lowest mode.",
            "Which mode is the first to become unstable?",
            mode="lowest",
        ),
        mistake(
            "springs_in_a_row",
            "For the string you take all springs as one.",
            "Which mode is the first to become unstable?",
            mode="together",
        ),
    ),
)
