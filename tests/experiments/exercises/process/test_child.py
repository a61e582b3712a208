"""What a submission's process does with questions: how functions are called, and what is handed back."""

from __future__ import annotations

import os
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from experiments.exercises.process import child
from experiments.exercises.process.child import ask, ask_firsts_again, changed, fresh, story
from experiments.exercises.process.returned import Growing, OddAnswerError, array_of, parts_of


def asked(function: Callable[..., Any], *arguments: Any, parts: tuple[str, ...] = ("x", "v"), steps: int = 0) -> Any:
    """A question's answer, of a submission that has this function."""
    question = {"function": "step", "arguments": list(arguments), "parts": list(parts), "steps": steps}
    return ask(cast(ModuleType, SimpleNamespace(step=function)), question)


def plain(values: Any) -> Any:
    """Arrays as lists."""
    return [[part.tolist() for part in step] for step in values]


X, V = np.array([1.0, 2.0]), np.array([10.0, 20.0])
GIVEN = {"mass": 3.0, "at": np.array([5.0])}


def test_steps_are_fed_with_what_the_last_returned() -> None:
    """Arrays and numbers; what stands behind the state is given as it was; then the first is asked again."""
    had = []

    def step(x: Any, v: Any, dt: float, given: Any) -> Any:
        had.append((x.tolist(), v, dt, given.mass, given.at.tolist()))
        return x + dt * v, np.array([2 * v])

    answer = asked(step, X, 1.0, 0.5, GIVEN, steps=3)
    assert plain(answer["values"]) == [[[1.5, 2.5], [2.0]], [[2.5, 3.5], [4.0]], [[4.5, 5.5], [8.0]]]
    assert had == [
        (x, v, 0.5, 3.0, [5.0]) for x, v in (([1.0, 2.0], 1.0), ([1.5, 2.5], 2.0), ([2.5, 3.5], 4.0), (X.tolist(), 1.0))
    ]
    assert [type(v) for _, v, *_ in had] == [float] * 4
    assert plain([answer["again"]]) == [[[1.5, 2.5], [2.0]]]
    assert (answer.get("modified"), answer["overwritten"], "error" in answer) == (None, False, False)
    once = asked(step, X, 1.0, 0.5, GIVEN)
    assert plain(once["values"]) == [[[1.5, 2.5], [2.0]]]


def test_steps_end_where_what_is_returned_cannot_be_given_again() -> None:
    """Another shape, or whole numbers for others; a number in an array of one may be."""
    assert len(asked(lambda x, v: (x[:1], v), X, V, steps=3)["values"]) == 1
    assert len(asked(lambda x, v: (x, v.astype(int)), X, V, steps=3)["values"]) == 1
    assert len(asked(lambda x, v: ([x], v), 1.0, V, steps=3)["values"]) == 3
    assert len(asked(lambda x, v: ([[x]], v), 1.0, V, steps=3)["values"]) == 1
    assert len(asked(lambda x, v: (x.astype(float), v), np.array([1, 2]), V, steps=3)["values"]) == 3
    assert len(asked(lambda x, v: (x, v > 0), X, V, steps=3)["values"]) == 1
    # by the step that has it
    assert len(asked(lambda x, v: (x + 1, v[int(x[0] > 1) :]), X, V, steps=9)["values"]) == 2


def test_what_is_changed_beside_is_told() -> None:
    """An array that is given, in a namespace too; what was returned before, by a later call only."""

    def in_place(x: Any, v: Any) -> Any:
        x += 1
        return x.copy(), v

    def in_a_namespace(x: Any, given: Any) -> Any:
        given.at[0] += 1
        return x, x

    assert asked(in_place, X, V)["modified"]
    assert asked(in_a_namespace, X, GIVEN)["modified"]
    assert (X.tolist(), GIVEN["at"].tolist()) == ([1.0, 2.0], [5.0])  # type: ignore[attr-defined]

    kept = np.zeros(2)

    def overwrites(x: Any, v: Any) -> Any:
        kept[:] = x + v
        return kept, v

    assert asked(overwrites, X, V, steps=3)["overwritten"]
    assert not asked(overwrites, X, V, steps=1)["overwritten"]
    assert not asked(lambda x, v: (x + v, v), X, V, steps=3)["overwritten"]
    assert not asked(lambda x, v: (x + v, v), X, V, steps=3).get("modified", False)


