"""Wrong predictions of the largest step, by hand for round numbers; and the numbers that students are given."""

from __future__ import annotations

import json
from math import pi, sqrt
from typing import Any

import numpy as np
import pytest

from experiments.exercises.exercise import find

EXERCISE = find("largest_step")

#: w = 10/s: m = 0.5 kg, k = 50 N/m; with c = 0.4 N s/m.
GIVEN = {"mass": 0.5, "stiffness": 50.0, "damping": 0.4, "masses": 3}

#: Eigenvalues of three masses below one another, 2 sin of 5 pi/14 and of pi/14; held at both ends of 3 pi/8, at none
#: of pi/3.
FASTEST, SLOWEST = 2 * sqrt((1 - np.cos(5 * pi / 7)) / 2), 2 * sqrt((1 - np.cos(pi / 7)) / 2)


@pytest.mark.parametrize(
    ("function", "wrong", "limit"),
    [
        ("kick_drift", {}, 0.2),
        ("kick_drift", {"limit": "1"}, 0.1),
        ("kick_drift", {"limit": "period"}, 2 * pi / 10),
        ("kick_drift", {"rate": "square"}, 0.02),
        ("kick_drift", {"rate": "upside down"}, 20.0),
        ("runge_kutta", {}, 2 * sqrt(2) / 10),
        ("runge_kutta", {"reach": "2"}, 0.2),
        ("runge_kutta", {"reach": "4"}, 0.4),
        ("runge_kutta", {"reach": "2.79"}, 0.27853),
        ("runge_kutta", {"rate_rk": "square"}, 2 * sqrt(2) / 100),
        ("euler", {}, 0.4 / 50),
        ("euler", {"bound": "2c/k"}, 0.8 / 50),
        ("euler", {"bound": "2m/c"}, 1 / 0.4),
        ("euler", {"bound": "2/w"}, 0.2),
        ("euler", {"bound": "never"}, 0.0),
        ("string", {}, 0.2 / FASTEST),
        ("string", {"mode": "lowest"}, 0.2 / SLOWEST),
        ("string", {"mode": "one"}, 0.2),
        ("string", {"mode": "together"}, 0.6),
        ("string", {"mode": "both ends held"}, 0.2 / (2 * np.sin(3 * pi / 8))),
        ("string", {"mode": "both ends free"}, 0.2 / sqrt(3)),
        ("string", {"mode": "endless"}, 0.1),
        ("string", {"rate_string": "square", "mode": "one"}, 0.02),
    ],
    ids=str,
)
def test_what_is_predicted(function: str, wrong: dict[str, Any], limit: float) -> None:
    """And as grams, where mass is 1000 times too large, and in milliseconds."""
    solved = EXERCISE.solutions[function]
    given = {name: value for name, value in GIVEN.items() if name != "masses" or function == "string"}
    assert solved(**given, **wrong) == pytest.approx(limit)
    assert solved(**given, **wrong, unit=1000.0) == pytest.approx(1000 * limit)
    heavier = {**given, "mass": 1000 * given["mass"]}
    assert solved(**given, **wrong, grams=1000.0) == pytest.approx(solved(**heavier, **wrong))


@pytest.mark.parametrize("masses", [1, 2, 3, 4])
@pytest.mark.parametrize(
    ("mode", "held"), [("highest", (True, False)), ("both ends held", (True, True)), ("both ends free", (False, False))]
)
def test_the_modes_of_a_string(masses: int, mode: str, held: tuple[bool, bool]) -> None:
    """The largest eigenvalue of its matrix: 2 on the diagonal, 1 for an end that hangs on nothing."""
    matrix = 2 * np.eye(masses) - np.eye(masses, k=1) - np.eye(masses, k=-1)
    matrix[0, 0] -= not held[0]
    matrix[-1, -1] -= not held[1]
    largest = np.linalg.eigvalsh(matrix)[-1]
    if largest > 1e-9:
        found = EXERCISE.solutions["string"](mass=0.5, stiffness=50.0, masses=masses, mode=mode)
        assert found == pytest.approx(2 / sqrt(100 * largest))


def test_students_have_numbers_of_their_own() -> None:
    """The same whenever they are asked for, rounded as in the file, within bounds; strings of three and four masses."""
    found = []
    for i in range(60):
        seed = f"student {i}"
        own = json.loads(EXERCISE.files(seed)["parameters.json"])  # type: ignore[misc]
        for hidden in (False, True):
            asked = EXERCISE.questions(np.random.default_rng(i), hidden, seed)
            assert [q.function for q in asked] == list(EXERCISE.solutions)
            assert all((q.own, q.parts, q.arguments, q.steps) == (own, ("dt",), (), 0) for q in asked)
        found.append(own)
    for name, digits, low, high in (
        ("mass", 3, 0.02, 0.2),
        ("stiffness", 1, 50, 500),
        ("damping", 3, 0.05, 0.3),
        ("masses", 0, 3, 4),
    ):
        values = [own[name] for own in found]
        assert all(value == round(value, digits) for value in values)
        assert any(value != round(value, digits - 1) for value in values)
        # of sixty some are near either end
        assert low <= min(values) <= low + 0.1 * (high - low)
        assert high - 0.1 * (high - low) <= max(values) <= high


def test_who_takes_the_mass_for_grams_is_off_by_the_root_of_a_thousand() -> None:
    """Either way: kilograms taken for grams, and grams for kilograms. A limit of kick-drift is 2 sqrt(m/k)."""
    ways = [one.parameters for one in EXERCISE.mistakes if one.name == "grams"]
    given = {name: value for name, value in GIVEN.items() if name != "masses"}
    limits = [EXERCISE.solutions["kick_drift"](**given, **way) for way in ways]
    assert sorted(limits) == pytest.approx([2 * sqrt(0.5e-3 / 50), 2 * sqrt(500 / 50)])
