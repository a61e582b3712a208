"""A changed program that only its changed function is compiled of answers as one that is made anew."""

from __future__ import annotations

import ast
from contextlib import nullcontext
from typing import Any

import numpy as np
import pytest

from experiments.exercises.repair import program
from experiments.exercises.repair.edit import Edit
from experiments.exercises.repair.program import Program, TooLongError, _units
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

class Alone:
    def get(self, a):
        return a + 13

def at_once():
    return 7
SEVEN = at_once()
again = twice

def unused():
    return 11

def all_of_it(a):
    return [call(a), Box(a).get(), Other(a).get(), Alone().get(a), SEVEN, again(a)]
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


@pytest.mark.parametrize(
    ("text", "units"),
    [
        ("def one():\n    return 1\ndef two():\n    return one()", {"one", "two"}),
        # something else may hold what it was, or what it returned
        ("def one():\n    return 1\nother = one", set()),
        ("def one():\n    return 1\ndef one():\n    return 2", set()),
        ("def one():\n    return 1\nclass Box:\n    of = one", set()),
        ("def one():\n    return 1\ndef two(a=one):\n    return a", {"two"}),
        ("@cache\ndef one():\n    return 1\ndef two():\n    return 2", set()),
        ("@functools.lru_cache\ndef one():\n    return 1\ndef two():\n    return 2", set()),
        ("def one():\n    global a\n    a = 1\ndef two():\n    return 2", set()),
        # methods, with their class
        (
            "class Box:\n    a = 1\n    def get(self):\n        return 1\n    def put(self):\n        return 2",
            {"get", "put"},
        ),
        ("class Box:\n    def get(self):\n        return 1\n    def get(self):\n        return 2", set()),
        ("class Box:\n    def get(self):\n        return super().get()", set()),
        ("class Box:\n    def get(self):\n        return self.__own", set()),
        ("class Box:\n    def get(self):\n        return self.__dict__", {"get"}),
        ("class Box:\n    def get(self):\n        return self.own__", {"get"}),
        (
            "class Box:\n    def get(self):\n        return 1\nclass More(Box):\n    def put(self):\n        return 2",
            {"put"},
        ),
        ("class Box:\n    def get(self):\n        return 1\ndef one():\n    return Box().get()", {"get", "one"}),
    ],
)
def test_what_can_be_put_in_place_of_what_it_was(text: str, units: set[str]) -> None:
    """Functions and methods of which nothing else holds what they were; with each of their nodes, and their class."""
    tree = ast.parse(text)
    found = dict(_units(tree, set()))
    assert {function.name for function, _ in found.values()} == units
    for function, owner in {id(unit): unit for unit in found.values()}.values():
        assert {id(node) for node in ast.walk(function)} == {i for i, unit in found.items() if unit[0] is function}
        assert (owner is None) == (function in tree.body)
        assert owner is None or function in owner.body


def test_what_was_called_while_the_module_was_made_is_not_put_in_place() -> None:
    """It is known by its first line: that of the decorator, where there is one."""
    text = "def f(a):\n    return a\n@f\ndef one():\n    return 1\ndef two():\n    return 2\n"
    tree = ast.parse(text)
    for entered, units in ((set(), {"one", "two"}), ({3}, {"two"}), ({4}, {"one", "two"}), ({6}, {"one"})):
        assert {function.name for function, _ in dict(_units(tree, entered)).values()} == units


