"""A step of one mass, by hand; with another clock, and with the numbers of the starter's example."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from experiments.exercises.exercise import mistake
from experiments.exercises.solutions.links import namespace
from experiments.exercises.solutions.one_mass import EXAMPLE, FLY, on_one_mass, step_of_one
from experiments.exercises.solutions.stepping import step

Y, V, DT = -0.3, 0.7, 0.25
GIVEN = {"mass": 2.0, "stiffness": 10.0, "rest_length": 0.1, "damping": 0.5, "gravity": 1.5}


def by_hand(dt: float = DT, **other: float) -> tuple[float, float]:
    """Euler's step of y'' = (k (-y - l) - c y') / m - g."""
    m, k, length, c, g = {**GIVEN, **other}.values()
    return Y + dt * V, V + dt * ((k * (-Y - length) - c * V) / m - g)


def test_a_step_of_one_mass() -> None:
    """Numbers in, numbers out."""
    found = step_of_one(Y, V, DT, SimpleNamespace(**GIVEN), "euler")
    assert found == pytest.approx(by_hand(), rel=1e-14)
    assert [type(number) for number in found] == [float, float]


@pytest.mark.parametrize("own", [("mass",), ("stiffness", "gravity"), ("rest_length", "damping"), tuple(EXAMPLE)])
def test_numbers_of_the_example_are_taken_for_those_that_are_given(own: tuple[str, ...]) -> None:
    """50 g on 50 N/m, 15 cm long at rest, undamped, on Earth; the others are those that are given."""
    example = {"mass": 0.05, "stiffness": 50.0, "rest_length": 0.15, "damping": 0.0, "gravity": 9.81}
    found = step_of_one(Y, V, DT, SimpleNamespace(**GIVEN), "euler", own)
    assert found == pytest.approx(by_hand(**{name: example[name] for name in own}), rel=1e-14)


@pytest.mark.parametrize(
    ("clock", "took"), [("dt", 0.25), ("twice", 0.0625), ("none", 1.0), ("half", 0.125), ("double", 0.5)]
)
def test_what_is_taken_for_dt(clock: str, took: float) -> None:
    """Itself, its square, 1, half and twice of it."""
    spring = SimpleNamespace(**GIVEN)
    assert step_of_one(Y, V, DT, spring, "euler", clock=clock) == pytest.approx(by_hand(took), rel=1e-14)


def test_a_step_by_a_scheme_of_the_catalogue_and_by_one_of_students() -> None:
    """Kick-drift is the reference's; where the positions stay is no scheme of it."""
    string: Any = namespace(
        {
            "masses": np.array([2.0]),
            "stiffness": np.array([10.0]),
            "rest_lengths": np.array([0.1]),
            "drag": 0.5,
            "gravity": 1.5,
            "anchor": np.zeros(1),
        }
    )
    x, v = np.array([[Y]]), np.array([[V]])
    _, faster = by_hand()
    for scheme, wanted in (("kick_drift", (Y + DT * faster, faster)), ("still_positions", (Y, faster))):
        found = step(x, v, DT, string, scheme)
        assert [float(part[0, 0]) for part in found] == pytest.approx(wanted, rel=1e-14)


def test_what_comes_with_one_mass() -> None:
    """Of those with which it flies above its anchor, the same with a length that has a sign; y for the length.

    And the example's numbers, each but the damping, and several.
    """
    given = [mistake(name, "", "", elastic=-1.0) for name in (FLY[0], "other", FLY[2])]
    own, signed, rest = on_one_mass(iter(given))[:3], on_one_mass(given)[3:5], on_one_mass(given)[5:]
    assert list(own) == given
    assert [(m.name, m.parameters) for m in signed] == [
        (FLY[0], {"elastic": -1.0, "length": "signed"}),
        (FLY[2], {"elastic": -1.0, "length": "signed"}),
    ]
    assert rest[0].parameters == {"length": "y"}
    assert {m.name for m in rest[1:]} == {"numbers_of_the_example"}
    numbers = [m.parameters["own"] for m in rest[1:]]
    assert [names for names in numbers if len(names) == 1] == [(n,) for n in EXAMPLE if n != "damping"]
    assert [set(names) for names in numbers if len(names) > 1] == [
        set(EXAMPLE) - {"damping", "gravity"},
        set(EXAMPLE) - {"damping"},
        set(EXAMPLE),
    ]
