"""The past of a lab: how far it goes back, and what is forgotten."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
import pytest

from reference.state import State
from report.live import history
from report.live.history import SECONDS, History, Moment


def moment(clock: float, time: float | None = None, masses: int = 2, reference: bool = False) -> Moment:
    """One of the past: one lane of masses in the plane."""
    state = State(clock, np.zeros((masses, 2)), np.zeros((masses, 2)))
    none = cast(Any, None)
    when = clock if time is None else time
    return Moment(clock, when, none, none, (state,), state if reference else None, none, None)


def kept(*moments: Moment) -> History:
    """A past of these."""
    made = History()
    for one in moments:
        made.keep(one)
    return made


def test_it_goes_back_some_seconds_of_the_clock() -> None:
    """A moment that is as old as it goes is still there."""
    assert History().seconds == 0
    assert History().back(1.0) is None
    made = kept(*map(moment, (0.0, 1.0, SECONDS)))
    assert (len(made), made.seconds) == (3, SECONDS)
    made.keep(moment(SECONDS + 0.5))
    assert (len(made), made.seconds) == (3, SECONDS - 0.5)
    made.keep(moment(99.0))
    assert (len(made), made.seconds) == (1, 0)


def test_it_takes_so_much_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of positions and velocities, the true motion's among them; the last moment stays, however large."""
    assert moment(0.0).bytes == 2 * 2 * 2 * 8
    assert moment(0.0, reference=True).bytes == 2 * moment(0.0).bytes
    monkeypatch.setattr(history, "BYTES", 3 * moment(0.0).bytes)
    made = kept(*map(moment, (0.0, 0.1, 0.2)))
    assert len(made) == 3
    made.keep(moment(0.3))
    assert (len(made), made.seconds) == (3, pytest.approx(0.2))
    made.keep(moment(0.4, masses=1000))
    assert len(made) == 1
    made.keep(moment(0.5))
    made.keep(moment(0.6))
    assert len(made) == 2
    monkeypatch.setattr(history, "BYTES", 3 * moment(0.0).bytes - 1)
    assert len(kept(*map(moment, (0.0, 0.1, 0.2)))) == 2


def test_one_goes_back_by_the_time_of_the_scene() -> None:
    """To the last moment that is not later; to the first where it does not go so far."""
    made = kept(*(moment(clock, time) for clock, time in ((0.0, 5.0), (1.0, 5.5), (2.0, 6.0), (3.0, 7.0))))
    for seconds, clock in ((0.0, 3.0), (0.5, 2.0), (1.0, 2.0), (1.2, 1.0), (2.0, 0.0), (99.0, 0.0)):
        found = made.back(seconds)
        assert found is not None
        assert found.clock == clock


def test_what_comes_after_is_forgotten(monkeypatch: pytest.MonkeyPatch) -> None:
    """A moment at that time stays; its memory is free again."""
    monkeypatch.setattr(history, "BYTES", 4 * moment(0.0).bytes)
    made = kept(*map(moment, (0.0, 1.0, 2.0, 3.0)))
    made.forget_after(1.0)
    assert (len(made), made.seconds) == (2, 1)
    for clock in (1.5, 1.6):
        made.keep(moment(clock))
    assert (len(made), made.seconds) == (4, 1.6)
    made.forget_after(-1.0)
    assert (len(made), made.seconds) == (0, 0)
