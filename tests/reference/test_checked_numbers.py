"""Numbers as they come in: what is let through at every bound, and what is said of the first beyond it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from reference.checked_numbers import check_sizes, finite, in_range, refuse_below, refuse_twice, shaped, truths
from reference.errors import InputError


@pytest.mark.parametrize(
    "check",
    [
        lambda: finite("k", [1e50, -1e50], "N/m"),
        lambda: check_sizes("k", [1e50, -1e50, 0.0]),
        lambda: check_sizes("m", [1e-50, -1e-50], divided_by=True),
        lambda: refuse_below("k", np.array([0.0, 1.0]), "N/m", above_zero=False),
        lambda: refuse_below("m", np.array([1e-50, 1.0]), "kg", above_zero=True),
        lambda: refuse_twice("fixed", [3.0, 1.0, 2.0, 0.0]),
    ],
)
def test_what_is_at_a_bound_is_let_through(check: Callable[[], object]) -> None:
    """The largest and the smallest number there may be; zero where it may be."""
    check()


@pytest.mark.parametrize(
    ("check", "said"),
    [
        (lambda: finite("k", [1.0, 1.01e50, 2e50], "N/m"), "k[1] = 1.01e+50: expected a number of at most 1e+50 [N/m]"),
        (lambda: finite("k", [1.0, -1.01e50], "N/m"), "k[1] = -1.01e+50: expected a number of at most 1e+50 [N/m]"),
        (lambda: finite("k", [2e50, 1.0, np.nan], "N/m"), "k[2] = nan: expected a finite number [N/m]"),
        (lambda: finite("k", [[1.0, 2.0], [3.0, np.inf]], "m"), "k[1, 1] = inf: expected a finite number [m]"),
        (lambda: finite("k", ["a"], "N/m"), "k = ['a']: expected numbers [N/m]"),
        (lambda: check_sizes("k", [1.0, -1.01e50]), "k[1] = -1.01e+50: expected a number of at most 1e+50"),
        (lambda: check_sizes("m", [1.0, -0.99e-50], True), "m[1] = -9.9e-51: expected a number of at least 1e-50"),
        (lambda: in_range("k", -1.0, (3,), "N/m"), "k = -1: expected a number >= 0 [N/m]"),
        (lambda: in_range("k", [1.0, -1.0, -1.0], (3,), "N/m"), "k[1] = -1: expected a number >= 0 [N/m]"),
        (lambda: in_range("k", [-1.0, -2.0], (2,), "N/m"), "k[0] = -1: expected a number >= 0 [N/m]"),
        (lambda: in_range("m", [1.0, 0.0], (2,), "kg", True), "m[1] = 0: expected a number > 0 [kg]"),
        (
            lambda: in_range("m", [1.0, 0.99e-50], (2,), "kg", True),
            "m[1] = 9.9e-51: expected a number of at least 1e-50 [kg]",
        ),
        (lambda: in_range("m", [1.0, 2.0], (3,), "kg"), "m has shape (2,): expected (3,)"),
        (lambda: truths("fixed", [0, 1], "mass"), "fixed = [0, 1]: expected true or false for each mass"),
        (lambda: truths("fixed", [[True], []], "mass"), "fixed = [[True], []]: expected true or false for each mass"),
        (lambda: refuse_twice("fixed", [3.0, 1.0, 3.0, 1.0]), "fixed[2] = 3: expected every number once"),
    ],
)
def test_what_is_beyond_a_bound_is_refused(check: Callable[[], object], said: str) -> None:
    """With its place, unless all are the same; what is not finite before what is too large."""
    with pytest.raises(InputError) as refused:
        check()
    assert str(refused.value) == said


def test_one_number_stands_for_all() -> None:
    """Alone or as a list of one; truths of nothing are none."""
    for one in (np.array(2.5), np.array([2.5])):
        assert shaped("m", one, (2, 3)).tolist() == [[2.5] * 3] * 2
    assert truths("fixed", [], "mass").tolist() == []
    assert truths("fixed", [True, False], "mass").tolist() == [True, False]
