"""Energies and powers of a string, right ones and wrong ones, worked out by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from experiments.exercises.exercise import find
from experiments.exercises.solutions.links import namespace

SOLVED = find("energy").solutions

#: Springs of 5 m and 13 m, that are 3 m too long and 2 m too short; masses at (4, -2) and (-1, -14).
ANCHOR = np.array([1.0, 2.0])
X, V = np.array([[4.0, -2.0], [-1.0, -14.0]]), np.array([[3.0, -4.0], [8.0, 8.0]])
STRING = namespace(
    {
        "masses": np.array([2.0, 6.0]),
        "stiffness": np.array([10.0, 20.0]),
        "rest_lengths": np.array([2.0, 15.0]),
        "damping": np.array([0.1, 0.3]),
        "drag": 0.5,
        "gravity": 1.5,
        "anchor": ANCHOR,
    }
)

#: Squares of speeds are 25 and 128.
KINETIC = {
    "m v^2/2": 25 + 384,
    "m v^2": 50 + 768,
    "v^2/2": 12.5 + 64,
    "m v/2": 5 + 3 * 128**0.5,
    "m y'^2/2": 16 + 3 * 64,
}
ELASTIC = {
    "k s^2/2": 45 + 40,
    "k s^2": 90 + 80,
    "k L^2/2": 125 + 1690,
    "k s/2": 15 - 20,
    "k (L^2 - l^2)/2": 5 * 21 + 10 * (169 - 225),
    "one less": 40,
}
HEIGHT = {
    "m g y": 1.5 * (-4 - 84),
    "-m g y": 1.5 * (4 + 84),
    "g y": 1.5 * (-2 - 14),
    "m y": -4 - 84,
    "m 9.81 y": 9.81 * (-4 - 84),
    "m g x": 1.5 * (8 - 6),
    "from the anchor": 1.5 * (2 * -4 + 6 * -16),
}


@pytest.mark.parametrize(
    ("place", "name", "values"),
    [(0, "kinetic", KINETIC), (1, "elastic", ELASTIC), (2, "height", HEIGHT)],
    ids=["kinetic", "elastic", "height"],
)
def test_energies(place: int, name: str, values: dict[str, float]) -> None:
    """One is as it is called, the other two are right."""
    for kind, value in values.items():
        wanted = [KINETIC["m v^2/2"], ELASTIC["k s^2/2"], HEIGHT["m g y"]]
        wanted[place] = value
        assert SOLVED["energy"](X, V, STRING, **{name: kind}) == pytest.approx(wanted), kind


#: The first spring gets longer by v . (3, -4)/5 = 5 m/s; the second by (5, 12) . (-5, -12)/13 = -13 m/s.
SPRINGS, DRAG = 0.1 * 25 + 0.3 * 169, 0.5 * (25 + 128)

#: Of one end: the first as it is, the second by (8, 8) . (-5, -12)/13.
OWN = 0.1 * 25 + 0.3 * (136 / 13) ** 2


@pytest.mark.parametrize(
    ("wrong", "power"),
    [
        ({}, -SPRINGS - DRAG),
        ({"sign": 1.0}, SPRINGS + DRAG),
        ({"lost": "springs"}, -SPRINGS),
        ({"lost": "drag"}, -DRAG),
        ({"half": (0.5, 1.0)}, -SPRINGS / 2 - DRAG),
        ({"half": (1.0, 0.5)}, -SPRINGS - DRAG / 2),
        ({"speed": "once"}, -SPRINGS - 0.5 * (5 + 128**0.5)),
        ({"rate": "once"}, -0.1 * 5 - 0.3 * 13 - DRAG),
        ({"rate": "sloppy"}, -0.1 * 25**2 - 0.3 * 169**2 - DRAG),
        ({"rate": "own"}, -OWN - DRAG),
    ],
    ids=str,
)
def test_power(wrong: dict[str, Any], power: float) -> None:
    """Damping takes c r^2 of a spring whose length changes at r, drag b v^2 of a mass."""
    assert SOLVED["power"](X, V, STRING, **wrong) == pytest.approx(power)


def test_power_of_a_spring_that_only_turns() -> None:
    """Its ends move across it: all of the relative velocity is wrong by all of it."""
    across = np.array([[4.0, 3.0], [4.0, 3.0]])
    still = namespace({**vars(STRING), "drag": 0.0})
    assert SOLVED["power"](X, across, still) == pytest.approx(0.0, abs=1e-12)
    assert SOLVED["power"](X, across, still, rate="all") == pytest.approx(-0.1 * 25)


@pytest.mark.parametrize("hidden", [False, True])
def test_strings_are_on_earth_and_on_the_moon_and_damped(hidden: bool) -> None:
    """Both questions about each, of so many masses; one flung about on the Moon, one that moves slowly, all ways."""
    asked = find("energy").questions(np.random.default_rng(1), hidden, "ada")
    counts = [len(q.arguments[0]) for q in asked]
    functions = [q.function for q in asked]
    assert counts == [n for n in ((1, 7, 4) if hidden else (4, 3)) for _ in range(2)] + [1, 1, 6, 6]
    assert functions == ["energy", "power"] * (len(asked) // 2)
    gravities = [q.arguments[2]["gravity"] for q in asked]
    few = len(asked) - 4
    assert gravities[:few] == [9.81, 9.81, 1.62, 1.62, 9.81, 9.81][:few]
    assert gravities[few:] == [9.81, 9.81, 1.62, 9.81]
    for question, count in zip(asked, counts, strict=True):
        x, v, string = question.arguments
        assert x.shape == v.shape == (count, 2)
        ratios = np.linalg.norm(np.diff(x, axis=0, prepend=string["anchor"][None]), axis=1) / string["rest_lengths"]
        assert ((ratios > 0.2) & (ratios < 5)).all()
        assert string["damping"].shape == (count,)
        assert ((string["damping"] >= 0.01) & (string["damping"] <= 0.1)).all()
    for some in (asked[:few], asked[few:]):
        dampings = np.concatenate([q.arguments[2]["damping"] for q in some])
        assert (dampings.min() < 0.04, dampings.max() > 0.06) == (True, True)
    slow = np.abs(asked[-1].arguments[1])
    assert ((slow >= 0.3) & (slow <= 1.0)).all()
    assert {tuple(way) for way in np.sign(asked[-1].arguments[1]).tolist()} == {
        (a, b) for a in (1, -1) for b in (1, -1)
    }
    assert np.abs(asked[-2].arguments[1]).max() > 50
