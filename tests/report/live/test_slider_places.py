"""Where a number is on its slider, what a place of the slider means, and what is marked beneath it."""

from __future__ import annotations

import math
from typing import Any

import pytest

from report.live.number_slider import STEPS, NumberSlider
from tests.report.live.panel import Panel, Part


def made(low: float, high: float, value: float = 1.0, **kind: bool) -> tuple[NumberSlider, Part, Part, list[float]]:
    """A number slider, its number, its slider, and what it has told of."""
    panel, told = Panel(), []  # type: ignore[var-annotated]
    slider = NumberSlider(panel.client, "number", value, low, high, lambda do: do(), told.append, **kind)
    return slider, panel.parts["number"], panel.parts["multi_slider"], told


@pytest.mark.parametrize(
    ("kind", "low", "high", "value", "place"),
    [
        ({}, 0.01, 100.0, 1.0, 0.5),
        ({}, 0.01, 100.0, 0.1, 0.25),
        ({}, 0.01, 100.0, 0.001, 0.0),
        ({}, 0.01, 100.0, 1e9, 1.0),
        ({"zero": True}, 0.01, 100.0, 0.0, 0.0),
        ({"zero": True}, 0.01, 100.0, 1e-9, 1 / STEPS),
        ({"zero": True}, 0.01, 100.0, 0.01, 1 / STEPS),
        ({"zero": True}, 0.01, 100.0, 10.0, 0.75),
        ({"linear": True}, 0.01, 40.0, 10.0, 0.25),
        ({"linear": True}, 0.01, 40.0, -5.0, 0.0),
        ({"linear": True}, 0.01, 40.0, 50.0, 1.0),
    ],
)
def test_a_number_has_its_place(kind: dict[str, bool], low: float, high: float, value: float, place: float) -> None:
    """By powers, or evenly; above zero it is never at the very left where that means zero."""
    _, number, slider, told = made(low, high, value=7.0, **kind)
    number.move(value)
    assert slider.value == (round(place * STEPS),)
    assert told == [value]


@pytest.mark.parametrize(
    ("kind", "place", "value"),
    [
        ({}, 0, 0.01),
        ({}, STEPS // 4, 0.1),
        ({}, STEPS, 100.0),
        ({"zero": True}, 0, 0.0),
        ({"zero": True}, STEPS // 2, 1.0),
        ({"linear": True}, 0, 0.0),
        ({"linear": True}, STEPS // 4, 25.0),
    ],
)
def test_a_place_means_its_number(kind: dict[str, bool], place: int, value: float) -> None:
    """In three figures; the number beside it shows it."""
    _, number, slider, told = made(0.01, 100.0, value=7.0, **kind)
    slider.move((place,))
    assert told == [pytest.approx(value)]
    assert number.value == pytest.approx(value)
    figures = made(0.01, 100.0, value=7.0)
    figures[2].move((STEPS // 3,))
    assert figures[3] == [float(f"{0.01 * 1e4 ** (STEPS // 3 / STEPS):.3g}")]


def test_what_is_there_already_is_told_to_nobody() -> None:
    """Nor what the page itself shows."""
    slider, number, place, told = made(0.01, 100.0, value=2.0)
    number.move(2.0)
    slider.show(30.0)
    assert (told, slider.value, number.value) == ([], 30.0, 30.0)
    assert place.value == (round(STEPS * (math.log10(30) + 2) / 4),)
    assert slider.parts == (number, place)


def marks(low: float, high: float, *at: float, **kind: bool) -> list[Any]:
    """Beneath a slider with something said at some numbers."""
    slider, *_ = made(low, high, **kind)
    slider.mark([(value, f"here {value:g}") for value in at])
    return list(slider._marked)


def test_ends_are_marked_where_nothing_else_lies_over_them() -> None:
    """Within a sixth of the slider of what is said there, they are left out; in order."""
    assert marks(0.01, 100.0) == [(0, "0.01"), (STEPS, "100")]
    assert marks(0.01, 100.0, 1.0) == [(0, "0.01"), (STEPS // 2, "here 1"), (STEPS, "100")]
    assert [text for _, text in marks(0.01, 100.0, 0.02)] == ["here 0.02", "100"]
    assert [text for _, text in marks(0.01, 100.0, 50.0, 0.02)] == ["here 0.02", "here 50"]
    assert [text for _, text in marks(1.0, 1e6, 9.0, 1.1e5)] == ["here 9", "here 110000"]
    assert [text for _, text in marks(1.0, 1e6, 11.0, 0.9e5)] == ["1", "here 11", "here 90000", "1e6"]
    for kind in ({"zero": True}, {"linear": True}):
        assert marks(0.01, 100.0, **kind)[0] == (0, "0")


@pytest.mark.parametrize(("low", "step"), [(1.0, 1e-4), (0.01, 1e-6), (0.02, 1e-6), (1e-12, 1e-12), (1e7, 1.0)])
def test_arrows_move_a_number_by_little(low: float, step: float) -> None:
    """A ten-thousandth of the least there is on the slider, or so; no finer than 1e-12, and never more than 1."""
    assert made(low, 1e4 * low, value=low)[1].step == pytest.approx(step)
