"""The largest stable dt, predicted, for numbers of the student's own (slides 14-15)."""

from __future__ import annotations

import hashlib
import json
from math import pi, sin, sqrt
from typing import Any

import numpy as np

from experiments.exercises.exercise import Exercise, Question, mistake, mistakes

#: What students predict: functions without arguments, and of which step.
FUNCTIONS = {
    "kick_drift": "kick-drift, one mass without damping",
    "runge_kutta": "classic Runge-Kutta, one mass without damping",
    "euler": "Euler, one mass with damping",
    "string": "kick-drift, a string",
}


def parameters(seed: str) -> dict[str, float]:
    """The student's own numbers, which follow from the seed."""
    random = np.random.default_rng(list(hashlib.sha256(seed.encode()).digest()))
    return {
        "mass": round(float(random.uniform(0.02, 0.2)), 3),
        "stiffness": round(float(random.uniform(50, 500)), 1),
        "damping": round(float(random.uniform(0.05, 0.3)), 3),
        # few enough that it shows, to three figures, what holds the ends
        "masses": int(random.integers(3, 5)),
    }


def _rate(mass: float, stiffness: float, rate: str, grams: float) -> float:
    """The frequency of one mass on one spring [1/s]: the root of k/m."""
    square = stiffness / (mass * grams)
    return {"root": sqrt(square), "square": square, "upside down": 1 / sqrt(square)}[rate]


def kick_drift(
    mass: float, stiffness: float, limit: str = "2", rate: str = "root", grams: float = 1.0, unit: float = 1.0, **_: Any
) -> float:
    """Stable while dt w < 2, w the root of k/m."""
    factor = {"2": 2.0, "1": 1.0, "period": 2 * pi}[limit]
    return unit * factor / _rate(mass, stiffness, rate, grams)


def runge_kutta(
    mass: float,
    stiffness: float,
    reach: str = "2.83",
    rate_rk: str = "root",
    grams: float = 1.0,
    unit: float = 1.0,
    **_: Any,
) -> float:
    """Stable while dt w < 2 sqrt 2: so far its region reaches up the imaginary axis."""
    factor = {"2.83": sqrt(8), "2": 2.0, "2.79": 2.7853, "4": 4.0}[reach]
    return unit * factor / _rate(mass, stiffness, rate_rk, grams)


def euler(
    mass: float, stiffness: float, damping: float, bound: str = "c/k", grams: float = 1.0, unit: float = 1.0, **_: Any
) -> float:
    """Stable while dt < c/k: |1 + dt z|^2 = 1 - dt c/m + dt^2 k/m for the pair of roots z."""
    bounds = {"c/k": damping / stiffness, "2c/k": 2 * damping / stiffness, "2m/c": 2 * mass * grams / damping}
    return unit * {**bounds, "2/w": 2 / _rate(mass, stiffness, "root", grams), "never": 0.0}[bound]


def string(
    mass: float,
    stiffness: float,
    masses: float,
    mode: str = "highest",
    rate_string: str = "root",
    grams: float = 1.0,
    unit: float = 1.0,
    **_: Any,
) -> float:
    """Stable while dt w < 2, w that of the highest mode: 2 sqrt(k/m) sin((2n - 1) pi / (4n + 2))."""
    n = masses
    share = {
        "highest": 2 * sin((2 * n - 1) * pi / (4 * n + 2)),
        "lowest": 2 * sin(pi / (4 * n + 2)),
        "one": 1.0,
        "together": 1 / n,
        "both ends held": 2 * sin(n * pi / (2 * n + 2)),
        "both ends free": 2 * sin((n - 1) * pi / (2 * n)),
        "endless": 2.0,
    }[mode]
    return unit * 2 / _rate(mass, share**2 * stiffness, rate_string, grams)


def questions(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """The same four, hidden or not."""
    own = parameters(seed)
    return [Question(name, (), ("dt",), about, own=own, item="") for name, about in FUNCTIONS.items()]


def files(seed: str) -> dict[str, str]:
    """The student's numbers."""
    return {"parameters.json": json.dumps(parameters(seed), indent=2) + "\n"}


#: The same mistake in one function, or in all that have a frequency.
RATES = (("rate",), ("rate_rk",), ("rate_string",), ("rate", "rate_rk"), ("rate", "rate_rk", "rate_string"))
SQUARE, UPSIDE_DOWN = ([dict.fromkeys(names, value) for names in RATES] for value in ("square", "upside down"))
STIFFER = "Does a stiffer spring swing faster or slower?"


EXERCISE = Exercise(
    title="The largest stable step",
    minutes=60,
    goals="Predict before you run: frequency, damping, stability limits of four steps.",
    solutions={"kick_drift": kick_drift, "runge_kutta": runge_kutta, "euler": euler, "string": string},
    questions=questions,
    seeded=True,
    tolerance=5e-3,
    files=files,
    mistakes=[
        *mistakes(
            "root_forgotten",
            "You take k/m for the frequency.",
            "What is the unit of k/m?",
            *SQUARE,
        ),
        *mistakes(
            "upside_down",
            "You take the root of m/k for the frequency.",
            STIFFER,
            *UPSIDE_DOWN,
        ),
        mistake("milliseconds", "Your steps are in milliseconds.", "Which unit was asked for?", unit=1e3),
        *mistakes(
            "grams",
            "You take the mass for grams.",
            "In which unit is the mass that you were given?",
            {"grams": 1e-3},
            {"grams": 1e3},
        ),
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
            "a_limit_for_each_slope",
            "Your limit for Runge-Kutta is 4 / w: slopes are not steps.",
            "How far up the imaginary axis does its region of stability reach?",
            reach="4",
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
            "euler_never_stable",
            "You say that Euler is never stable.",
            "That is so without damping. Is there none?",
            bound="never",
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
        mistake(
            "both_ends_held",
            "Your string is held at both ends.",
            "What is below the last mass?",
            mode="both ends held",
        ),
        mistake(
            "both_ends_free", "Your string hangs on nothing.", "What is above the first mass?", mode="both ends free"
        ),
        mistake(
            "endless_string",
            "Your string has no end: 2 root k/m is what the fastest mode comes near to, with more and more masses.",
            "How many masses has yours?",
            mode="endless",
        ),
    ],
)
