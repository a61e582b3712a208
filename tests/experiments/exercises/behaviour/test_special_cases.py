"""Special cases are what their words say, and what is told of answers follows from them: both worked out by hand."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from experiments.exercises.behaviour.special_cases import WHERE, cases, seen
from experiments.exercises.exercise import Exercise, Question
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue

#: Springs of 5 m and 13 m: by (3, -4) and by (-5, -12) from what holds them.
ANCHOR = np.array([1.0, 2.0])
X, V = np.array([[4.0, -2.0], [-1.0, -14.0]]), np.array([[1.0, 2.0], [3.0, 4.0]])
STRING = {
    "masses": np.array([1.0, 3.0]),
    "stiffness": np.array([10.0, 30.0]),
    "rest_lengths": np.array([2.0, 4.0]),
    "damping": np.array([0.1, 0.3]),
    "drag": 0.5,
    "gravity": 1.62,
    "anchor": ANCHOR,
}
SPRING = {"mass": 2.0, "stiffness": 50.0, "rest_length": 0.1, "damping": 0.3, "gravity": 9.81}
CIRCLE = {"centre": np.array([1.0, 2.0]), "radius": 0.5}
BRIDGE = {"members": np.array([[0, 1], [1, 2]]), "stiffness": np.array([10.0, 30.0]), "gravity": 9.81}
DT = 0.25


def hung(first: float, second: float) -> Mapping[str, Any]:
    """The string with springs of other lengths [m]."""
    one = ANCHOR + first * np.array([0.6, -0.8])
    return {"x": np.array([one, one + second * np.array([-5.0, -12.0]) / 13])}


ONE_MASS = {name: value[:1] for name, value in STRING.items() if isinstance(value, np.ndarray) and name != "anchor"}

#: What is another in each case, and in cases that are not here, nothing: there is no such case.
OF_A_STRING: Mapping[str, Mapping[str, Any]] = {
    "nothing is dragged": {"drag": 0.0},
    "there is no damping": {"damping": np.zeros(2)},
    "there is no gravity": {"gravity": 0.0},
    "gravity is 9.81 m/s^2": {"gravity": 9.81},
    "nothing moves": {"v": np.zeros((2, 2))},
    "there is one mass": {"x": X[:1], "v": V[:1], **ONE_MASS},
    "all masses are equal": {"masses": np.array([2.0, 2.0])},
    "every mass is 1 kg": {"masses": np.ones(2)},
    "all springs are alike": {"stiffness": np.array([20.0, 20.0]), "rest_lengths": np.array([3.0, 3.0])},
    "the springs are as long as at rest": hung(2.0, 4.0),
    "the springs are a little stretched": hung(2.6, 5.2),
    "the springs are a little pressed": hung(1.6, 3.2),
    "the string hangs straight down": {"x": np.array([[1.0, -3.0], [1.0, -16.0]])},
    "rest lengths are 0": {"rest_lengths": np.zeros(2)},
    "the anchor or the centre is at the origin": {"x": np.array([[3.0, -4.0], [-2.0, -16.0]]), "anchor": np.zeros(2)},
}
OF_A_SPRING: Mapping[str, Mapping[str, Any]] = {
    "there is no damping": {"damping": 0.0},
    "there is no gravity": {"gravity": 0.0},
    "nothing moves": {"v": 0.0},
    "the mass is 1 kg": {"mass": 1.0},
}
OF_A_CIRCLE: Mapping[str, Mapping[str, Any]] = {
    "nothing moves": {"v": np.zeros((2, 2))},
    "the anchor or the centre is at the origin": {"x": np.array([[3.0, -4.0], [-2.0, -16.0]]), "centre": np.zeros(2)},
    "the radius is 1 m": {"radius": 1.0},
}
OF_A_BRIDGE: Mapping[str, Mapping[str, Any]] = {
    "there is no gravity": {"gravity": 0.0},
    "all members are equally stiff": {"stiffness": np.array([20.0, 20.0])},
}


@pytest.mark.parametrize("where", WHERE)
@pytest.mark.parametrize(
    ("given", "changes"),
    [
        ((X, V, STRING), OF_A_STRING),
        ((X, V, DT, STRING), OF_A_STRING),
        ((-0.2, 0.3, DT, SPRING), OF_A_SPRING),
        ((X, V, CIRCLE), OF_A_CIRCLE),
        ((BRIDGE,), OF_A_BRIDGE),
    ],
    ids=["string", "step of a string", "spring", "circle", "bridge"],
)
def test_a_case_is_what_its_words_say(
    where: str, given: tuple[Any, ...], changes: Mapping[str, Mapping[str, Any]]
) -> None:
    """One thing is another, all else is as it was; there is no case where that is so already, or says nothing."""
    made = WHERE[where](list(given))
    if where not in changes:
        assert made is None
        return
    wanted = [*given[:-1], {**given[-1], **{k: v for k, v in changes[where].items() if k in given[-1]}}]
    for place, name in enumerate("xv"):
        if name in changes[where]:
            wanted[place] = changes[where][name]
    assert made is not None
    assert len(made) == len(wanted)
    for one, other in zip(made, wanted, strict=True):
        if isinstance(other, dict):
            assert one.keys() == other.keys()
            assert all(np.shape(one[n]) == np.shape(other[n]) for n in other)
            assert all(one[name] == pytest.approx(other[name], rel=1e-14) for name in other)
        else:
            assert np.shape(one) == np.shape(other)
            assert one == pytest.approx(other, rel=1e-14, abs=1e-14)


def test_a_string_of_one_mass_is_no_case_of_one_mass() -> None:
    """It would be the same question again; one of two springs of which one thing is alike is made alike."""
    assert WHERE["there is one mass"]([X[:1], V[:1], {**STRING, **ONE_MASS}]) is None
    half = WHERE["all springs are alike"]([X, V, {**STRING, "rest_lengths": np.array([3.0, 3.0])}])
    assert half is not None
    assert half[-1]["stiffness"].tolist() == [20.0, 20.0]
    assert WHERE["nothing moves"]([-0.2, 0.3, SPRING]) is None


def force(x: Any, v: Any, string: Any) -> tuple[Any, Any]:
    """Right: the weight of every mass [N], and the power of the drag [W]."""
    return string.masses * string.gravity, -string.drag * (v**2).sum()


def of_four(x: Any, v: Any, string: Any) -> tuple[Any, Any]:
    """Right, where four fields count."""
    return force(x, v, string)[0] + string.stiffness, force(x, v, string)[1]


Program = Callable[[Any, Any, Any], tuple[Any, Any]]


def question(share: float = 1.0, **fields: Any) -> Question:
    """About masses of 1 and 3 kg, or other fields, that move at a share of their speeds."""
    return Question("force", (X, share * V, {**STRING, **fields}), ("weight", "power"), "two masses")


def told(wrong: Program, *questions: Question, solved: Program = force) -> dict[str, str]:
    """What is said, by name, of a program."""
    exercise = Exercise("", 0, "", {"force": solved}, lambda *_: questions, ())
    catalogue = AnswerCatalogue(exercise, questions)
    made = cases(catalogue)
    asked = [*questions, *(case.question for case in made)]
    answers = []
    for x, v, string in (q.arguments for q in asked):
        try:
            with np.errstate(all="ignore"):
                values = [[np.asarray(part) for part in wrong(x, v, SimpleNamespace(**string))]]
        except ZeroDivisionError:
            values = []
        answers.append({"values": values})
    return {finding.name: finding.words for finding in seen(catalogue, made, answers)}


THREE = question(), question(0.5, masses=np.array([2.0, 7.0])), question(2.0, drag=0.2)


def test_cases_are_made_of_one_step_of_every_question() -> None:
    """Each field that is a number or has fractions is once a quarter larger and 0.01; whole numbers are not."""
    fields = {"drag": 2.0, "masses": np.array([1.0, 3.0]), "count": 2, "pairs": np.array([0, 1])}
    asked = [
        Question("names", (), ("names",), "nothing"),
        Question("step", (X, V, fields), ("x", "v"), "steps", steps=12),
        Question("force", (X, V, fields), ("force",), "a force"),
        Question("sum", (1.0, 2.0), ("sum",), "numbers"),
    ]
    made = cases(AnswerCatalogue(Exercise("", 0, "", {}, lambda *_: asked, ()), asked))
    assert {(case.of, case.question.steps) for case in made} == {(1, 1), (2, 0)}
    changed = [(case.ignored, np.array(case.question.arguments[-1][case.ignored])) for case in made if case.ignored]
    assert [name for name, _ in changed] == ["drag", "masses"] * 2
    assert changed[0][1] == pytest.approx(2.51)
    assert changed[1][1] == pytest.approx(np.array([1.26, 3.76]))
    assert all(bool(case.where) != bool(case.ignored) for case in made)


def test_a_right_program_is_told_nothing() -> None:
    """Whatever is asked."""
    assert told(force, *THREE) == {}


def test_the_same_answer_to_everything_is_told() -> None:
    """To at least three questions, or nothing but zeros; not where the answers have several shapes, or are few."""
    same = "Your answer is the same whatever your function is given"
    assert told(lambda *_: (np.ones(2), 3.0), *THREE)["always_the_same"] == f"{same}."
    assert "always_the_same" not in told(lambda *_: (np.ones(2), 3.0), *THREE[:2])
    assert told(lambda *_: (np.zeros(2), 0.0), *THREE[:1])["always_the_same"] == f"{same}: nothing but zeros."
    assert "always_the_same" not in told(lambda *_: (np.zeros(2), 1.0), *THREE[:2])
    assert "always_the_same" not in told(lambda *_: (np.array([0.0, 1.0]), 0.0), *THREE[:2])
    assert "always_the_same" not in told(lambda x, v, s: (s.masses, 3.0), *THREE)

    def of_two_shapes(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        return np.ones(1 if s.drag == 0.2 else 2), 3.0

    assert "always_the_same" not in told(of_two_shapes, *THREE)


@pytest.mark.parametrize(
    ("factor", "words"),
    [
        (2.0, "twice"),
        (0.5, "half"),
        (-1.0, "minus"),
        (4.0, "four times"),
        (0.25, "a quarter of"),
        (1000.0, "1000 times"),
        (0.001, "a thousandth of"),
        (6.283185307179586, "2 pi times"),
        (0.15915494309189535, "1 / (2 pi) times"),
        (0.017453292519943295, "pi / 180 times"),
        (57.29577951308232, "180 / pi times"),
        (3.0, "3 times"),
        (2 + 1e-6, "twice"),
        (2 + 6e-6, "2.00001 times"),
        (1.000006, "1.00001 times"),
    ],
)
def test_a_constant_factor_is_told(factor: float, words: str) -> None:
    """Of the part that has it, in words where it has some."""

    def wrong(x: Any, v: Any, string: Any) -> tuple[Any, Any]:
        weight, power = force(x, v, string)
        return weight, factor * power

    assert told(wrong, *THREE)["constant_factor"] == f"Everywhere power is {words} the right one."
    assert "constant_factor" in told(wrong, *THREE[:2])
    assert "constant_factor" not in told(wrong, *THREE[:1])  # one answer is a multiple of many things


def test_what_is_no_constant_factor_is_not_told() -> None:
    """One of rounding; one of steps; one that is another in another question, or of another mass; numbers beside 0."""

    def times(by: Callable[..., Any]) -> Program:
        def wrong(x: Any, v: Any, string: Any) -> tuple[Any, Any]:
            weight, power = force(x, v, string)
            return by(string) * weight, power

        return wrong

    assert "constant_factor" not in told(times(lambda s: 1 + 5e-7), *THREE)
    assert "constant_factor" not in told(times(lambda s: 2 + 2e-5 * s.drag), *THREE)  # drag is 0.5 and 0.2
    assert "constant_factor" in told(times(lambda s: 2 + 2e-6 * s.drag), *THREE)
    light = [question(masses=np.array([1e-3, 0.0, 3e-3])), question(masses=np.array([0.0, 2e-3, 7e-3]))]
    assert "constant_factor" in told(times(lambda s: 2.0), *light)
    for off, is_told in ((1e-10, True), (4e-9, False)):  # of the heaviest mass, and of no others
        assert ("constant_factor" in told(times(lambda s, off=off: 2 + off * (s.masses > 2.9e-3)), *light)) == is_told
    assert "constant_factor" not in told(times(lambda s: np.inf), *THREE)
    unmoved = [question(0.0), question(0.0, drag=0.2)]
    assert "constant_factor" not in told(lambda x, v, s: (force(x, v, s)[0], 1.0), *unmoved)


def test_fields_that_change_nothing_are_told() -> None:
    """Up to three; not those that change nothing in the right answer either, nor where there is no answer."""

    def only(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        return s.masses * 1.62, -0.5 * (v**2).sum()

    words = "Another value of {} changes nothing in your answers, and should."
    assert told(only, question())["not_used"] == words.format("drag (in force) and gravity (in force)")
    assert told(lambda x, v, s: (s.masses * s.gravity, -0.5 * (v**2).sum()), *THREE)["not_used"] == words.format(
        "drag (in force)"
    )

    def never(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        return np.array([1.0, 7.0]), -(v**2).sum()

    assert told(never, question())["not_used"] == words.format(
        "masses (in force) and drag (in force) and gravity (in force)"
    )

    def nothing_used(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        return np.array([1.0, 7.0]), -7.0

    assert "not_used" not in told(nothing_used, question(), solved=of_four)
    assert "not_used" in told(nothing_used, question(), solved=force)

    def used_once(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        return s.masses * s.gravity, -(s.drag if s.masses[0] == 2.0 else 0.5) * (v**2).sum()

    assert "not_used" not in told(used_once, *THREE)

    def without_an_answer(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        _ = 1 / (s.drag == 0.5)
        return s.masses * s.gravity, -1.0 * (v**2).sum()

    assert "not_used" not in told(without_an_answer, question())


def test_where_answers_are_right_is_told() -> None:
    """All that were wrong, three places at most; not where they are right everywhere, or nowhere."""

    def on_earth(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        return s.masses * 9.81, force(x, v, s)[1]

    assert told(on_earth, *THREE)["right_where"] == "Your first answers are all right where gravity is 9.81 m/s^2."
    # of the second question, which is right, nothing is asked: that it is wrong without drag says nothing
    assert "right_where" in told(lambda x, v, s: on_earth(x, v, s), question(), question(gravity=9.81))

    def without_drag_elsewhere(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        return (s.masses * 9.81 if s.drag else -s.masses), force(x, v, s)[1]

    both = question(), question(gravity=9.81, damping=np.array([0.0, 0.0]))
    assert told(without_drag_elsewhere, *both)["right_where"].endswith(" where gravity is 9.81 m/s^2.")

    def by_turns(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        return force(x, v, s)[0] + (bool(s.drag) == (s.gravity != 9.81)), force(x, v, s)[1]

    # only the first is wrong, and there without drag it is right: what becomes of the second says nothing
    assert "nothing is dragged" in told(by_turns, question(), question(gravity=9.81))["right_where"]

    def of_one_kilogram(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        return s.gravity * np.ones(len(x)), force(x, v, s)[1]

    # the first of the masses is 1 kg
    wanted = "Your first answers are all right where {}."
    one = "there is no gravity, and where there is one mass, and where every mass is 1 kg"
    assert told(of_one_kilogram, question())["right_where"] == wanted.format(one)
    two = "there is no gravity, and where every mass is 1 kg"
    assert told(of_one_kilogram, *THREE)["right_where"] == wanted.format(two)

    def four(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        heavy = (s.masses > 1).all() and s.gravity != 9.81 and s.drag and v.any()
        return s.masses * s.gravity + 1e-3 * heavy, force(x, v, s)[1]

    told_of_four = told(four, question(masses=np.array([2.0, 3.0])))["right_where"]
    assert told_of_four == wanted.format("nothing is dragged, and where gravity is 9.81 m/s^2, and where nothing moves")

    def never(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        return 1 + s.masses * s.gravity, force(x, v, s)[1]

    assert "right_where" not in told(never, *THREE)
    assert "right_where" not in told(force, *THREE)


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize(("off", "same"), [(3e-10, True), (3e-9, False)])
def test_same_is_to_a_billionth_of_the_largest_number_of_a_part(size: float, off: float, same: bool) -> None:
    """However large its numbers are, and those of the other part."""

    def wrong(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        weight, power = force(x, v, s)
        return weight, power - off * abs(power) * (s.drag == 0.5 * size)

    found = told(wrong, question(drag=0.5 * size), question(drag=0.7))
    assert ("right_where" in found) != same


def test_what_is_infinite_is_never_right() -> None:
    """However large it is beside the right number."""

    def without_drag(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        weight, power = force(x, v, s)
        return weight, -np.inf if s.drag == 0.5 else power

    assert told(without_drag, question(), question(drag=0.7))["right_where"].startswith(
        "Your first answers are all right where nothing is dragged"
    )

    def infinite(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        return force(x, v, s)[0], -np.inf

    assert "right_where" not in told(infinite, *THREE)


@pytest.mark.parametrize(
    "values",
    [[], [[]], [[np.ones(2)]], [[np.ones(2), np.array("one")]], [[np.ones(3), np.array(1.0)]]],
    ids=["nothing", "no parts", "one part", "words", "three masses"],
)
def test_an_answer_of_another_form_is_wrong(values: list[Any]) -> None:
    """Where the others are right, what is told is where they are: nothing moves in one question only."""
    questions = [question(), question(0.0)]
    exercise = Exercise("", 0, "", {"force": force}, lambda *_: questions, ())
    catalogue = AnswerCatalogue(exercise, questions)
    made = cases(catalogue)
    answers = [{"values": exercise.answer(q, {}, 1)} for q in [*questions, *(case.question for case in made)]]
    answers[0] = {"values": values}
    for i, case in enumerate(made):
        if case.where != "nothing moves":
            answers[2 + i] = {"values": values}
    (found,) = [finding for finding in seen(catalogue, made, answers) if finding.name == "right_where"]
    assert found.words == "Your first answers are all right where nothing moves."


def test_of_many_steps_the_first_is_looked_at() -> None:
    """Steps of a quarter of the way; the second is never right, the first is where nothing moves."""

    def step(x: Any, v: Any, string: Any) -> tuple[Any, Any]:
        return x + 0.25 * v, v

    asked = [Question("step", (X, V, STRING), ("x", "v"), "steps", steps=3)]
    exercise = Exercise("", 0, "", {"step": step}, lambda *_: asked, ())
    catalogue = AnswerCatalogue(exercise, asked)
    made = cases(catalogue)
    firsts = [(q.arguments[0] + v, v) for q in [*asked, *(c.question for c in made)] for v in [q.arguments[1]]]
    answers = [{"values": [list(first), [np.ones(3)]]} for first in firsts]
    assert [f.words for f in seen(catalogue, made, answers)] == [
        "Your first answers are all right where nothing moves."
    ]
    twice = [{"values": [[2 * (x - 0.75 * v), v], [x, v]]} for x, v in firsts]
    assert "constant_factor" not in [f.name for f in seen(catalogue, made, twice)]


def test_an_array_of_one_number_is_that_number() -> None:
    """And none of two is."""
    assert told(lambda x, v, s: (force(x, v, s)[0], [force(x, v, s)[1]]), *THREE) == {}
    one = question(**ONE_MASS)
    one = Question("force", (X[:1], V[:1], one.arguments[2]), one.parts, one.about)
    assert told(lambda x, v, s: (force(x, v, s)[0][0], force(x, v, s)[1]), one) == {}

    def two_where_it_moves(x: Any, v: Any, s: Any) -> tuple[Any, Any]:
        weight, power = force(x, v, s)
        return weight, [power, power] if v.any() else power

    assert told(two_where_it_moves, *THREE)["right_where"] == "Your first answers are all right where nothing moves."
