"""Which names a function has for its values, and what is given to it and never read."""

from __future__ import annotations

import ast

import pytest

from experiments.exercises.repair.names import names_in

TEXT = """
EXERCISE = 3
SEED, rate = 7, 2.5
import numpy as np

def own(a, s):
    for i in range(3):
        b = a[i] + s.mass * s.mass + f(x[0][1])
    return np.sum([one for one, two in b]) + other.length.size + s.method(1)

def given(q):
    return q.gravity
"""


def test_names_of_a_function() -> None:
    """What it is given, keeps and counts, and numbers outside; not what it calls, nor modules, nor whose a file is."""
    tree = ast.parse(TEXT)
    own = tree.body[3]
    names = names_in(own, tree, {"own": ["mass", "drag", "gravity"]})
    assert sorted(names.own) == sorted(["a", "s", "i", "b", "x", "one", "two", "other", "rate"])
    # what can be read of s; what is read of others; gravity is read elsewhere in the program
    assert names.fields == {"s": ["mass", "drag", "gravity"], "other": ["length"]}
    assert names.unread == ["s.drag"]
    assert sorted(names.values) == ["other.length", "s.drag", "s.gravity", "s.mass"]
    assert names.loops == ["i", "one", "two"]
    assert sorted(names.arrays) == ["a", "x"]
    assert names.has_numpy


@pytest.mark.parametrize(
    ("given", "unread"),
    [({"given": ["drag"]}, []), ({"own": ["drag"]}, ["s.drag"]), ({"none": ["drag"]}, []), ({}, [])],
)
def test_what_is_given_is_that_of_a_name_in_the_function(given: dict[str, list[str]], unread: list[str]) -> None:
    """The last argument of the function that is asked for; of another function's only where the name is known."""
    tree = ast.parse(TEXT)
    assert names_in(tree.body[3], tree, given).unread == unread


@pytest.mark.parametrize(
    ("begin", "has"),
    [("import numpy as np", True), ("import os\nimport math, numpy as np", True), ("import numpy", False), ("", False)],
)
def test_whether_numpy_is_called_np(begin: str, has: bool) -> None:
    """Only then it is used in what is tried; numpy and math have no fields that are values."""
    tree = ast.parse(f"{begin}\ndef own(a):\n    return a + numpy.pi + math.e + np.e\n")
    names = names_in(tree.body[-1], tree, {})
    assert names.has_numpy == has
    assert names.values == []
    assert names.own == ["a"]
