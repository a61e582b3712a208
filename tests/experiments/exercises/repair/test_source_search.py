"""How near a program comes to the right answers, in numbers."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from experiments.exercises.repair.program import Program
from experiments.exercises.repair.source_search import Search, _few_of

#: Doubled, and added up.
QUESTION = {
    "function": "step",
    "arguments": [np.array([1.0, 2.0])],
    "parts": ["double", "sum"],
    "steps": 0,
    "right": [[np.array([2.0, 4.0]), np.array(3.0)]],
    "scales": [1.0, 1.0],
    "tolerance": 1e-9,
    "pairs": False,
}


def step(x: Any) -> Any:
    """What is right."""
    return 2 * x, x.sum()


def in_place(x: Any) -> Any:
    """The right numbers, but the input is changed."""
    total = x.sum()
    x *= 2
    return x, total


def half_right(x: Any) -> Any:
    """A wrong sum, by a thousandth."""
    return 2 * x, x.sum() + 1e-3


def far_off(x: Any) -> Any:
    """A wrong sum, by a hundred."""
    return 2 * x, x.sum() + 100


def broken(x: Any) -> Any:
    """No answer."""
    raise ValueError(x)


@pytest.mark.parametrize(
    ("program", "right", "share"),
    [(step, 1, 1.0), (in_place, 0, 0.5), (half_right, 0, (2 + 3 / 8) / 3), (far_off, 0, 2 / 3), (broken, 0, 0.0)],
)
def test_a_program_comes_as_near_as_its_share_of_right_numbers(
    program: Callable[[Any], Any], right: int, share: float
) -> None:
    """Of three numbers. One that is off by 1e-3 has three right digits, an eighth each; a changed input halves all."""
    search = Search([], Program(ast.parse("")), [QUESTION], np.copy, lambda a, b: not np.array_equal(a, b))
    found = search.nearness({"step": program}, [QUESTION])
    assert found == (right, pytest.approx(share, rel=1e-6))


@pytest.mark.parametrize(
    ("sizes", "asked"),
    [
        ([7], [7]),
        ([7, 2], [2, 7]),
        ([7, 2, 4], [2, 4, 7]),
        ([7, 2, 9, 4], [2, 7, 9]),
        ([7, 2, 9, 4, 1, 3], [1, 4, 9]),
    ],
)
def test_changes_are_tried_on_a_small_question_first(sizes: list[int], asked: list[int]) -> None:
    """Then on one of the middle, and on the largest; each once, counted by all numbers in arguments and fields."""
    questions = [{"arguments": [np.zeros(size - 1), {"field": 1.0}]} for size in sizes]
    found = _few_of(questions)
    assert [question["arguments"][0].size + 1 for question in found] == asked
