"""Where an answer first differs from the right one: question, step, part, index and both numbers."""

from __future__ import annotations

from copy import deepcopy

import pytest

from experiments.exercises.exercise import Answer, find
from experiments.exercises.verdict.answer_catalogue import AnswerCatalogue, catalogue_of
from experiments.exercises.verdict.first_difference import first_difference

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
