"""Questions are about what their words say."""

from __future__ import annotations

import ast
import re
from types import SimpleNamespace

import numpy as np
import pytest

from experiments.exercises.e10_bridge.exercise import heaviest
from experiments.exercises.exercise import Exercise, exercises, find
from experiments.exercises.handed_in.submission import header
from experiments.exercises.solutions.links import random_string
from experiments.exercises.solutions.on_strings import crumpled_string, wild_string
from tests.reference.systems import label


def test_a_starter_is_of_its_exercise_and_claims_nothing() -> None:
    """Its number; what its functions return is what they were given, in the order of the answer, or nothing.

    A cloth's is one spring, from the first mass to the second. Exercises take some quarters of an hour.
    """
    for number, exercise in exercises().items():
        assert header(exercise.starter)["EXERCISE"] == number
        assert (exercise.minutes % 15, 30 <= exercise.minutes <= 90) == (0, True)
        starter = ast.parse(exercise.starter)
        functions = {f.name: f for f in starter.body if isinstance(f, ast.FunctionDef)}
        for question in exercise.questions(np.random.default_rng(0), False, "ada"):
            returned = functions[question.function].body[-1]
            assert isinstance(returned, ast.Return)
            assert returned.value is not None
            words = ast.unparse(returned.value)
            if exercise.name == "cloth":
                assert words == "[(0, 1)]"
            elif question.parts in (("x", "v"), ("y", "v")):
                assert words == f"({', '.join(question.parts)})"
            else:
                assert not re.search(r"[1-9]", words), words


@pytest.mark.parametrize("exercise", exercises().values(), ids=label)
@pytest.mark.parametrize("hidden", [False, True])
def test_a_string_of_so_many_masses_has_so_many(exercise: Exercise, hidden: bool) -> None:
    """Where words count masses: as many masses, springs, positions, and numbers for each of them are asked about."""
    for seed in range(3):
        for question in exercise.questions(np.random.default_rng(seed), hidden, "ada"):
            counted = re.fullmatch(r"string of (\d+)", question.about)
            if counted:
                *states, string = question.arguments[:3]
                sizes = {len(array) for array in (*states, *(string[n] for n in ("masses", "stiffness", "damping")))}
                assert sizes == {int(counted[1])}, question.about


def test_random_strings_are_stretched_and_pushed_together_in_all_downward_directions() -> None:
    """Springs of 1.1 to 1.4 rest lengths, or 0.7 of that; to the left and to the right below what holds them."""
    positions, _, string = random_string(np.random.default_rng(1), 200)
    steps = np.diff(positions, axis=0, prepend=string["anchor"][None])
    ratios = np.linalg.norm(steps, axis=1) / string["rest_lengths"]
    stretched = (ratios >= 1.1) & (ratios <= 1.4)
    pushed = (ratios >= 0.77) & (ratios <= 0.98)
    assert (stretched | pushed).all()
    assert stretched.any()
    assert pushed.any()
    assert (steps[:, 1] < 0).all()
    assert (steps[:, 0] < 0).any()
    assert (steps[:, 0] > 0).any()


def test_wild_strings_have_all_that_a_law_must_hold_for() -> None:
    """As their docstring says, whatever the key: lengths, pulls, quarters and speeds, a mass heavier than it was drawn.

    Springs pull or push by k |l - l0| [N]; speeds are no more than a hundred metres a second and a fifth.
    """
    for seed in range(20):
        positions, velocities, string = wild_string(np.random.default_rng(seed))
        steps = np.diff(positions, axis=0, prepend=string["anchor"][None])
        lengths = np.linalg.norm(steps, axis=1)
        ratios = lengths / string["rest_lengths"]
        pulls = string["stiffness"] * (lengths - string["rest_lengths"])
        speeds = np.linalg.norm(velocities, axis=1)
        assert (ratios.max() < 5, ratios.min() > 0.2) == (True, True)
        assert ((ratios > 3.9).sum(), (ratios < 1 / 3).sum()) == (1, 1)
        assert (1e3 < pulls.max() < 2e4, np.sort(pulls)[-2] < 1e2) == (True, True)
        assert (0.3 < speeds.min() < 1, 80 <= speeds.max() <= 120, (speeds > 30).sum()) == (True, True, 2)
        for vectors in (steps, velocities):
            assert {(x > 0, y > 0) for x, y in vectors.tolist()} == {
                (a, b) for a in (True, False) for b in (True, False)
            }
        assert (string["masses"] >= 0.05).all()
        assert (string["masses"] <= 0.3).all()


def test_crumpled_strings_are_crumpled() -> None:
    """The first mass half a millimetre from its anchor, the second 6 to 13 cm from that, above it."""
    for seed in range(20):
        positions, _, string = crumpled_string(np.random.default_rng(seed))
        steps = np.diff(positions, axis=0, prepend=string["anchor"][None])
        near, far = np.linalg.norm(steps, axis=1)
        assert near == pytest.approx(5e-4, rel=1e-9)
        assert 0.06 * 2**0.5 <= far <= 0.09 * 2**0.5
        assert steps[1, 1] > 0
        assert string["drag"] == 0.0


@pytest.mark.parametrize("hidden", [False, True])
def test_no_mass_is_where_the_texts_rule_says_nothing(hidden: bool) -> None:
    """Exactly on the circle, or at its centre."""
    for seed in range(5):
        for question in find("barrier").questions(np.random.default_rng(seed), hidden, "ada"):
            x, _, circle = question.arguments[:3]
            distance = np.linalg.norm(x - circle["centre"], axis=1)
            assert (distance > 1e-6).all()
            assert (np.abs(distance - circle["radius"]) > 1e-6).all()


@pytest.mark.parametrize("hidden", [False, True])
def test_one_member_of_a_bridge_carries_most(hidden: bool) -> None:
    """Numbered the other way round it is the same one: of several that carry as much the first is found."""
    for seed in range(5):
        for question in find("bridge").questions(np.random.default_rng(seed), hidden, "ada"):
            if question.function == "heaviest":
                given = question.arguments[0]
                backwards = {**given, **{name: given[name][::-1] for name in ("members", "stiffness")}}
                (one, force), (other, same) = (heaviest(SimpleNamespace(**b)) for b in (given, backwards))
                assert one == len(given["members"]) - 1 - other
                assert force == pytest.approx(same, rel=1e-9)