def test_an_error_leaves_what_came_before() -> None:
    """With its words."""

    def fails_later(x: Any, v: Any) -> Any:
        if x[0] > 2:
            raise ValueError("too far")
        return x + 1, v

    answer = asked(fails_later, X, V, steps=9)
    assert plain(answer["values"]) == [[[2.0, 3.0], [10.0, 20.0]], [[3.0, 4.0], [10.0, 20.0]]]
    assert answer["error"] == {"type": "ValueError", "words": "too far", "line": None}
    assert asked(lambda x, v: 7.0, X, V)["error"]["type"] == "OddAnswerError"
    missing = ask(cast(ModuleType, SimpleNamespace()), {"function": "f", "arguments": [], "parts": ["x"], "steps": 0})
    assert missing["error"]["type"] == "AttributeError"


@pytest.mark.parametrize(
    ("before", "value", "is_changed"),
    [
        (np.array([1.0, np.nan]), np.array([1.0, np.nan]), False),
        (np.array([1.0, 2.0]), np.array([1.0, 2.5]), True),
        (np.array([1.0, 2.0]), np.array([1.0]), True),
        (np.array([1, 2]), np.array([1, 2]), False),
        (np.array(["a"]), np.array(["a"]), False),
        (np.array(["a"]), np.array(["b"]), True),
        ({"m": 1.0, "a": np.ones(2)}, SimpleNamespace(m=2.0, a=np.ones(2)), False),
        ({"m": 1.0, "a": np.ones(2)}, SimpleNamespace(m=1.0, a=np.zeros(2)), True),
        ({"m": 1.0, "a": np.ones(2)}, SimpleNamespace(m=1.0), True),
        ({"growing": 1.0}, 3.0, False),
        (1.0, 2.0, False),
    ],
)
def test_arguments_that_are_changed_are_arrays(before: Any, value: Any, is_changed: bool) -> None:
    """Numbers cannot be; what is no number is the same as what is none."""
    assert changed(value, before) == is_changed


def test_arguments_are_made_anew() -> None:
    """Arrays of their own, namespaces for dicts, a coefficient that grows."""
    given = fresh({"a": X, "b": {"c": 1.0}, "growing_": 2.0})
    given.a[0] = 7.0
    assert (X[0], given.b.c, given.growing_) == (1.0, 1.0, 2.0)
    growing = fresh({"growing": 0.5})
    assert isinstance(growing, Growing)
    assert float(growing) == 0.5


def test_drag_that_grows_with_the_speed() -> None:
    """By c v (1 + v^2), from either side, also of arrays, with a sign or divided; added to, it is a number."""
    c = Growing(0.5)
    assert (c * 2.0, 2.0 * c, -c * 2.0, 2.0 * (c / 4)) == (5.0, 5.0, -5.0, 1.25)
    assert (c * np.array([1.0, -2.0])).tolist() == [1.0, -5.0]
    assert (np.array([1.0, -2.0]) * c).tolist() == [1.0, -5.0]
    assert c + 1.0 == 1.5
    assert isinstance(-c, Growing)
    assert isinstance(c / 2, Growing)


@pytest.mark.parametrize(
    ("value", "name"),
    [
        (None, "returns_nothing"),
        ((1.0, None), "returns_nothing"),
        ((1.0, [1.0, None]), "returns_nothing"),
        ((1.0, [[1.0], None]), "returns_nothing"),
        ({"x": 1.0, "v": 2.0}, "returns_a_dict"),
        ((1.0, {"v": 2.0}), "returns_a_dict"),
        ({1.0, 2.0}, "returns_a_set"),
        (1.0, "wrong_count"),
        ("xv", "wrong_count"),
        ((1.0, 2.0, 3.0), "wrong_count"),
        ((1.0, len), "not_numbers"),
        ((1.0, [1.0, len]), "not_numbers"),
        ((1.0, 1j), "not_numbers"),
        ((1.0, np.array(["2020-01-01"], "datetime64[D]")), "not_numbers"),
        ((1.0, [[1.0], [1.0, 2.0]]), "ragged"),
        ((1.0, [SimpleNamespace()]), "not_numbers"),
    ],
)
def test_what_is_no_answer_is_told_by_its_name(value: Any, name: str) -> None:
    """In place of two parts; with the part, where it is one of them."""
    with pytest.raises(OddAnswerError, match=f"^{name}: ") as raised:
        parts_of(value, ["x", "v"])
    if isinstance(value, tuple) and len(value) == 2:
        assert " v " in f" {str(raised.value).partition(': ')[2]}"


