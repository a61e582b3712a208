"""Terms of a force that are right and wrong, by answers that are made up."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from experiments.exercises.behaviour.terms import TermCase, _error, cases, lines_with, seen
from experiments.exercises.exercise import Exercise, Question, find
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue, catalogue_of

CATALOGUE = catalogue_of(find("3"), "example", None)
CASES = cases(CATALOGUE)

#: What may come in place of the forces on n masses, and is no answer of their form.
OF_ANOTHER_FORM: Mapping[str, list[Any]] = {
    "nothing": [],
    "no parts": [[]],
    "two parts": [[np.zeros(2), np.zeros(2)]],
    "more numbers": [[np.zeros(1000)]],
    "text": [[np.array("no force")]],
    "complex numbers": [[np.zeros(1000, dtype=complex)]],
}


def right(case: TermCase) -> list[Any]:
    """The right answer to a case, as a program gives it."""
    return CATALOGUE.exercise.answer(case.question, {}, 1)


def told(wrong: str, values: list[Any]) -> list[str]:
    """What is said where one term has these answers and all others are right."""
    answers = [{"values": values if case.term == wrong else right(case)} for case in CASES]
    return [finding.words for finding in seen(CATALOGUE, CASES, answers)]


@pytest.mark.parametrize("form", OF_ANOTHER_FORM)
def test_a_term_without_an_answer_is_wrong(form: str) -> None:
    """As one that is off by a tenth is; the others stay right."""
    terms = {case.term for case in CASES}
    assert {"the weight", "the drag", "the spring above"} <= terms
    for term in terms:
        (words,) = told(term, OF_ANOTHER_FORM[form])
        assert words.endswith(f" right, and {term} wrong.")


def test_where_all_terms_are_alike_nothing_is_told() -> None:
    """All right, or none of them: which is wrong is not a question then."""
    assert told("", []) == []
    nothing = [{"values": []} for _ in CASES]
    assert seen(CATALOGUE, CASES, nothing) == []


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_how_far_an_answer_is_off_is_a_part_of_the_right_one(size: float) -> None:
    """Twice as much is wrong by all of it, however small it is; rounding is nothing."""
    asked = [np.array([size, -size])]
    assert _error((CASES[0], [2 * asked[0]], asked)) == pytest.approx(1.0)
    assert _error((CASES[0], [(1 + 1e-15) * asked[0]], asked)) == 0.0
    assert _error((CASES[0], None, asked)) == np.inf


def made_of(exercise: Exercise, *questions: Question) -> list[TermCase]:
    """The cases of these questions."""
    return cases(AnswerCatalogue(exercise, questions))


def nothing(random: object, hidden: bool, seed: str) -> list[Question]:
    """No questions: tests put their own."""
    return []


def move(x: Any, v: Any, dt: float, given: Any, scheme: str = "heun") -> tuple[Any, Any]:
    """A step; which one does not matter."""
    return x, v


FORCES = Exercise("", 0, "", {"forces": lambda x, v, string: x}, nothing, ())
STEPS = Exercise("", 0, "", {"step": move}, nothing, ())
X = np.array([[1.0, -2.0], [3.0, -5.0], [4.0, -7.0]])
STRING = {
    "masses": np.array([1.0, 2.0, 3.0]),
    "stiffness": np.array([10.0, 20.0, 30.0]),
    "rest_lengths": np.array([1.0, 2.0, 3.0]),
    "drag": 0.5,
    "gravity": 1.62,
}
SPRING = {"mass": 2.0, "stiffness": 50.0, "rest_length": 0.1, "damping": 0.3, "gravity": 9.81}


def test_on_a_string_one_term_is_left_at_a_time() -> None:
    """The weight, the drag, the first spring and the last: what else acts is switched off, and whom it is on."""
    made = made_of(FORCES, Question("other", (1.0,), ("x",), ""), Question("forces", (X, X, STRING), ("f",), ""))
    fields = [case.question.arguments[-1] for case in made]
    left = [(f["stiffness"].tolist(), f["drag"], f["gravity"]) for f in fields]
    assert [(case.term, case.rows) for case in made] == [
        ("the weight", ()),
        ("the drag", ()),
        ("the spring on the anchor", (0,)),
        ("the spring above", (2,)),
        ("the spring below", (1,)),
    ]
    last = ([0.0, 0.0, 30.0], 0.0, 0.0)
    assert left == [([0.0] * 3, 0.0, 1.62), ([0.0] * 3, 0.5, 0.0), ([10.0, 0.0, 0.0], 0.0, 0.0), last, last]
    assert {case.of for case in made} == {1}
    assert STRING["stiffness"].tolist() == [10.0, 20.0, 30.0]
    alone = {name: value[:1] if isinstance(value, np.ndarray) else value for name, value in STRING.items()}
    short = made_of(FORCES, Question("forces", (X[:1], X[:1], alone), ("f",), ""))
    assert [case.term for case in short] == ["the weight", "the drag", "the spring on the anchor"]


def test_on_one_spring_one_term_is_left_at_a_time() -> None:
    """The damping only where there is some; then the same step with a shorter dt."""
    terms = {"the weight": (0.0, 0.0, 9.81), "the spring": (50.0, 0.0, 0.0), "the damping": (0.0, 0.3, 0.0)}
    asked = Question("step", (-0.2, 1.0, 0.5, SPRING), ("y", "v"), "", steps=20)
    made = made_of(STEPS, asked)
    assert {case.question.steps for case in made} == {1}
    left = {
        case.term: tuple(case.question.arguments[-1][n] for n in ("stiffness", "damping", "gravity")) for case in made
    }
    assert left == {**terms, "": (50.0, 0.3, 9.81)}
    assert [c.question.arguments[:3] for c in made if not c.term] == [(-0.2, 1.0, 0.5 / part) for part in (64, 128)]
    undamped = made_of(STEPS, replace(asked, arguments=(*asked.arguments[:3], {**SPRING, "damping": 0.0})))
    assert [case.term for case in undamped] == ["the weight", "the spring", "", ""]


def test_of_what_is_no_force_of_that_kind_nothing_is_asked() -> None:
    """Bridges, strings with damped springs, circles; and a shorter dt only of steps that have a second slope."""
    for fields in (
        {**STRING, "members": np.array([[0, 1]])},
        {**STRING, "damping": np.ones(3)},
        {"gravity": 9.81},
        {name: STRING[name] for name in ("stiffness", "rest_lengths")},
    ):
        assert made_of(FORCES, Question("forces", (X, X, fields), ("f",), "")) == []

    def euler(x: Any, v: Any, dt: float, given: Any, scheme: str = "euler") -> tuple[Any, Any]:
        return x, v

    def schemeless(x: Any, v: Any, dt: float, given: Any) -> tuple[Any, Any]:
        return x, v

    for solution, steps, shorter in ((euler, 20, 0), (schemeless, 20, 2), (move, 20, 2), (move, 0, 0)):
        exercise = Exercise("", 0, "", {"step": solution}, nothing, ())
        made = made_of(exercise, Question("step", (-0.2, 1.0, 0.5, SPRING), ("y", "v"), "", steps=steps))
        assert len([case for case in made if not case.term]) == shorter


def test_only_the_masses_that_are_looked_at_count() -> None:
    """The spring above the last mass alone is right where the last is, the one below where the last but one is."""
    for row, wrong in ((2, "the spring above"), (1, "the spring below"), (0, "the spring on the anchor")):
        answers = []
        for case in CASES:
            (force,) = [part.copy() for (part,) in right(case)]
            if len(force) > row and case.term in ("the spring above", "the spring below", "the spring on the anchor"):
                last = len(force) - 1
                place = {"the spring above": last, "the spring below": last - 1, "the spring on the anchor": 0}[wrong]
                force[place] += force.max() * (case.term == wrong)
                force[[i for i in range(len(force)) if i not in case.rows]] += 1.0
            answers.append({"values": [[force]]})
        words = [finding.words for finding in seen(CATALOGUE, CASES, answers)]
        assert words
        assert words[0].endswith(f" right, and {wrong} wrong.")


@pytest.mark.parametrize(
    ("shrinks", "name"),
    [
        (1.88, None),
        (1.92, "first_slope_wrong"),
        (2.08, "first_slope_wrong"),
        (2.12, None),
        (3.5, None),
        (3.7, "first_slope_right"),
        (4.3, "first_slope_right"),
        (4.5, None),
    ],
)
def test_by_what_an_error_shrinks_with_half_the_dt_tells_the_slope(shrinks: float, name: str | None) -> None:
    """About 2: the first; about 4: the second only; and nothing where one of several questions says something else."""
    asked = [Question("step", (X, X, 0.5, STRING), ("x", "v"), "", steps=20) for _ in range(2)]
    catalogue = AnswerCatalogue(STEPS, asked)
    made = cases(catalogue)

    def told_of(*by: float, named: bool = False) -> list[str]:
        errors = iter(error for one in by for error in (1e-3, 1e-3 / one))
        answers = [{"values": [[X, X + (0.0 if case.term else next(errors)) * 7]]} for case in made]
        return [finding.name for finding in seen(catalogue, made, answers, **({"named": True} if named else {}))]

    assert told_of(shrinks, shrinks) == [name] * (name is not None)
    assert told_of(shrinks, 3.0) == []
    assert told_of(3.0, shrinks) == []
    assert told_of(shrinks, shrinks, named=True) == []
    # a question whose answer is right to rounding says nothing
    assert told_of(shrinks, 1e15) == [name] * (name is not None)
    assert told_of(1e15, 1e15) == []
    # nor is anything told where one of two parts cannot be compared, or nothing can
    right = [[[X, X]] for _ in made]
    for other in ([], [[X, np.zeros(2)]], [[np.array(["a", "b"] * 3).reshape(3, 2), X]]):
        for missing in (made[-1:], made[-2:-1], [case for case in made if not case.term]):
            given = [other if case in missing else v for case, v in zip(made, right, strict=True)]
            assert seen(catalogue, made, [{"values": values} for values in given]) == []


def test_lines_are_told_where_they_are_few() -> None:
    """Three at most, of terms that are read in one place; of Python and C, and of a name that a field has got."""
    gravity = "def forces(x, v, s):\n    g = s.gravity\n    a = -g\n    b = 2 * g  # s.gravity\n"
    assert lines_with(gravity, "gravity") == [3, 4]
    assert lines_with(gravity, "drag") == []
    assert lines_with("w = m * s.gravity\nu = s.gravity", "gravity") == [1, 2]
    assert lines_with("w = m * s.gravity", "gravity") == [1]

    def told_with(source: str) -> tuple[str, tuple[int, ...]]:
        answers = [{"values": [[p + 10 * (c.term == "the weight") for p in right(c)[0]]]} for c in CASES]
        (found,) = seen(CATALOGUE, CASES, answers, source)
        assert found.hint == "Where in your text is the weight?"
        return found.words.partition(" wrong.")[2], found.lines

    read = " What is read for it stands in line"
    assert told_with("s.drag\ns.gravity") == (f"{read} 2.", (2,))
    assert told_with("s.gravity\n\ns.gravity\ns.gravity") == (f"{read}s 1, 3 and 4.", (1, 3, 4))
    assert told_with("s.gravity\n" * 4) == ("", ())
    assert told_with("") == ("", ())


def test_a_term_is_wrong_where_one_number_is_and_right_to_rounding() -> None:
    """Of one mass; and where terms are wrong that stand on no line of their own no lines are told."""

    def told_of(**by: float) -> tuple[str, tuple[int, ...]]:
        answers = []
        for case in CASES:
            (force,) = [part.copy() for part in right(case)[0]]
            force[-1, -1] += by.get(case.term.replace(" ", "_"), 0.0) * np.abs(force).max()
            answers.append({"values": [[force]]})
        found = seen(CATALOGUE, CASES, answers, "s.gravity")
        return (found[0].words, found[0].lines) if found else ("", ())

    assert told_of(the_weight=1e-12) == ("", ())
    words, lines = told_of(the_weight=1e-6, the_drag=1e-12)
    assert " and the weight wrong." in words
    assert lines == (1,)
    words, lines = told_of(the_weight=1e-6, the_spring_above=1e-6)
    assert words.endswith(" right, and the weight and the spring above wrong.")
    assert lines == ()
