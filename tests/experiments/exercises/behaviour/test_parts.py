"""Which parts of an answer are right, and the lines from which a value comes: by programs of a few lines."""

from __future__ import annotations

import ast
from typing import Any

import numpy as np
import pytest

from experiments.exercises.behaviour.parts import lines_behind, lines_of_part, of_an_error, seen
from experiments.exercises.exercise import Exercise, Question
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue

X = np.array([1.0, -4.0])


def catalogue(tolerance: float = 1e-9) -> AnswerCatalogue:
    """A step with two parts, asked twice, and an energy with one."""
    solutions = {"step": lambda x, *_: (x, 2 * x), "energy": lambda x: 7.0}
    asked = [
        Question("step", (X,), ("x", "v"), "", steps=2),
        Question("step", (3 * X,), ("x", "v"), "", steps=2),
        Question("energy", (X,), ("energy",), ""),
    ]
    return AnswerCatalogue(Exercise("", 0, "", solutions, lambda *_: asked, (), tolerance=tolerance), asked)


def told(first: Any, second: Any, energy: Any, source: str = "", tolerance: float = 1e-9, c: bool = False) -> str:
    """What is said of answers, each what came after one step."""
    answers = [{"values": [] if a is None else [[np.asarray(p) for p in a]]} for a in (first, second, energy)]
    found = seen(catalogue(tolerance), answers, source, "c" if c else "python")
    return found[0].words if found else ""


RIGHT = (X, 2 * X), (3 * X, 6 * X), (7.0,)


def test_which_parts_are_right() -> None:
    """Those that are in all questions; where all are alike nothing is told. One part is told as its function."""
    words = "Right in your first answers "
    assert told(*RIGHT) == ""
    assert told((-X, X), (3 * X, X), (8.0,)) == ""
    assert told((X, X), RIGHT[1], RIGHT[2]) == f"{words}are x of step() and energy(); v of step() is not."
    assert told(RIGHT[0], (3 * X, X), RIGHT[2]) == f"{words}are x of step() and energy(); v of step() is not."
    assert told(RIGHT[0], RIGHT[1], (8.0,)) == f"{words}are x of step() and v of step(); energy() is not."
    assert told((-X, X), RIGHT[1], RIGHT[2]) == f"{words}is energy(); x of step() and v of step() are not."


@pytest.mark.parametrize(
    "answer",
    [
        None,
        (X,),
        (X, [np.inf, 1.0]),
        (X, np.array(["a", "b"])),
        (X, np.ones(3)),
        (X, np.array([1j, 2j])),
        (X, 2 * X[:1]),
    ],
)
def test_what_has_another_form_is_wrong(answer: Any) -> None:
    """No answer, one part, infinite, words, another size: nothing of it is right where it cannot be read."""
    said = told(answer, RIGHT[1], RIGHT[2])
    assert "v of step()" in said.partition(";")[2]
    readable = answer is not None and len(answer) == 2 and np.asarray(answer[1]).dtype.kind == "f"
    assert ("x of step()" in said.partition(";")[0]) == readable


@pytest.mark.parametrize(("off", "right"), [(0.5, True), (2.0, False)])
@pytest.mark.parametrize("tolerance", [1e-12, 1e-9, 1e-3])
def test_right_is_to_a_billionth_of_the_largest_or_the_exercises_own_tolerance(
    off: float, right: bool, tolerance: float
) -> None:
    """The largest number of the part is 8; beside it rounding of the other counts as little."""
    by = off * 8 * max(tolerance, 1e-9)
    said = told((X, 2 * X + np.array([by, 0.0])), RIGHT[1], (0.0,), tolerance=tolerance)
    assert ("v of step()" in said.partition(";")[0]) == right


def test_nothing_but_zeros_is_right_where_it_should_be() -> None:
    """There is no largest number beside which an error could be small."""
    asked = [Question("step", (X,), ("x", "v"), "")]
    exercise = Exercise("", 0, "", {"step": lambda x: (0 * x, x)}, lambda *_: asked, ())
    for x, v, right in ((0 * X, -X, "x"), (0 * X + 1e-300, X, "v")):
        (found,) = seen(AnswerCatalogue(exercise, asked), [{"values": [[x, v]]}], "")
        assert found.words.startswith(f"Right in your first answers is {right};")


