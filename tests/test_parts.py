"""Long lists that are checked in parts: after as many days as there are parts all have been checked."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from tests.parts import PARTS, Turns, kept


@pytest.mark.parametrize("every", range(1, PARTS + 1))
def test_every_case_that_rotates_comes_round(every: int) -> None:
    """And is run every n-th day, but for where the parts begin again."""
    cases = range(3 * every)
    days = [[case for case in cases if kept(case, every, number)] for number in range(PARTS)]
    assert sorted({case for day in days for case in day}) == list(cases)
    assert {len(day) for day in days} == {3}


def days_of(cases: Sequence[str], every: int, in_turn: bool) -> list[list[str]]:
    """What of the cases each day keeps."""
    days = [Turns(number) for number in range(PARTS)]
    return [[case for case in cases if turns.keep(case, every, in_turn)] for turns in days]


CASES = ("test_a.py::test_one", "test_a.py::test_two", "test_a.py::test_three[0]", "test_a.py::test_three[1]")


def test_tests_of_a_file_take_turns() -> None:
    """One of them every day, and all come round; those that do not take turns have the same days, cases others."""
    assert {len(day) for day in days_of(CASES, 4, True)} == {1}
    assert {case for day in days_of(CASES, 4, True) for case in day} == set(CASES)
    alone = [day for day in days_of(CASES, 4, False) if CASES[0] in day]
    assert alone
    assert all(day == [CASES[0], CASES[1], CASES[2]] for day in alone)


def test_files_begin_with_other_days() -> None:
    """Not all that takes long is run on one day."""
    files = [f"test_{letter}.py::test_it" for letter in "abcdefgh"]
    assert all(0 < len(day) < len(files) for day in days_of(files, 2, False))
