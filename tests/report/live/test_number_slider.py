"""Number sliders without a browser, and the marks beneath them."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable, Coroutine
from types import ModuleType, SimpleNamespace

import pytest

from reference.errors import InputError
from report.live.number_slider import STEPS, NumberSlider, short
from report.live.slider_marks import set_marks


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


@pytest.mark.parametrize(("value", "place"), [(5e-324, 0), (1e-310, 0), (200.0, STEPS // 2), (1e300, STEPS)])
def test_any_number_has_its_place(value: float, place: int) -> None:
    """What is typed may lie as far beyond the slider as floats go."""
    made: list[Box] = []

    def add(*_: object, initial_value: object, **__: object) -> Box:
        made.append(Box(initial_value))
        return made[-1]

    client = SimpleNamespace(gui=SimpleNamespace(add_number=add, add_multi_slider=add))
    NumberSlider(client, "stiffness", 200.0, 2.0, 20_000.0, lambda do: do(), lambda _: None)  # type: ignore[arg-type]
    number, slider = made
    number.move(value)
    assert slider.value == (place,)


@pytest.mark.parametrize(
    ("number", "said"),
    [
        (104.0, "100"),
        (9949.0, "9900"),
        (9999.0, "1e4"),
        (1e-3, "0.001"),
        (9.9e-4, "9.9e-4"),
        (0.00125, "0.0013"),
        (2e7, "2e7"),
    ],
)
def test_a_mark_is_a_number_in_two_figures(number: float, said: str) -> None:
    """With a power of ten below a thousandth and from ten thousand on."""
    assert short(number) == said


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
