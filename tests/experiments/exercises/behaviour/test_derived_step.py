"""What a wrong step of an exercise computes, derived: its own formulas, and which entry is not as it should be."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from experiments.exercises.behaviour import derived_step
from experiments.exercises.behaviour.derived_step import _ends, _matrices
from experiments.exercises.closer_look import Effort, look_closer
from experiments.exercises.exercise import Question, find
from experiments.exercises.process import sandbox
from experiments.exercises.verdict.answer_catalogue import catalogue_of
from experiments.exercises.verdict.judge import judge
from tests.experiments.exercises.test_closer_look import model

pytestmark = pytest.mark.usefixtures("trusted")


def told(number: int, old: str, new: str) -> str:
    """What is said of a model solution with other words; empty where nothing is."""
    exercise = find(str(number))
    asked = derived_step.questions(exercise, catalogue_of(exercise, "example", None).questions)
    text = model(number)
    assert old in text
    answers = sandbox.run(text.replace(old, new), [question.asked() for question in asked]).answers
    return " ".join(finding.words for finding in derived_step.seen(exercise, asked, answers))


@pytest.mark.parametrize(
    ("number", "old", "new", "matrix", "wrong"),
    [
        # Euler is [[1, 1], [-a, 1 - b]]
        (
            1,
            "v + dt * force",
            "v - dt * force",
            "new h v = (a) x + (1 + b) h v",
            "x in the new h v and h v in the new h v",
        ),
        (
            2,
            "(y1 + y2) / 2",
            "(y1 + y2) / 3",
            "new x = (1 - a/3) x + (2/3 - b/3) h v",
            "x in the new x and h v in the new x",
        ),
        # numbers a million times as large have roundings a million times as large
        (
            1,
            "v + dt * force",
            "v + 2**20 * dt * force / 3",
            "new h v = (-1048576 a/3) x",
            "x in the new h v and h v in the new h v",
        ),
        (
            4,
            "dt * (a + b) / 2",
            "dt * (a + b) / 3",
            "new h v = (-2 a/3 + a b/3) x",
            "x in the new h v and h v in the new h v",
        ),
    ],
)
def test_the_students_own_formulas_are_told(number: int, old: str, new: str, matrix: str, wrong: str) -> None:
    """By hand, from Euler's and Heun's steps of x'' = -(k x + c x')/m with the change in them."""
    words = told(number, old, new)
    assert matrix in words
    assert words.endswith(f"Not as it should be: {wrong}.")


def test_an_entry_is_wrong_where_it_is_for_one_oscillator() -> None:
    """Also where it is right for another: here by b - b0, which is 0 for the first of them."""
    exercise = find("1")
    asked = derived_step.questions(exercise, catalogue_of(exercise, "example", None).questions)
    b0 = asked[0].arguments[3]["damping"] * asked[0].arguments[2]
    answers = []
    for question in asked:
        (x, v), (at, _, dt, spring) = exercise.right_at_first(question), question.arguments
        off = (spring["damping"] * dt - b0) * (-1.0 - at) / dt
        answers.append({"values": [[x, v - off]]})
    (found,) = derived_step.seen(exercise, asked, answers)
    assert found.words.endswith("Not as it should be: x in the new h v.")


@pytest.mark.parametrize("number", [1, 2, 4])
def test_nothing_is_said_of_a_right_step_or_of_what_acts_otherwise(number: int) -> None:
    """A model solution; one that raises; exercises that are no step are not asked."""
    assert told(number, "dt", "dt") == ""
    assert told(number, "def step(", "def other(") == ""
    assert derived_step.questions(find("3"), catalogue_of(find("3"), "example", None).questions) == []


def test_where_dt_stands_by_itself_no_formula_is_told() -> None:
    """For x + v the entry would be 1/h: a number at this one h only."""
    assert told(1, "y + dt * v", "y + dt * dt * v") == ""
    assert told(1, "y + dt * v", "y + v") == ""


STRING = dict.fromkeys(("masses", "stiffness", "rest_lengths", "drag", "gravity", "anchor"), 1.0)
SPRING = dict.fromkeys(("mass", "stiffness", "rest_length", "damping", "gravity"), 1.0)


@pytest.mark.parametrize(
    ("fields", "parts", "given", "asked"),
    [
        (SPRING, ("y", "v"), 4, True),
        (STRING, ("x", "v"), 4, True),
        ({**SPRING, "more": 1.0}, ("y", "v"), 4, True),
        (dict.fromkeys(derived_step.SPRING, 1.0), ("y", "v"), 4, True),
        (dict.fromkeys(derived_step.STRING, 1.0), ("x", "v"), 4, True),
        ({**STRING, "damping": 1.0}, ("x", "v"), 4, False),
        ({"centre": 1.0, "radius": 1.0}, ("x", "v"), 4, False),
        ({name: 1.0 for name in SPRING if name != "mass"}, ("y", "v"), 4, False),
        (SPRING, ("y",), 4, False),
        (SPRING, ("y", "v"), 3, False),
        (1.0, ("y", "v"), 4, False),
    ],
)
def test_steps_of_one_spring_or_one_string_are_asked_for(
    fields: Any, parts: tuple[str, ...], given: int, asked: bool
) -> None:
    """Each displaced and each moving, without gravity, so that it rests at -1 m; a few of them with half the dt."""
    question = Question("step", (*[0.0] * (given - 1), fields), parts, "")
    made = derived_step.questions(find("1"), [Question("other", (), ("x",), ""), question])
    assert bool(made) == asked
    for one in made:
        x, v, dt, own = one.arguments
        k, m, c = (
            np.ravel(own[name if name in own else other]).item()
            for name, other in (("stiffness", "stiffness"), ("mass", "masses"), ("damping", "drag"))
        )
        assert (m, own["gravity"]) == (1.0, 0.0)
        assert own[next(name for name in own if name.startswith("rest_length"))] == 1.0
        assert 0.0 < k * dt**2 <= 2.0
        assert 0.0 < c * dt <= 1.0
        below, down = -1.0 - np.ravel(x)[-1], -np.ravel(v)[-1]
        assert (below, down * dt) in ((1 / 32, 0.0), (0.0, 1 / 32))
        assert np.size(x) == np.size(v) == (2 if "drag" in own else 1)
    steps = sorted({one.arguments[2] for one in made})
    assert steps == ([1 / 32, 1 / 16] if asked else [])
    assert len(made) == (2 * (40 + 4) if asked else 0)


def test_it_is_part_of_the_closer_look() -> None:
    """With what else is seen of a wrong program."""
    exercise, text = find("2"), model(2).replace("dt * (y1 + y2) / 2", "dt * (2 * y1 + y2) / 3")
    verdict = judge(exercise, text, "example")
    closer = look_closer(exercise, text, "example", verdict, effort=Effort(0.0, 0.0))
    assert "derived_step" in [finding.name for finding in closer.findings]


@pytest.mark.parametrize(
    ("x", "v", "end"),
    [
        (-1.25, 0.5, (0.25, -0.5)),
        (np.array([-3.0]), np.array([2.0]), (2.0, -2.0)),
        (np.array([[7.0, -1.5]]), np.array([[9.0, 4.0]]), (0.5, -4.0)),
        (np.array([[7, -2]]), np.array([[9, 4]]), (1.0, -4.0)),
        (np.array([[7.0, -1.5]]), np.array([4.0]), None),
        (np.ones((2, 2)), np.ones((2, 2)), None),
        (np.array("down"), 1.0, None),
        (-1.0, np.array("fast"), None),
    ],
)
def test_an_end_is_how_far_below_its_rest_the_mass_is_and_how_fast_it_goes_down(x: Any, v: Any, end: object) -> None:
    """Of a number, or of the height of one mass in the plane; nothing else is one."""
    assert _ends((x, v)) == end
    assert _ends([]) is None
    assert _ends((x,)) is None


def test_a_step_matrix_has_a_column_for_each_begin() -> None:
    """Displaced and moving by turns: x and dt v of their ends, as parts of how far aside they begin."""
    from reference.derivation.oscillators import ASIDE

    asked = [Question("step", (0.0, 0.0, dt, {}), ("x", "v"), "") for dt in (0.5, 0.5, 0.25, 0.25)]
    ends = [(1.0 * ASIDE, 4.0 * ASIDE), (3.0 * ASIDE, 6.0 * ASIDE), (5.0 * ASIDE, 8.0 * ASIDE), (0.0, 12.0 * ASIDE)]
    found = _matrices(asked, ends)
    assert found is not None
    assert found == pytest.approx(np.array([[[1.0, 3.0], [2.0, 3.0]], [[5.0, 0.0], [2.0, 3.0]]]))
    for missing in (None, (np.nan, 1.0), (1.0, np.inf)):
        assert _matrices(asked, [*ends[:3], missing]) is None
    assert _matrices([], []) is None
