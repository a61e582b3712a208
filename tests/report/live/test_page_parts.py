"""Parts of the page without a browser: events in their order, number sliders, numbers on axes, deferred removal."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable, Coroutine
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest

from reference.errors import InputError
from report.live.deferred_removal import LATER, DeferredRemoval
from report.live.events import handler
from report.live.number_slider import STEPS, NumberSlider
from report.live.plots import PREFIXES, logarithms, power
from report.live.slider_marks import set_marks


def test_events_are_handled_in_their_order_with_the_value_of_then() -> None:
    """And what the page has set itself is not among them."""
    done: list[object] = []
    waiting: list[Callable[[], None]] = []
    hear = handler(waiting.append, done.append)
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


class Box:
    """A number or a slider as viser has them: something with a value, that is moved by hand."""

    def __init__(self, value: object) -> None:
        self.value, self.client = value, "viewer"

    def on_update(self, told: Callable[[object], Coroutine[object, object, None]]) -> None:
        """Remember who is to be told."""
        self._told = told

    def move(self, value: object) -> None:
        """As a viewer does."""
        self.value = value
        asyncio.run(self._told(SimpleNamespace(client="viewer", target=self)))  # type: ignore[arg-type]


def test_a_number_slider_has_its_new_value_when_it_is_told_of_and_its_old_one_if_that_is_refused() -> None:
    """Number and slider show the same, in the end; whoever looks at it meanwhile sees what was asked for."""
    made: list[Box] = []

    def add(*_: object, initial_value: object, **__: object) -> Box:
        made.append(Box(initial_value))
        return made[-1]

    def moved(value: float) -> None:
        seen.append((value, shown.value))
        if value == 7.0:
            raise InputError("not seven")

    seen: list[tuple[float, float]] = []
    client = SimpleNamespace(gui=SimpleNamespace(add_number=add, add_multi_slider=add))
    waiting: list[Callable[[], None]] = []
    shown = NumberSlider(client, "dt [ms]", 1.0, 0.01, 100.0, waiting.append, moved)  # type: ignore[arg-type]
    number, slider = made
    number.move(10.0)
    waiting.pop()()
    assert (seen, shown.value, number.value) == ([(10.0, 10.0)], 10.0, 10.0)
    assert slider.value == (STEPS * 3 // 4,)  # three of four decades
    number.move(7.0)
    with pytest.raises(InputError):
        waiting.pop()()
    assert (seen[-1], shown.value, number.value) == ((7.0, 7.0), 10.0, 10.0)


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
    monkeypatch.setattr("report.live.deferred_removal.time.monotonic", lambda: clock[0])
    part = SimpleNamespace(visible=True, remove=lambda: removed.append(clock[0]))
    removal = DeferredRemoval()
    removal.hide(part)
    assert not part.visible
    for clock[0] in (100.0, 99.9 + LATER, 100.1 + LATER, 200.0 + LATER):
        removal.remove_old()
    assert removed == [100.1 + LATER]


def test_marks_can_be_set_with_the_viser_there_is() -> None:
    """At a slider of viser's own, in place of those it was made with."""
    slider = SimpleNamespace(_marks=())
    assert set_marks(slider, [(3, "▲"), (400, "end")])
    assert [(mark.value, mark.label) for mark in slider._marks] == [(3.0, "▲"), (400.0, "end")]  # type: ignore[attr-defined]


def test_a_viser_without_a_way_to_set_marks_costs_the_marks_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither its function nor its attribute is there: nothing is set, and nothing is raised."""
    slider = SimpleNamespace(value=1)
    assert not set_marks(slider, [(3, "▲")])
    monkeypatch.setitem(sys.modules, "viser._gui_api", ModuleType("viser._gui_api"))
    slider = SimpleNamespace(_marks="as it was")
    assert not set_marks(slider, [(3, "▲")])
    assert slider._marks == "as it was"
