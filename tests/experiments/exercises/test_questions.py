"""Questions are about what their words say."""

from __future__ import annotations

import re

import numpy as np
import pytest

from experiments.exercises.exercise import Exercise, exercises
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
