"""What a step of one's own is given of a system."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.own.system import exercise_spring, exercise_string
from reference.errors import InputError, Unsupported
from reference.scenes import find


def test_a_string_is_given_without_its_fixed_mass_and_can_be_written_to() -> None:
    """As exercises 3 and 4 have it: arrays of one's own, so that who writes into them changes nothing else."""
    system = find("string").system({"masses": 4, "drag": 0.2})
    before = system.to_dict()
    given = exercise_string(system)
    np.testing.assert_array_equal(given.masses, system.masses[1:])
    np.testing.assert_array_equal(given.anchor, system.positions[0])
    assert (given.drag, given.gravity) == (0.2, 9.81)
    for name in ("masses", "stiffness", "rest_lengths", "anchor"):
        getattr(given, name)[...] = 7.0
    assert system.to_dict() == before


def test_one_hanging_mass_is_given_as_numbers() -> None:
    """As exercises 1 and 2 have it."""
    system = find("oscillator").system({"stiffness": 40.0, "mass": 0.3})
    given = exercise_spring(system)
    assert (given.mass, given.stiffness) == (0.3, 40.0)


@pytest.mark.parametrize("scene", ["cloth", "jello"])
def test_what_is_no_string_is_not_given(scene: str) -> None:
    """A step for strings would leave springs out."""
    system = find(scene).system({})
    for given in (exercise_string, exercise_spring):
        with pytest.raises((Unsupported, InputError), match="knows"):
            given(system)


@pytest.mark.parametrize("damped", [[0], [1], [0, 1]])
def test_a_string_with_one_damped_spring_is_none_of_exercise_4(damped: list[int]) -> None:
    """Its step knows no damping: whichever spring has some, it would be left out in silence."""
    string = find("string").system({"masses": 2})
    assert exercise_string(string).masses.shape == (2,)
    damping = np.zeros(2)
    damping[damped] = 0.1
    with pytest.raises(Unsupported, match="strings without damping only"):
        exercise_string(replace(string, damping=damping))