@pytest.mark.parametrize(
    ("value", "numbers"),
    [
        ([1, 2], [1, 2]),
        (range(3), [0, 1, 2]),
        ((i for i in (1.0, 2.0)), [1.0, 2.0]),
        ({"a": 1}.keys(), ["a"]),
        ([Fraction(1, 2), Decimal("0.25")], [0.5, 0.25]),
        (np.array([1 + 0j, 2]), [1.0, 2.0]),
        (True, True),
        (np.float32(0.5), 0.5),
        ([True, False], [True, False]),
        ("word", "word"),
    ],
)
def test_what_can_be_an_array_is_one(value: Any, numbers: Any) -> None:
    """Whatever holds numbers; of its own, so that later changes do not show."""
    assert array_of(value, "x").tolist() == numbers
    kept = np.array([1.0, 2.0])
    made = array_of(kept, "x")
    kept[:] = 0
    assert made.tolist() == [1.0, 2.0]


def test_functions_and_complex_numbers_are_no_answer() -> None:
    """Also one complex number among others; what can be called may be an array."""
    with pytest.raises(OddAnswerError, match="x is a function: it was not called"):
        array_of(len, "x")
    with pytest.raises(OddAnswerError, match="x has complex numbers in it"):
        array_of([1.0, 2j], "x")

    class Own:
        def __call__(self) -> None: ...

        def __array__(self, dtype: object = None, copy: object = None) -> Any:
            return np.array([1.0, 2.0])

    assert array_of(Own(), "x").tolist() == [1.0, 2.0]


def test_the_count_is_told_in_words() -> None:
    """One thing, two things; of one part it is not counted."""
    for value, words in ((1.0, "1 thing: expected"), ((1, 2, 3), "3 things: expected x, v"), ([], "0 things")):
        with pytest.raises(OddAnswerError, match=words):
            parts_of(value, ["x", "v"])
    assert [part.tolist() for part in parts_of((1.0, 2.0), ["x"])] == [[1.0, 2.0]]
    assert [part.tolist() for part in parts_of(iter([1.0, 2.0]), ["x", "v"])] == [1.0, 2.0]


def test_a_story_has_the_submissions_own_line() -> None:
    """The nearest to the error; that of a text that cannot be read; none where no line of it is on the way."""
    text = "def f(x):\n    return g(x)\ndef g(x):\n    return int('a')\n"
    names: dict[str, Any] = {}
    exec(compile(text, child.NAME, "exec"), names)
    with pytest.raises(ValueError, match="invalid literal") as raised:
        names["f"](1)
    told = story(raised.value)
    assert (told["type"], told["line"]) == ("ValueError", 4)
    with pytest.raises(SyntaxError) as syntax:
        compile("a = 1\nb = (", child.NAME, "exec")
    assert story(syntax.value) == {"type": "SyntaxError", "words": "'(' was never closed", "line": 2}
    elsewhere = SyntaxError("bad", ("other.py", 7, 1, "text"))
    assert story(elsewhere)["line"] is None
    assert len(story(ValueError("x" * 1000))["words"]) == 300
    of_c = ValueError("c")
    of_c.line = 9  # type: ignore[attr-defined]
    assert story(of_c)["line"] == 9


