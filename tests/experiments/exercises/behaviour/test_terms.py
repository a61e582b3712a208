"""Terms of a force that are right and wrong, by answers that are made up."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from experiments.exercises.behaviour.terms import TermCase, _error, cases, seen
from experiments.exercises.exercise import find
from experiments.exercises.verdict.answer_catalogue import catalogue_of

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
    asked = [[np.array([size, -size])]]
    assert _error((CASES[0], [[2 * asked[0][0]]], asked)) == pytest.approx(1.0)
    assert _error((CASES[0], [[(1 + 1e-15) * asked[0][0]]], asked)) == 0.0
    assert _error((CASES[0], None, asked)) == np.inf
