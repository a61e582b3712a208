"""Windows of stability above a first limit: of matrices that are positive where they are told to be."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from reference.errors import SolverError
from reference.state import Array
from reference.theory import windows
from reference.theory.windows import LOOKS, MOST, looked_to, windows_of

#: Where S has no negative eigenvalue, and where one of its entries is no number.
POSITIVE, NO_NUMBER = ((0.0, 1.0), (2.0, 3.0), (5.0, 7.0), (20.0, 24.0), (30.0, 1e9)), (20.0, 24.0)


def made(size: int = 2, **fields: Any) -> Any:
    """What is asked of a scheme on a system: S(dt), the damping in it, and where that is negative."""

    def matrix(dt: float, _: Any = None) -> Array:
        sign = 1.0 if any(low < dt < high for low, high in POSITIVE) else -1.0
        return np.array([[1.0, 0.0], [0.0, np.nan if NO_NUMBER[0] < dt < NO_NUMBER[1] else sign]])

    plain: dict[str, Any] = {
        "in_proportion": False,
        "linear": SimpleNamespace(mass=np.ones(size)),
        "matrix": matrix,
        "negative_damping_from": lambda last: np.inf,
        "damping_parts": lambda steps: [None] * len(steps),
    }
    return SimpleNamespace(**{**plain, **fields})


@pytest.fixture(autouse=True)
def drowned(monkeypatch: pytest.MonkeyPatch) -> None:
    """Steps of 100 s on are not looked at."""
    monkeypatch.setattr(windows, "drowned_from", lambda _: 100.0)


def test_windows_are_where_a_matrix_is_positive_again() -> None:
    """Not where it is no number; the last goes on to where one looks."""
    found = windows_of(made(), 1.0)
    assert np.array(found) == pytest.approx(np.array([[2.0, 3.0], [5.0, 7.0], [30.0, 100.0]]), rel=1e-6)
    assert len(windows_of(made(MOST), 1.0)) == 3


def test_none_is_looked_for_beyond_negative_damping() -> None:
    """What begins before goes on up to there."""
    found = windows_of(made(negative_damping_from=lambda last: 6.0), 1.0)
    assert np.array(found) == pytest.approx(np.array([[2.0, 3.0], [5.0, 6.0]]), rel=1e-6)
    assert windows_of(made(negative_damping_from=lambda last: 0.9), 1.0) == ()


def test_how_far_is_looked() -> None:
    """Up to a thousand times the first limit, and to where damping drowns all else; in so many steps."""
    assert looked_to(made(), 0.01) == 10.0
    assert looked_to(made(), 1.0) == 100.0
    seen: list[Array] = []
    windows_of(made(damping_parts=lambda steps: seen.append(steps) or [None] * len(steps)), 2.0)
    assert len(seen[0]) == LOOKS
    assert seen[0][[0, -1]] == pytest.approx([2.0, 100.0], rel=1e-5)


def test_where_none_are_looked_for() -> None:
    """Damping in proportion to dt, large systems, and steps that are not solved."""

    def unsolved(_: Array) -> None:
        raise SolverError("not solved")

    for one in (made(in_proportion=True), made(MOST + 1), made(damping_parts=unsolved)):
        assert windows_of(one, 1.0) == ()
