"""Which engine is it: names that are taken for each other, given in another form, missing, or given twice."""

from __future__ import annotations

import csv
import json
from io import StringIO

import numpy as np
import pytest

from experiments.exercises.e08_which_engine.exercise import KNOWN, chosen
from experiments.exercises.exercise import find
from experiments.exercises.solutions.links import namespace
from experiments.exercises.solutions.stepping import step

EXERCISE = find("which_engine")
(QUESTION,) = EXERCISE.questions(np.random.default_rng(0), False, "ada")


def told(*names: str) -> tuple[str, str]:
    """Name and words of what is said of these."""
    assert EXERCISE.diagnose is not None
    found = EXERCISE.diagnose(QUESTION, np.array(names))
    return (found[0], found[1]) if found else ("", "")


def test_five_of_eight_are_behind_the_letters() -> None:
    """Kick-drift and drift-kick always; the others, and their order, follow from the seed and nothing else."""
    seen, orders = set(), set()
    for i in range(40):
        names, random = chosen(f"student {i}")
        assert len(names) == len(set(names)) == 5
        assert {"kick_drift", "drift_kick"} < set(names) < set(KNOWN)
        again, other = chosen(f"student {i}")
        assert (names, random.random()) == (again, other.random())
        seen |= set(names)
        orders.add(tuple(names))
    assert seen == set(KNOWN)
    assert len(orders) > 30


def test_wrong_names() -> None:
    """Two taken for each other, one letter off either way, from the end; and the right ones."""
    right = chosen("ada")[0]
    names = EXERCISE.solutions["names"]
    assert names("ada").tolist() == right
    assert names("ada", shifted=1).tolist() == [*right[1:], right[0]]
    assert names("ada", shifted=-1).tolist() == [right[-1], *right[:-1]]
    assert names("ada", order=-1).tolist() == right[::-1]
    swapped = names("ada", swap=(right[1], right[4])).tolist()
    assert swapped == [right[0], right[4], right[2], right[3], right[1]]
    assert QUESTION.own == {"seed": "ada"}


def test_names_may_be_written_in_other_ways() -> None:
    """With capitals, hyphens and spaces; what are no words is left as it is."""
    given = np.array(["Kick-Drift", " heun link by link ", "RK4"])
    assert EXERCISE.canonical is not None
    assert EXERCISE.canonical(QUESTION, given).tolist() == ["kick_drift", "heun_link_by_link", "rk4"]
    assert EXERCISE.canonical(QUESTION, np.array([1.5])).tolist() == [1.5]


def test_what_cannot_be_right_is_told() -> None:
    """A name that is missing, that nobody has, that two or three have; of another count of names nothing."""
    assert told("euler", "heun", "kick_drift", "rk4", "midpoint") == ("", "")
    assert told("euler", "heun", "", "rk4", "midpoint") == ("name_missing", "There is no name for C.")
    assert told("euler", "heun", "leapfrog", "", "euler") == ("unknown_name", "'leapfrog' is none of the eight names.")
    assert told("x" * 60, "heun", "rk4", "euler", "midpoint")[1] == f"{'x' * 40!r} is none of the eight names."
    twice = told("euler", "heun", "rk4", "heun", "midpoint")
    assert twice == ("name_twice", "You call B and D heun: no two of them are the same.")
    assert told("rk4", "heun", "rk4", "heun", "rk4")[1].startswith("You call B and D heun")
    assert told("rk4", "euler", "rk4", "heun", "rk4")[1].startswith("You call A, C and E rk4")
    assert told("euler", "heun", "rk4") == ("", "")


def test_every_two_are_told_apart_and_each_pair_once() -> None:
    """28 pairs of eight, whichever comes first."""
    pairs = [frozenset(m.parameters["swap"]) for m in EXERCISE.mistakes if "swap" in m.parameters]
    assert len(pairs) == len(set(pairs)) == 28
    assert set().union(*pairs) == set(KNOWN)


@pytest.mark.parametrize("seed", ["ada", "bob\0key"])
def test_the_files_are_what_the_steppers_make(seed: str) -> None:
    """A start and forty steps of three masses, to all digits."""
    assert EXERCISE.files is not None
    files = EXERCISE.files(seed)
    assert sorted(files) == ["A.csv", "B.csv", "C.csv", "D.csv", "E.csv", "string.json"]
    given = json.loads(files["string.json"])
    string = namespace({name: np.array(value) if isinstance(value, list) else value for name, value in given.items()})
    assert len(given["x"]) == len(given["masses"]) == 3
    for letter, name in zip("ABCDE", chosen(seed)[0], strict=True):
        rows = list(csv.reader(StringIO(files[f"{letter}.csv"])))
        assert rows[0] == ["step", "x0", "y0", "x1", "y1", "x2", "y2"]
        assert [int(row[0]) for row in rows[1:]] == list(range(41))
        state = np.array(given["x"]), np.array(given["v"])
        for row in rows[1:]:
            assert [float(cell) for cell in row[1:]] == state[0].ravel().tolist()
            state = step(*state, given["dt"], string, name)
