"""Which functions are not written yet: the starter's own, and those that do nothing."""

from __future__ import annotations

import pytest

from experiments.exercises.exercise import Exercise, exercises
from experiments.exercises.verdict.unwritten import unwritten

STARTER = "def a(x):\n    return 0.0\n\ndef b(x):\n    return 0.0\n"


@pytest.mark.parametrize(
    ("body", "empty"),
    [
        ("pass", True),
        ("'words'", True),
        ("raise NotImplementedError", True),
        ("raise NotImplementedError('later')", True),
        ("'words'\n    # mine\n    return 0.0", True),
        ("raise ValueError", False),
        ("NotImplementedError", False),
        ("pass\n    return x", False),
        ("return 1.0", False),
    ],
)
def test_what_does_nothing_is_not_written(body: str, empty: bool) -> None:
    """Nor is what stands in the starter; a function of another name is not there."""
    assert unwritten(f"def a(x):\n    {body}\n", STARTER, ["b", "a"]) == ["a"] * empty


def test_each_function_counts_once_and_in_the_order_asked_for() -> None:
    """Where Python cannot read the file none does."""
    assert unwritten(STARTER, STARTER, ["b", "a", "b"]) == ["b", "a"]
    assert unwritten("def a(:", STARTER, ["a"]) == []


@pytest.mark.parametrize("exercise", exercises().values(), ids=lambda e: e.name)
def test_a_starter_is_not_written_and_hands_back_what_it_was_given_in_order(exercise: Exercise) -> None:
    """Of a step the state, in the order in which it is to be returned: who writes one line has the other right."""
    functions = list(exercise.solutions)
    assert unwritten(exercise.starter, exercise.starter, functions) == functions
    step = exercise.starter.partition("def step(")[2]
    if step:
        state = step.split(", dt")[0]
        assert f"return {state}\n" in f"{exercise.starter}\n"
