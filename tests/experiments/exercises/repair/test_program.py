"""A changed program that only its changed function is compiled of answers as one that is made anew."""

from __future__ import annotations

import ast
from typing import Any

import numpy as np
import pytest

from experiments.exercises.repair.edit import Edit
from experiments.exercises.repair.program import Program, TooLongError
from experiments.exercises.repair.source_edits import edits_of

#: A function that others call, a method, one that is called at once, one that has another name, and a class of a class.
TEXT = """
def twice(a):
    return 2 * a

def call(a):
    return twice(a) + 1

class Box:
    def __init__(self, a):
        self.a = a
    def get(self):
        return self.a + 3

class Other(Box):
    def get(self):
        return super().get() * 5

def at_once():
    return 7
SEVEN = at_once()
again = twice

def unused():
    return 11

def all_of_it(a):
    return [call(a), Box(a).get(), Other(a).get(), SEVEN, again(a)]
"""


def answer(names: Any) -> object:
    """What the program returns, or what it raises."""
    try:
        return [getattr(value, "__name__", value) for value in names["all_of_it"](1)]
    except Exception as error:
        return type(error).__name__


def test_every_change_is_seen_as_in_a_fresh_module() -> None:
    """Each change of each function and method; after it the program is what it was."""
    tree = ast.parse(TEXT)
    edits = edits_of(tree)
    program = Program(tree)
    before, others = answer(program.anew()), 0
    for edit in edits:
        with edit.applied():
            fresh = program.anew()
            expected = None if fresh is None else answer(fresh)
        with program.changed([edit]) as names:
            assert (None if names is None else answer(names)) == expected, (edit.line, edit.family)
        others += expected != before
        with program.changed([]) as names:
            assert answer(names) == before
    assert others > 100


def edits_on(program: Program, line: int) -> list[Edit]:
    """The changes on a line."""
    return [edit for edit in edits_of(program.tree) if edit.line == line]


def test_what_is_not_called_cannot_matter() -> None:
    """A function that nothing calls; one that is called, or was while the module was made, can."""
    program = Program(ast.parse(TEXT))
    names = program.anew()
    assert names is not None
    with program.reached() as reached:
        names["all_of_it"](1)
    lines = {text: TEXT[: TEXT.index(text)].count("\n") + 1 for text in ("return 11", "return 2", "return 7")}
    matters = {text: [program.can_matter(e, reached) for e in edits_on(program, n)] for text, n in lines.items()}
    assert not any(matters["return 11"])
    assert any(matters["return 2"])
    assert any(matters["return 7"])


def test_a_name_is_put_in_the_place_of_one_of_its_kind() -> None:
    """A list for a number makes nothing right; a number may, and an array is reckoned with."""
    for other, swapped, added in (([2], False, False), (2, True, True), (np.ones(2), False, True)):
        program = Program(ast.parse("def own(a, b):\n    return a"))
        names = program.anew()
        assert names is not None
        with program.reached() as reached:
            names["own"](1, other)
        found = {}
        for edit in edits_of(program.tree):
            with edit.applied():
                text = ast.unparse(ast.fix_missing_locations(program.tree)).splitlines()[-1].strip()
            found[text] = program.can_matter(edit, reached)
        assert (found["return b"], found["return a + b"]) == (swapped, added)


def test_a_loop_without_end_is_stopped() -> None:
    """Whether it stands in what was changed or not; and the tree has no counters in it."""
    tree = ast.parse("def own(a):\n    while a:\n        pass\n    return a")
    text, program = ast.unparse(tree), Program(tree)
    for edits in ([], edits_of(tree)[:1]):
        with program.changed(edits) as names:
            assert names is not None
            program.begin_call()
            with pytest.raises(TooLongError):
                names["own"](1)
    assert ast.unparse(tree) == text
