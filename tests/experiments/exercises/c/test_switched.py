"""A compiled program with changes: which can matter, and that it has to answer as the program itself does."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from experiments.exercises.c import switched
from experiments.exercises.c.switched import Switched, SwitchedProgram, _same

#: A step of two numbers, of which the first is called; its answers are x and v.
QUESTION = {"function": "step", "arguments": [1.0, 2.0], "parts": ["x", "v"]}

Step = Callable[[float, float], Any]


class Anew:
    """In place of a program with changes: this step, each time anew; it notes where calls begin."""

    def __init__(self, step: Step) -> None:
        self._step, self.begun = step, 0

    def anew(self) -> dict[str, Step]:
        """Its function."""
        return {"step": self._step}

    def begin_call(self) -> None:
        """A function is about to be called."""
        self.begun += 1


def right(x: float, v: float) -> tuple[float, float]:
    """What the program itself answers."""
    return x + 100 * v, np.nan


def fails(x: float, v: float) -> tuple[float, float]:
    """No answer."""
    raise ValueError(x)


def other(by: float) -> Step:
    """The same, off by a part."""
    return lambda x, v: (right(x, v)[0] * (1 + by), np.nan)


@pytest.mark.parametrize(
    ("plain", "changed", "same"),
    [
        (right, right, True),
        (right, other(3e-10), True),
        (right, other(3e-9), False),
        (right, lambda x, v: (right(x, v)[0], 1.0), False),
        (right, lambda x, v: (0.0, np.nan), False),
        (lambda x, v: (0.0, 0.0), lambda x, v: (1e-12, 0.0), False),
        (right, fails, False),
        (fails, right, False),
        (fails, fails, True),
        (right, lambda x, v: (1.0, 2.0, 3.0), False),
    ],
)
def test_with_its_changes_it_answers_as_by_itself(plain: Step, changed: Step, same: bool) -> None:
    """To rounding, each number; or by an error, too. Each call is begun."""
    program: Any = Anew(changed)
    assert _same({"step": plain}, program, QUESTION, float) == same
    assert program.begun == 2


def test_a_change_can_matter_where_one_of_its_places_is_come_to() -> None:
    """Not all of them have to be."""
    program = SwitchedProgram.__new__(SwitchedProgram)
    change = Switched(1.0, [(3, 1), (5, 2)])
    assert [program.can_matter(change, reached) for reached in ({3, 5}, {3}, {5}, {1, 2}, set())] == [
        *[True] * 3,
        *[False] * 2,
    ]


def test_two_changes_at_one_place_are_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither as it is nor anew; else what they make is there for a while, and nothing is switched on afterwards."""
    program = SwitchedProgram.__new__(SwitchedProgram)
    program._names, program._at = {"step": right}, (ctypes.c_int * 4)(9, 9, 9, 9)  # type: ignore[assignment]
    monkeypatch.setattr(program, "anew", lambda: {"anew": fails}, raising=False)
    one, other, same = Switched(1.0, [(0, 3)]), Switched(1.0, [(2, 4), (3, 5)]), Switched(1.0, [(3, 6)])
    with program.changed([one, other]) as names:
        assert names == {"step": right}
        assert list(program._at) == [3, 0, 4, 5]
    assert list(program._at) == [0] * 4
    with program.changed_anew([one, other]) as names:
        assert names == {"anew": fails}
    for changed in (program.changed, program.changed_anew):
        with changed([other, same]) as names:
            assert names is None


def test_places_that_are_come_to_are_those_meanwhile() -> None:
    """Not those of before."""
    program = SwitchedProgram.__new__(SwitchedProgram)
    program._places, program._reached = 4, (ctypes.c_char * 4)(b"\1", b"\1", b"\0", b"\0")
    with program.reached() as found:
        program._reached[1] = program._reached[3] = b"\1"
    assert found == {1, 3}


def test_with_each_call_loops_are_counted_anew_and_memory_is_given_back() -> None:
    """From nothing."""
    program = SwitchedProgram.__new__(SwitchedProgram)
    program._rounds, program._taken = ctypes.c_int(7), ctypes.c_size_t(8)
    program.begin_call()
    assert (program._rounds.value, program._taken.value) == (0, 0)


@pytest.mark.parametrize(("second", "searched"), [(right, True), (fails, False)])
def test_nothing_is_searched_where_one_question_is_answered_otherwise(
    monkeypatch: pytest.MonkeyPatch, second: Step, searched: bool
) -> None:
    """Of all questions of all groups; what is searched then is all changes, each with its cost and its switches."""

    def step(x: float, v: float) -> Any:
        return right(x, v) if x == 1.0 else second(x, v)

    had: dict[str, Any] = {}

    def search_groups(task: Any, begun: Callable[[Any], Any], fresh: Any, changed: Any) -> list[str]:
        had["edits"], had["program"] = begun([])
        had["ways"] = fresh, changed
        return ["found"]

    def functions(library: str, exercise: int, lines: list[Any]) -> dict[str, Step]:
        assert (library, exercise, lines) == ("plain.so", 4, [])
        return {"step": right}

    made: Any = Anew(step)
    monkeypatch.setattr(switched, "search_groups", search_groups)
    monkeypatch.setattr(switched.ctypes, "CDLL", lambda path: path)
    monkeypatch.setattr(switched, "functions_of", functions)
    monkeypatch.setattr(switched, "SwitchedProgram", lambda *given: had.update(given=given) or made)
    task = {
        "library": "plain.so",
        "variants": "variants.so",
        "exercise": 4,
        "places": 7,
        "changes": [(1.5, [[2, 1], [3, 4]]), (2.5, [[5, 6]])],
        "groups": [[QUESTION], [{**QUESTION, "arguments": [7.0, 2.0]}]],
    }
    ways = float, (lambda a, b: False)
    assert switched.search(task, *ways) == (["found"] if searched else [])
    assert had["given"] == ("variants.so", 4, 7)
    if searched:
        assert had["edits"] == [Switched(1.5, [(2, 1), (3, 4)]), Switched(2.5, [(5, 6)])]
        assert had["program"] is made
        assert had["ways"] == ways
