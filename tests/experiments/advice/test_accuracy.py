"""The dt for a wanted accuracy, predicted from a scheme's order: an engine run with it is as near as asked."""

from __future__ import annotations

from dataclasses import replace

import pytest

from engines.engine import find as find_engine
from engines.process.isolation import EngineStepper
from experiments.advice.accuracy import PART, Accurate, accurate_steps, sentences, table
from experiments.runs.comparison import compare
from reference.scenes import Setup, find

SETUP = Setup("short", find("string").system({"masses": 3, "drag": 0.02}), 1e-4, 0.1)


def found(name: str) -> Accurate:
    """Of one engine on a short run."""
    (one,) = accurate_steps(compare(SETUP, [EngineStepper(find_engine(name))]), [])
    return one


def check_step(name: str, factor: float = 1.0) -> None:
    """With the predicted dt the largest distance from the true motion is PART of the size, to a fifth.

    The next term of the error is one more power of dt; steps are rounded down by less than a tenth.
    """
    dt = factor * found(name).dt
    (run,) = compare(replace(SETUP, dt=dt), [EngineStepper(find_engine(name))]).runs
    assert run.largest_error is not None
    assert 0.75 * PART < run.largest_error / SETUP.system.size < 1.2 * PART


@pytest.mark.rotating(3, in_turn=True)
def test_an_engine_with_the_predicted_step_is_as_near_as_asked() -> None:
    """Kick-drift, of first order."""
    check_step("mujoco_tendons")


@pytest.mark.rotating(3, in_turn=True)
def test_a_step_twice_as_long_is_not() -> None:
    """Shown to fail."""
    with pytest.raises(AssertionError):
        check_step("mujoco_tendons", 2.0)


def test_sentences_and_table_have_the_shortest_and_the_longest() -> None:
    """By value, and which of them stability bounds."""
    one, other = Accurate("slow", 0.02, 1, 5e-4, False), Accurate("quick", 1e-6, 4, 0.01, True)
    (said,) = sentences([one, other], 1e-3)
    assert said.index("slow needs dt = 0.0005 s") < said.index("quick 0.01 s")
    assert [row[3:] for row in table([one, other]).rows] == [[5e-4, "accuracy"], [0.01, "stability"]]
    assert sentences([], 1e-3) == []
