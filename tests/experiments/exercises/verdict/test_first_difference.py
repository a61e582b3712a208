"""Where an answer first differs from the right one: question, step, part, index and both numbers."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import numpy as np
import pytest

from experiments.exercises.exercise import Answer, Question, find
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue, catalogue_of
from experiments.exercises.verdict.first_difference import FirstDifference, Lines, _lines, first_difference

TOLERANCE = 1e-9


@pytest.fixture
def strings() -> AnswerCatalogue:
    """Questions on the steps of strings, in the plane."""
    return catalogue_of(find("4"), "", None)


@pytest.fixture
def given(strings: AnswerCatalogue) -> list[Answer]:
    """The right answers, to be changed."""
    return deepcopy(strings.right)


def test_right_answers_have_none(strings: AnswerCatalogue, given: list[Answer]) -> None:
    """Nor have those that differ by less than the tolerance, as a fraction of the largest number."""
    assert first_difference(strings, given, TOLERANCE) == (None, None)
    given[0][3][0][1, 0] += 0.9 * TOLERANCE * strings.scales[0][0]
    assert first_difference(strings, given, TOLERANCE) == (None, None)


def test_it_is_the_first_by_question_step_part_and_index(strings: AnswerCatalogue, given: list[Answer]) -> None:
    """Steps are counted from 1, masses from 0; what differs by less than the tolerance before it is not it."""
    given[1][4][1][2, 1] += 0.5  # of question 1, step 5, v, mass 2, y
    given[1][4][1][2, 0] += 0.5 * TOLERANCE * strings.scales[1][1]
    given[1][5][0][0, 0] += 0.5
    given[2][0][0][0, 0] += 0.5
    found, _ = first_difference(strings, given, TOLERANCE)
    assert found is not None
    assert (found.about, found.step, found.part) == (strings.questions[1].about, 5, "v")
    assert (found.item, found.index) == ("mass", (2, 1))
    assert found.given - found.right == pytest.approx(0.5)
    assert found.right == strings.right[1][4][1][2, 1]


def test_the_lines_are_that_number_in_every_step(strings: AnswerCatalogue, given: list[Answer]) -> None:
    """The right ones and the given ones, not the other way about."""
    given[0][2][0][1, 1] += 0.25
    _, lines = first_difference(strings, given, TOLERANCE)
    assert lines is not None
    assert lines.over == "step"
    assert lines.right.tolist() == [step[0][1, 1] for step in strings.right[0]]
    assert (lines.given - lines.right).tolist() == pytest.approx([0, 0, 0.25] + [0] * 9)


def test_lines_end_where_an_answer_gets_another_shape(strings: AnswerCatalogue, given: list[Answer]) -> None:
    """A later step of more numbers, or fewer, has none in that place (found by `tests.fuzz`)."""
    given[0][1][0][1, 0] += 0.5
    given[0][3][0] = given[0][3][0][None]
    found, lines = first_difference(strings, given, TOLERANCE)
    assert found is not None
    assert lines is not None
    assert (found.step, len(lines.given), len(lines.right)) == (2, 3, len(strings.right[0]))


def test_without_steps_the_lines_are_over_masses() -> None:
    """In one column of the forces; and the number of a step is 0."""
    catalogue = catalogue_of(find("3"), "", None)
    given = deepcopy(catalogue.right)
    given[0][0][0][3, 1] += 1.0
    found, lines = first_difference(catalogue, given, TOLERANCE)
    assert found is not None
    assert lines is not None
    assert (found.step, found.index, lines.over) == (0, (3, 1), "mass")
    assert lines.right.tolist() == catalogue.right[0][0][0][:, 1].tolist()
    assert (lines.given - lines.right).tolist() == pytest.approx([0, 0, 0, 1, 0])


def test_where_everybody_has_numbers_of_their_own_the_right_one_is_not_told() -> None:
    """Neither in words nor as a line: it would be the answer. The given one is told."""
    catalogue = catalogue_of(find("5"), "ada", None)
    given = [[[2.0 * step[0]]] for (step,) in catalogue.right]
    found, lines = first_difference(catalogue, given, catalogue.exercise.tolerance)
    assert found is not None
    assert lines is None
    assert f"{found.given:.9g}" in str(found)
    assert f"{found.right:.9g}" not in str(found)


@pytest.mark.parametrize(
    ("found", "words"),
    [
        (
            ("string of 3", 5, "v", "mass", (2, 1), 1.5, 2.25),
            "string of 3, step 5, mass 2: v[2, 1] is 2.25, expected 1.5",
        ),
        (("spring 1", 1, "y", "mass", (), 0.1, 1 / 3), "spring 1, step 1: y is 0.333333333, expected 0.1"),
        (("a string", 0, "f", "mass", (4,), 1, 2), "a string, mass 4: f[4] is 2, expected 1"),
        (("Euler", 0, "dt", "", (), 0.1, 0.2, False), "Euler: dt is 0.2, which is not right"),
        (("letters", 0, "names", "trajectory", (1,), "a", "b"), "letters, trajectory 1: names[1] is 'b', expected 'a'"),
        (("cloth", 0, "s", "between mass", (1, 2), 2, 1), "cloth, between mass 1 and mass 2: 1 spring, expected 2"),
        (("cloth", 0, "s", "between mass", (0, 9), 0, 2), "cloth, between mass 0 and mass 9: 2 springs, expected 0"),
    ],
)
def test_it_is_told_in_words(found: tuple[Any, ...], words: str) -> None:
    """Where it is, what is given, what is expected."""
    assert str(FirstDifference(*found)) == words


@pytest.mark.parametrize(
    ("item", "steps", "units", "index", "what"),
    [
        ("mass", 2, ("m", "m/s"), (1, 0), "v[1, 0] [m/s]"),
        ("mass", 2, (), (1, 0), "v[1, 0]"),
        ("mass", 0, ("m", "m/s"), (1, 0), "v[:, 0] [m/s]"),
        ("joint", 0, (), (1, 1), "v[:, 1]"),
        ("between mass", 0, (), (1, 1), None),
    ],
)
def test_what_is_drawn(item: str, steps: int, units: tuple[str, ...], index: tuple[int, ...], what: str | None) -> None:
    """A number over steps, or a column over masses, with its unit; of two answers the right one first."""
    question = Question("f", (), ("x", "v"), "", steps=steps, item=item, units=units)
    first, second = np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([[5.0, 6.0], [7.0, 8.0]])
    right = [[0 * first, first], [0 * first, second]][: max(1, steps)]
    given = [[x, v + 0.5] for x, v in right]
    lines = _lines(question, given, right, 1, index)
    if what is None:
        assert lines is None
        return
    assert isinstance(lines, Lines)
    assert (lines.over, lines.what) == ("step" if steps else item, what)
    wanted = [first[index], second[index]] if steps else first[:, index[1]].tolist()
    assert lines.right.tolist() == wanted
    assert (lines.given - lines.right).tolist() == [0.5, 0.5]


def test_of_one_number_and_of_words_nothing_is_drawn() -> None:
    """One number over steps is."""
    one = [[np.array(1.5)], [np.array(2.5)]]
    assert _lines(Question("f", (), ("x",), ""), one[:1], one[:1], 0, ()) is None
    words = [[np.array(["a", "b"])]]
    assert _lines(Question("f", (), ("x",), ""), words, words, 0, (1,)) is None
    # nor of numbers in place of words, which differ in every place
    catalogue = catalogue_of(find("8"), "ada", None)
    found, lines = first_difference(catalogue, [[[np.arange(5.0)]]], TOLERANCE)
    assert found is not None
    assert (found.index, found.given, lines) == ((0,), 0.0, None)
    lines = _lines(Question("f", (), ("x",), "", steps=2), one, one, 0, ())
    assert lines is not None
    assert (lines.what, lines.right.tolist()) == ("x", [1.5, 2.5])