def test_the_lines_are_told_where_they_are_few() -> None:
    """Three at most; of one value, and of two; of a text that cannot be read none."""
    step = "def step(x):\n    v = 2 * x\n    {}\n    return x, v\n\n\ndef energy(x):\n    return 8.0\n"
    wrong_v = (X, X), RIGHT[1], RIGHT[2]
    assert told(*wrong_v, step.format("v += 1")).endswith("; v of step() is not, and gets its value in lines 2 and 3.")
    assert told(*wrong_v, step.format("pass")).endswith("; v of step() is not, and gets its value in line 2.")
    many = step.format("v += 1\n    v += 2\n    v += 3")
    assert told(*wrong_v, many).endswith("; v of step() is not.")
    assert told(*wrong_v, step.format("v +=")).endswith("; v of step() is not.")
    both = told((X, X), RIGHT[1], (8.0,), step.format("pass"))
    assert both.endswith("v of step() and energy() are not, and get their values in lines 2 and 8.")
    in_c = "void step(double *x, double *v)\n{\n    *x += 1;\n    *v += 1;\n}\n"
    assert told(*wrong_v, in_c, c=True).endswith("; v of step() is not, and gets its value in line 4.")
    four = in_c.replace("    *v += 1;\n", "    *v += 1;\n" * 4)
    assert told(*wrong_v, four, c=True).endswith("; v of step() is not.")


@pytest.mark.parametrize(
    ("body", "place", "count", "lines"),
    [
        ("return x, 2 * x", 1, 2, [2]),
        ("return x, 2 * x", 0, 2, [2]),
        ("v = 1\n    return x, v", 1, 2, [2]),
        ("v: int = 1\n    return [x, v]", 1, 2, [2]),
        ("v = 1\n    v[0] += 2\n    return x, v", 1, 2, [2, 3]),
        ("v.part = 1\n    return x, v", 1, 2, [2]),
        ("a, v = 1, 2\n    return x, v", 1, 2, [2]),
        ("a, *v = 1, 2\n    return x, v", 1, 2, [2]),
        ("a = v = 1\n    return x, v", 1, 2, [2]),
        ("for v in x:\n        pass\n    return x, v", 1, 2, [4]),
        ("if x:\n        return x, 1\n    return x, 2", 1, 2, [3, 4]),
        ("v = 1\n    return v", 0, 1, [2]),
        ("v = 1\n    return (v,)", 0, 1, [2]),
        ("v = 1\n    return v, v", 0, 1, [3]),
        ("v = x, 1\n    return v", 1, 2, []),
        ("return x, 1, 2", 1, 2, []),
        ("return", 0, 1, []),
        ("return other(x)", 1, 2, [4]),
        ("return self.other(x)", 1, 2, [4]),
        ("return unknown(x)", 0, 1, [2]),
        ("return step(x)", 0, 1, [2]),
    ],
)
def test_where_what_is_returned_gets_its_value(body: str, place: int, count: int, lines: list[int]) -> None:
    """Assigned, also in part, also with others; where it is returned if not; where another function has it from."""
    text = f"def step(x):\n    {body}\n"
    if "other" in body:
        text += "def other(x):\n    v = 1\n    return x, v\n"
    assert sorted(set(lines_of_part(ast.parse(text), "step", place, count))) == lines
    assert list(lines_of_part(ast.parse(text), "energy", place, count)) == []


def test_functions_that_return_each_others_results_come_to_an_end() -> None:
    """Each is looked at once; of two of one name nobody knows which is meant."""
    text = "def a(x):\n    return b(x)\ndef b(x):\n    return a(x) if x else 1\n"
    assert list(lines_of_part(ast.parse(text), "a", 0, 1)) == [4]
    round_ = "def a(x):\n    return b(x)\ndef b(x):\n    return a(x)\n"
    assert list(lines_of_part(ast.parse(round_), "a", 0, 1)) == [2]
    twice = "def a(x):\n    return b(x)\nclass B:\n    def b(x):\n        return 1\ndef b(x):\n    return 2\n"
    assert list(lines_of_part(ast.parse(twice), "a", 0, 1)) == [2]


def test_the_values_of_a_line_that_raised_an_error() -> None:
    """Assigned before it, in its own function; of four lines all are told, of five none."""
    text = "def f(a, b):\n    c = a\n    c[0] += 1\n    d = 2\n    return c[9] + d\n    c = 3\n\ndef g(c):\n    c = 1\n"
    assert sorted(set(lines_behind(ast.parse(text), 5))) == [2, 3, 4]
    assert list(lines_behind(ast.parse(text), 1)) == []
    assert list(lines_behind(ast.parse(text), 9)) == []
    (found,) = of_an_error(text, 5)
    assert found.words == "What stands on line 5 gets its values in lines 2, 3 and 4."
    assert found.lines == (2, 3, 4)
    assert of_an_error(text, None) == []
    assert of_an_error(text, 4) == []
    assert of_an_error("def f(:", 1) == []
    for more, is_told in ((2, True), (3, False)):
        long = "def f(a):\n    c = a\n    d = 1\n" + "    c += 1\n" * more + "    return c + d\n"
        assert bool(of_an_error(long, 4 + more)) == is_told
    one = of_an_error("def f(a):\n    c = a\n    return c[\n        9]\n", 4)
    assert [found.words for found in one] == []
    spread = of_an_error("def f(a):\n    c = a\n    return (c +\n        c)\n", 3)
    assert [found.words for found in spread] == ["What stands on line 3 gets its values in line 2."]
