"""Questions are about what their words say."""

from __future__ import annotations

import re
from types import SimpleNamespace

import numpy as np
import pytest

from experiments.exercises.e10_bridge.exercise import heaviest
from experiments.exercises.exercise import Exercise, exercises, find
from experiments.exercises.solutions.links import random_string
from tests.reference.systems import label


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