def test_every_name_of_a_change_has_to_fit() -> None:
    """Where one of two places gets what is of another kind nothing becomes right; a sum may be with some kind of it."""
    program = Program(ast.parse("def own(a, b, c):\n    return a, a\n"))
    names = program.anew()
    assert names is not None
    with program.reached() as reached:
        names["own"](1.0, 2.0, "three")
        names["own"](1.0, "two", 3)
    assert reached == {1}
    (function, *_) = program.tree.body
    assert isinstance(function, ast.FunctionDef)
    (returned,) = function.body
    assert isinstance(returned, ast.Return)
    pair = returned.value
    assert isinstance(pair, ast.Tuple)

    def matters(*new: str) -> bool:
        put = tuple(((pair, "elts", i), ast.parse(text, mode="eval").body) for i, text in enumerate(new))
        return program.can_matter(Edit(2, "name", 1.0, put), {1})

    for name, kinds in {"a": {"number"}, "b": {"number", "str"}, "c": {"number", "str"}}.items():
        assert program._kinds[name] == kinds
    program._kinds["d"] = {"str"}
    assert matters("b", "c")
    assert not matters("b", "d")
    assert not matters("d", "b")
    added = ast.BinOp(pair.elts[0], ast.Add(), ast.Name("b", ast.Load()))
    for name, fits in (("b", True), ("d", False), ("unknown", True)):
        added.right = ast.Name(name, ast.Load())
        assert program.can_matter(Edit(2, "name", 1.0, (((pair, "elts", 0), added),)), {1}) == fits
    assert not program.can_matter(Edit(2, "name", 1.0, (((pair, "elts", 0), ast.Name("b", ast.Load())),)), {2})


def test_loops_may_go_round_so_often_in_each_call(monkeypatch: pytest.MonkeyPatch) -> None:
    """And while the module is made; no more."""
    monkeypatch.setattr(program, "MOST_ROUNDS", 5)
    counting = Program(ast.parse("def own(a):\n    while a > 0:\n        a -= 1\n    return a"))
    names = counting.anew()
    assert names is not None
    assert names["own"](5) == 0  # nothing has gone round before the first call
    for count, stops in ((5, False), (5, False), (6, True)):
        counting.begin_call()
        with pytest.raises(TooLongError) if stops else nullcontext():
            assert names["own"](count) == 0
    for count, is_made in ((5, True), (6, False)):
        made = Program(ast.parse(f"a = {count}\nwhile a > 0:\n    a -= 1\n")).anew()
        assert (made is not None) == is_made


def test_what_cannot_be_read_has_no_names() -> None:
    """The whole text, or a function or method that was changed; what is left out of it comes back."""
    unreadable = Program(ast.parse("def one():\n    return 1\n1 / 0"))
    assert unreadable.anew() is None
    with unreadable.changed(edits_on(unreadable, 2)[:1]) as names:
        assert names is None
    program = Program(ast.parse("def one():\n    return 1\nclass Box:\n    def get(self):\n        return 2\n"))
    function, box = program.tree.body
    assert isinstance(box, ast.ClassDef)
    (method,) = box.body
    for holder in (function, method):
        (returned,) = holder.body  # type: ignore[attr-defined]
        breaks = Edit(2, "too much", 1.0, (((holder, "body", 0), ast.copy_location(ast.Break(), returned)),))
        other = Edit(2, "factor", 1.0, (((returned, "value", None), ast.copy_location(ast.Constant(7), returned)),))
        with program.changed([breaks]) as names:
            assert names is None
        with program.changed([other]) as names:
            assert names is program._names  # only what was changed is compiled
            assert names is not None
            assert sorted([names["one"](), names["Box"]().get()]) == ([2, 7] if holder is function else [1, 7])
        with program.changed([]) as names:
            assert names is not None
            assert (names["one"](), names["Box"]().get()) == (1, 2)


def test_a_change_of_two_functions_matters_where_one_is_called() -> None:
    """As of two methods that are alike."""
    program = Program(ast.parse("def one():\n    return 1\ndef two():\n    return 2\n"))
    put = [((function.body[0], "value", None), ast.Constant(7)) for function in program.tree.body]  # type: ignore[attr-defined]
    both = Edit(2, "factor", 1.0, tuple(put))
    assert [program.can_matter(both, lines) for lines in ({1}, {3}, {1, 3}, {2})] == [True, True, True, False]
