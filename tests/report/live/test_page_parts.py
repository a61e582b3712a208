"""Parts of the page without a browser: moves in their order, numbers on axes, parts that go."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest

from report.live.leaving import LATER, Leaving
from report.live.moves import heard
from report.live.plots import PREFIXES, logarithms, power


def test_moves_are_done_in_their_order_with_the_value_of_then() -> None:
    """And what the page has set itself is not among them."""
    done: list[object] = []
    waiting: list[Callable[[], None]] = []
    hear = heard(waiting.append, done.append)
    target = SimpleNamespace(value=0)

    async def move() -> None:
        for value, client in ((1, "viewer"), (2, None), (3, "viewer")):
            target.value = value
            await hear(SimpleNamespace(client=client, target=target))

    asyncio.run(move())
    assert done == []
    for action in waiting:
        action()
    assert done == [1, 3]


@pytest.mark.parametrize("size", [3e-14, 2e-7, 5e-3, 0.7, 123.0, 4.5e4, 8e9])
def test_numbers_on_an_axis_have_at_most_three_figures(size: float) -> None:
    """Whatever was there before; and what will do stays as it is, so that the unit does not flicker."""
    values = np.array([[0.0, np.nan], [-size, size / 2]])
    for now in PREFIXES:
        chosen = power(values, now)
        assert size / 10.0**chosen < 1000
        assert size / 10.0**chosen >= 0.2 or chosen == min(PREFIXES)
        assert power(values, chosen) == chosen


def test_of_logarithms_nothing_is_below_rounding() -> None:
    """A distance of 0, at the start, is as small as the smallest there is; what is unknown stays so."""
    found = logarithms(np.array([[0.0, np.nan], [1e-6, np.nan], [1e-3, np.nan]]))
    np.testing.assert_allclose(found[:, 0], [-6, -6, -3])
    assert np.isnan(found[:, 1]).all()
    assert np.isfinite(logarithms(np.zeros((3, 1)))).all()


def test_what_goes_is_hidden_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """And removed once, when it has been for long enough."""
    clock, removed = [100.0], []
    monkeypatch.setattr("report.live.leaving.time.monotonic", lambda: clock[0])
    part = SimpleNamespace(visible=True, remove=lambda: removed.append(clock[0]))
    leaving = Leaving()
    leaving.hide(part)
    assert not part.visible
    for clock[0] in (100.0, 99.9 + LATER, 100.1 + LATER, 200.0 + LATER):
        leaving.remove_old()
    assert removed == [100.1 + LATER]