def test_before_a_first_question_is_put_again_time_passes() -> None:
    """Ten steps of a second each, of the first question of each function that makes steps; errors end that."""
    had: list[tuple[str, float]] = []

    def step(x: Any, v: Any, dt: float) -> Any:
        had.append(("step", dt))
        if dt == child.LATER_DT and len(had) > 20:
            raise ValueError
        return x + dt * v, v

    def energy(x: Any) -> Any:
        had.append(("energy", 0.0))
        return x

    module = cast(ModuleType, SimpleNamespace(step=step, energy=energy))
    questions = [
        {"function": "step", "arguments": [X, V, 0.5], "parts": ["x", "v"], "steps": 2},
        {"function": "energy", "arguments": [X], "parts": ["x"], "steps": 0},
        {"function": "step", "arguments": [X, V, 0.25], "parts": ["x", "v"], "steps": 2},
    ]
    answers = [ask(module, question) for question in questions]
    del had[:]
    ask_firsts_again(module, questions, answers)
    assert had == [("energy", 0.0)] * 2 + [("step", 1.0)] * 10 + [("step", 0.5)] * 2 or had == (
        [("step", 1.0)] * 10 + [("step", 0.5)] * 2 + [("energy", 0.0)] * 2
    )
    answers[0]["error"] = {"type": "E"}
    del had[:]
    ask_firsts_again(module, questions, answers)
    assert had == [("energy", 0.0)] * 2


def test_an_error_that_comes_later_is_told() -> None:
    """When the first question is put again."""
    calls: list[int] = []

    def tired(x: Any) -> Any:
        calls.append(1)
        if len(calls) > 2:
            raise ValueError("tired")
        return x

    module = cast(ModuleType, SimpleNamespace(tired=tired))
    question = {"function": "tired", "arguments": [X], "parts": ["x"], "steps": 0}
    answers = [ask(module, question)]
    ask_firsts_again(module, [question], answers)
    assert answers[0]["error"]["words"] == "tired"


@pytest.mark.parametrize("late", ["error", "again"])
def test_what_comes_later_is_told_of_its_own_function(late: str) -> None:
    """Of the second of two: what it raises, or what it answers then."""
    calls: list[int] = []

    def tired(x: Any) -> Any:
        calls.append(1)
        if late == "error" and len(calls) > 2:
            raise ValueError
        return x * (1 + (len(calls) > 2))

    module = cast(ModuleType, SimpleNamespace(plain=lambda x: 2 * x, tired=tired))
    questions = [{"function": name, "arguments": [X], "parts": ["x"], "steps": 0} for name in ("plain", "tired")]
    answers = [ask(module, question) for question in questions]
    ask_firsts_again(module, questions, answers)
    assert ["error" in answer for answer in answers] == [False, late == "error"]
    assert plain([answers[0]["again"]]) == [[[2.0, 4.0]]]
    assert plain([answers[1]["again"]]) == [[[1.0, 2.0] if late == "error" else [2.0, 4.0]]]


def test_a_whole_task_is_answered(tmp_path: Path) -> None:
    """Names that do not begin with an underscore, answers, what a search finds; or the error of reading it."""
    question = {"function": "f", "arguments": [X], "parts": ["x"], "steps": 0}
    source = "import os\n_hidden = 1\nwhere = os.path.dirname(__file__)\ndef f(x):\n    return 2 * x\n"
    task = {"source": source, "folder": str(tmp_path), "questions": [question], "search": {"groups": [1]}}
    found = child.answered(task)
    assert sorted(found["names"]) == ["f", "os", "where"]
    assert plain(found["answers"][0]["values"]) == [[[2.0, 4.0]]]
    assert "search" not in found
    had: list[Any] = []
    child.answered(task, lambda task, fresh_, changed_: had.append((task["groups"], fresh_, changed_)) or [])
    assert had == [([1], fresh, changed)]
    assert child.answered({**task, "source": "a = ("})["error"]["type"] == "SyntaxError"
    assert os.fspath(tmp_path) in child.answered({**task, "source": "raise ValueError(__file__)"})["error"]["words"]


def test_a_file_is_read_from_its_beginning(tmp_path: Path) -> None:
    """Wherever its handle stands, and however long it is."""
    data = os.urandom(2**20 + 7)
    (tmp_path / "file").write_bytes(data)
    handle = os.open(tmp_path / "file", os.O_RDONLY)
    os.lseek(handle, 100, os.SEEK_SET)
    assert child.read_all(handle) == data
    os.close(handle)
