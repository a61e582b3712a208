"""How far two answers are apart, by hand: several parts, several steps, what blows up, what has another form."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from experiments.exercises.exercise import find
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue
from experiments.exercises.verdict.answer_distance import LARGEST, answer_distance, part_distance, scales_of


def answer(*steps: Sequence[Any]) -> list[list[Any]]:
    """Steps of parts."""
    return [[np.array(part) for part in step] for step in steps]


RIGHT = answer(([1.0, -2.0], 8.0), ([4.0, 3.0], -0.5), ([0.0, 1.0], 2.0))


def test_the_scale_of_a_part_is_its_largest_number_in_any_step() -> None:
    """By size; 1 of zeros and of words; infinite where one is not finite."""
    assert scales_of(RIGHT) == [4.0, 8.0]
    assert scales_of(answer(([0.0, 0.0], "up", [1.0, np.nan]))) == [1.0, 1.0, np.inf]


@pytest.mark.parametrize(
    ("step", "part", "number", "far"),
    [(0, 0, [1.0, -1.0], 0.25), (2, 0, [2.0, 1.0], 0.5), (1, 1, 1.5, 0.25), (2, 1, 6.0, 0.5)],
)
def test_a_difference_counts_beside_the_scale_of_its_part(step: int, part: int, number: Any, far: float) -> None:
    """In every step and part; and the largest of all counts."""
    given = [list(parts) for parts in RIGHT]
    given[step][part] = np.array(number)
    assert answer_distance(given, RIGHT, [4.0, 8.0]) == far
    given[0][1] = np.array(0.0)
    assert answer_distance(given, RIGHT, [4.0, 8.0]) == 1.0


@pytest.mark.parametrize("step", [0, 1, 2])
def test_another_shape_in_one_step_cannot_be_compared(step: int) -> None:
    """Nor another number of steps; words only with words."""
    given = [list(parts) for parts in RIGHT]
    given[step][0] = np.array([1.0, 2.0, 3.0])
    assert answer_distance(given, RIGHT, [4.0, 8.0]) == np.inf
    assert answer_distance(RIGHT[:2], RIGHT, [4.0, 8.0]) == np.inf
    up, down, one = (answer((word,)) for word in ("up", "down", 1.0))
    assert [answer_distance(given, up, [1.0]) for given in (up, down, one)] == [0.0, np.inf, np.inf]


@pytest.mark.parametrize("part", [0, 1])
def test_from_a_blow_up_on_nothing_is_compared(part: int) -> None:
    """Of any part: beyond LARGEST of the scale. Below that a difference counts beside the step's own largest number."""
    numbers: list[list[Any]] = [[1.0, 1.0], [2.0, 2.0], [1.0, 1.0], [1.0, 1.0]]
    numbers[2][part] = 1.01 * LARGEST
    given = answer(*numbers[:2], [5.0, 5.0], [5.0, 5.0])
    assert answer_distance(given, answer(*numbers), [1.0, 1.0]) == 0.0
    given[1][1 - part] = np.array(1.0)
    assert answer_distance(given, answer(*numbers), [1.0, 1.0]) == 0.5
    numbers[2][part] = LARGEST
    given = answer(*numbers)
    given[2][part] = np.array(0.75 * LARGEST)
    assert answer_distance(given, answer(*numbers), [1.0, 1.0]) == 0.25
    given[3][part] = np.array(-1.0)
    assert answer_distance(given, answer(*numbers), [1.0, 1.0]) == 2.0


def test_the_first_step_counts_however_large_it_is() -> None:
    """Alone or with others; what is no number on both sides is nothing to compare, on one side it is."""
    for later in ([], [[0.0]]):
        given, right = answer([1e5], *later), answer([2e5], *later)
        assert answer_distance(given, right, [1.0]) == 1e5 / LARGEST
    for numbers, far in (([np.nan, 1.0], 0.0), ([0.0, 1.0], np.inf), ([np.nan, 2.0], 0.01)):
        assert part_distance(np.array(numbers), np.array([np.inf, 1.0]), 1.0) == far
    assert part_distance(np.ones(2), np.ones((2, 1)), 1.0) == np.inf


def test_numbers_that_are_typed_count_beside_the_answer_that_they_are_compared_with() -> None:
    """In exercise 5: beside its largest number by size in any step; where that is 0, beside 1e-9 of what is right.

    Elsewhere beside what is right.
    """
    for number, scales in (("5", [[4.0, 8.0], [4.0, 8e-9]]), ("4", [[2.0, 8.0], [2.0, 8.0]])):
        catalogue = AnswerCatalogue(find(number), [])
        catalogue.__dict__["scales"] = [[2.0, 8.0]]
        assert catalogue._sizes(0, RIGHT) == scales[0]
        catalogue.__dict__["scales"] = [[9.0, 9.0], [2.0, 8.0]]
        zero = answer(([4.0, 1.0], 0.0), ([-3.0, 0.0], 0.0))
        assert catalogue._sizes(1, zero) == pytest.approx(scales[1], abs=0.0)
