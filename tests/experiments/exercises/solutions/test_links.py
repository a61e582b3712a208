"""Forces on a string, right ones and wrong ones, made of springs that were worked out by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from experiments.exercises.solutions.links import LinkMotion, forces, namespace
from reference.state import Array, State

#: From each mass to what it hangs on [m]: 5, 13 and 17 long.
UP = np.array([[-3.0, 4.0], [5.0, 12.0], [-8.0, 15.0]])
LENGTHS = np.array([5.0, 13.0, 17.0])
ANCHOR = np.array([1.0, 2.0])
X = ANCHOR - np.cumsum(UP, axis=0)
V = np.array([[3.0, -4.0], [-5.0, 12.0], [8.0, 15.0]])
SPEEDS = np.array([5.0, 13.0, 17.0])
M, K, REST = np.array([2.0, 3.0, 7.0]), np.array([10.0, 20.0, 30.0]), np.array([2.0, 10.0, 20.0])
G, DRAG = 1.5, 0.5
STRING = namespace({"masses": M, "stiffness": K, "rest_lengths": REST, "drag": DRAG, "gravity": G, "anchor": ANCHOR})

#: The right pulls [N]: of the last, which is too short, it is a push.
PULLS = np.array([30.0, 60.0, -90.0])
UNIT = UP / LENGTHS[:, None]
WEIGHT = np.array([[0.0, -3.0], [0.0, -4.5], [0.0, -10.5]])
FRICTION = -DRAG * V


def hung(springs: Array, below: Array | None = None) -> Array:
    """On each mass the spring above, less what the spring below pulls at the next: its own, or others [N]."""
    total = springs.copy()
    total[:-1] -= springs[1:] if below is None else below
    return total


def pull(low: Array, high: Array, k: float, rest: float) -> Array:
    """What one spring pulls its lower mass with [N]."""
    away = high - low
    length = float(np.hypot(*away))
    return np.asarray(k * (length - rest) * away / length)


RIGHT = hung(PULLS[:, None] * UNIT)
OTHERS = WEIGHT + FRICTION
BETWEEN_ENDS = pull(X[2], X[0], 10.0, 2.0)
ON_ANCHOR = pull(X[1], ANCHOR, 20.0, 10.0)
FIRST, SECOND, THIRD = PULLS[:, None] * UNIT
NONE = np.zeros(2)

#: By what the spring below a mass is taken for, its pulls on the next mass.
BELOW = {
    "above": [pull(X[1], X[0], 10.0, 2.0), pull(X[2], X[1], 20.0, 10.0)],
    "stiffness of above": [pull(X[1], X[0], 10.0, 10.0), pull(X[2], X[1], 20.0, 20.0)],
    "rest length of above": [pull(X[1], X[0], 20.0, 2.0), pull(X[2], X[1], 30.0, 10.0)],
    "own side": [SECOND, THIRD],
}

ANGLES = np.degrees(np.arctan2(UP[:, 1], UP[:, 0]))
IN_DEGREES = PULLS[:, None] * np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1)
BACK = np.degrees(np.arctan2(-UP[1:, 1], -UP[1:, 0]))
IN_DEGREES_BACK = -PULLS[1:, None] * np.stack([np.cos(BACK), np.sin(BACK)], axis=1)
BY_AXIS = np.array([[-10.0, 20.0], [20 * -5.0, 20 * 2.0], [30 * 12.0, 30 * -5.0]])

#: The springs' part of wrong forces.
SPRINGS: dict[str, tuple[dict[str, Any], Any]] = {
    "right": ({}, RIGHT),
    "sign": ({"elastic": -1.0}, -RIGHT),
    "none": ({"elastic": 0.0}, 0 * RIGHT),
    "rest added": ({"rest": -1.0}, hung(np.array([70.0, 460.0, 1110.0])[:, None] * UNIT)),
    "no rest": ({"rest": 0.0}, hung((K * LENGTHS)[:, None] * UNIT)),
    "squares": ({"length": "square"}, hung((K * (LENGTHS**2 - REST) / LENGTHS**2)[:, None] * UP)),
    "sums": ({"length": "sum"}, hung(np.array([10 * 5 / 7, 20 * 7 / 17, 30 * 3 / 23])[:, None] * UP)),
    "not normalised": ({"direction": "sloppy"}, hung(PULLS[:, None] * UP)),
    "by rest length": ({"direction": "rest length"}, hung((PULLS / REST)[:, None] * UP)),
    "each axis": ({"direction": "each axis"}, hung(BY_AXIS)),
    "each axis, slack": (
        {"direction": "each axis", "slack": True},
        hung(np.array([[-10.0, 20.0], [0.0, 40.0], [0.0, 0.0]])),
    ),
    "degrees": ({"direction": "degrees"}, hung(IN_DEGREES)),
    "degrees, own side": ({"direction": "degrees", "below": "own side"}, hung(IN_DEGREES, IN_DEGREES_BACK)),
    "swapped": ({"direction": "swapped"}, hung(PULLS[:, None] * UNIT[:, ::-1])),
    "slack": ({"slack": True}, hung(np.array([FIRST, SECOND, NONE]))),
    "origin": ({"anchor": "origin"}, hung(np.array([pull(X[0], NONE, 10.0, 2.0), SECOND, THIRD]))),
    "no anchor": ({"anchor": "missing"}, hung(np.array([NONE, SECOND, THIRD]))),
    "second on anchor": ({"anchor": "second"}, hung(np.array([FIRST, ON_ANCHOR, THIRD]))),
    "second, from above": (
        {"anchor": "second, from above"},
        hung(np.array([FIRST, ON_ANCHOR, THIRD]), np.array([SECOND, THIRD])),
    ),
    "wraps": ({"last": "wraps"}, RIGHT + np.array([NONE, NONE, BETWEEN_ENDS])),
    "ring": ({"last": "ring"}, RIGHT + np.array([-BETWEEN_ENDS, NONE, BETWEEN_ENDS])),
    "rolls": ({"last": "rolls"}, RIGHT - np.array([NONE, NONE, FIRST])),
    "above only": ({"sides": "above"}, np.array([FIRST, SECOND, THIRD])),
    "below only": ({"sides": "below"}, np.array([-SECOND, -THIRD, NONE])),
    "same side": ({"sides": "same"}, np.array([FIRST + SECOND, SECOND + THIRD, THIRD])),
    **{name: ({"below": name}, hung(PULLS[:, None] * UNIT, np.array(pulls))) for name, pulls in BELOW.items()},
}


@pytest.mark.parametrize("name", SPRINGS)
def test_what_springs_pull_with(name: str) -> None:
    """Beside weight and drag, which are as they should be; what is given stays as it was."""
    wrong, springs = SPRINGS[name]
    x, v = X.copy(), V.copy()
    assert forces(x, v, STRING, **wrong) == pytest.approx(springs + OTHERS, rel=1e-12, abs=1e-12)
    assert (x.tolist(), v.tolist()) == (X.tolist(), V.tolist())


@pytest.mark.parametrize(
    ("wrong", "others"),
    [
        ({"gravity": -1.0}, FRICTION - WEIGHT),
        ({"weight": "none"}, FRICTION),
        ({"weight": "g"}, FRICTION - G * np.array([[0, 1]] * 3)),
        ({"weight": "m 9.81"}, FRICTION - 9.81 * np.outer(M, [0, 1])),
        ({"weight": "both axes"}, FRICTION - G * np.outer(M, [1, 1])),
        ({"weight": "along x"}, FRICTION - G * np.outer(M, [1, 0])),
        ({"drag": -1.0}, WEIGHT - FRICTION),
        ({"drag": 0.0}, WEIGHT),
        ({"friction": "m c v"}, WEIGHT + M[:, None] * FRICTION),
        ({"friction": "c v^2"}, WEIGHT + SPEEDS[:, None] * FRICTION),
        ({"friction": "c |v|"}, WEIGHT - DRAG * np.abs(V)),
    ],
    ids=str,
)
def test_weight_and_drag(wrong: dict[str, Any], others: Array) -> None:
    """Beside the springs, which pull as they should."""
    assert forces(X, V, STRING, **wrong) == pytest.approx(RIGHT + others, rel=1e-12)


def test_who_gets_no_force_and_who_accelerations() -> None:
    """The first or the last; all of them."""
    for skipped in (0, -1):
        wanted = RIGHT + OTHERS
        wanted[skipped] = 0.0
        assert forces(X, V, STRING, skipped=skipped) == pytest.approx(wanted, rel=1e-12)
    accelerations = (RIGHT + OTHERS) / M[:, None]
    assert forces(X, V, STRING, divided=True) == pytest.approx(accelerations, rel=1e-12)
    state = State(0.0, X, V)
    for inertia, power in (("divided", -1), ("forgotten", 0), ("multiplied", 1)):
        motion = LinkMotion(STRING, inertia, gravity=-1.0)
        wanted = (RIGHT + FRICTION - WEIGHT) * M[:, None] ** power
        assert motion.acceleration(state) == pytest.approx(wanted, rel=1e-12)
        assert motion.acceleration_of(1, state) == pytest.approx(wanted[1], rel=1e-12)
        slope = motion.slope(state)
        assert (slope.time, slope.positions.tolist()) == (1.0, V.tolist())
        assert slope.velocities == pytest.approx(wanted, rel=1e-12)


def test_one_mass_has_nothing_below_it() -> None:
    """Whatever is taken for what: its spring, weight and drag; only of an array that is rolled it has its own again."""
    alone = namespace(
        {**vars(STRING), **{name: getattr(STRING, name)[:1] for name in ("masses", "stiffness", "rest_lengths")}}
    )
    right = FIRST + OTHERS[0]
    for wrong in ({}, {"last": "wraps"}, {"last": "ring"}, {"anchor": "second"}, {"sides": "above"}):
        assert forces(X[:1], V[:1], alone, **wrong)[0] == pytest.approx(right)  # type: ignore[arg-type]
    assert forces(X[:1], V[:1], alone, last="rolls")[0] == pytest.approx(OTHERS[0])
    assert forces(X[:1], V[:1], alone, sides="below")[0] == pytest.approx(OTHERS[0])


@pytest.mark.parametrize(
    ("y", "length", "pull"),
    [
        (-0.5, "root", 10 * (0.5 - 0.2)),
        (-0.5, "signed", 10 * (0.5 - 0.2)),
        (-0.5, "y", 10 * (-0.5 - 0.2)),
        (0.5, "root", -10 * (0.5 - 0.2)),
        (0.5, "signed", 10 * (-0.5 - 0.2)),
        (0.5, "y", 10 * (0.5 - 0.2)),
    ],
)
def test_in_one_dimension_a_length_may_have_a_sign(y: float, length: str, pull: float) -> None:
    """Of a mass below or above its anchor; upwards is more than nothing [N]."""
    fields = {"masses": np.ones(1), "stiffness": np.array([10.0]), "rest_lengths": np.array([0.2])}
    string = namespace({**fields, "drag": 0.0, "gravity": 0.0, "anchor": np.zeros(1)})
    one = np.array([[y]])
    assert forces(one, 0 * one, string, length=length)[0, 0] == pytest.approx(pull)
    sloppy = forces(one, 0 * one, string, length=length, direction="sloppy")[0, 0]
    lengths = {"root": 0.5, "signed": -y, "y": y}
    assert sloppy == pytest.approx(10 * (lengths[length] - 0.2) * -y)
