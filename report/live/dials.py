"""A dial: a number to be typed, with its unit, and a logarithmic slider beneath it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from viser import ClientHandle

#: A slider goes in so many steps.
STEPS = 400


class Dial:
    """A number and its slider.

    Args:
        client: whose.
        label: with the unit.
        value: to begin with.
        low, high: the ends of the slider, both > 0; what is typed may lie beyond.
        on_move: told of every new number.
        zero: whether the left end of the slider means 0.
        linear: whether the slider is not logarithmic; then it goes from 0.
    """

    def __init__(
        self,
        client: ClientHandle,
        label: str,
        value: float,
        low: float,
        high: float,
        on_move: Callable[[float], None],
        zero: bool = False,
        linear: bool = False,
    ) -> None:
        self._low, self._high, self._zero, self._linear, self._on_move = low, high, zero, linear, on_move
        self.value = value
        digits = min(max(0, math.ceil(-math.log10(low)) + 4), 12)
        self._number = client.gui.add_number(label, initial_value=value, step=10.0**-digits)
        self._slider = client.gui.add_multi_slider(
            " ", min=0, max=STEPS, step=1, initial_value=(self._place(value),), marks=self._marks(())
        )
        self._number.on_update(lambda event: self._typed(event))
        self._slider.on_update(lambda event: self._slid(event))

    def show(self, value: float) -> None:
        """Another value, without telling of it."""
        if value != self.value:
            self.value = value
            self._number.value = value
            self._slider.value = (self._place(value),)

    def mark(self, marks: Sequence[tuple[float, str]]) -> None:
        """Say something at some values, such as where the limit is."""
        wanted = self._marks(marks)
        if wanted != getattr(self, "_marked", None):
            from viser._gui_api import _build_slider_marks

            self._marked = wanted
            self._slider._marks = _build_slider_marks(wanted)

    def remove(self) -> None:
        """Take it away."""
        self._number.remove()
        self._slider.remove()

    def _typed(self, event: Any) -> None:
        # What the page itself has set comes back without a client.
        if event.client is not None and self._number.value != self.value:
            self.value = float(self._number.value)
            self._slider.value = (self._place(self.value),)
            self._on_move(self.value)

    def _slid(self, event: Any) -> None:
        if event.client is None:
            return
        value = self._value(self._slider.value[0])
        if value != self.value:
            self.value = value
            self._number.value = value
            self._on_move(value)

    def _place(self, value: float) -> int:
        if self._linear:
            part = value / self._high
        elif value <= 0:
            part = 0.0
        else:
            part = math.log(value / self._low) / math.log(self._high / self._low)
            part = max(part, 1 / STEPS) if self._zero else part
        return round(STEPS * min(max(part, 0.0), 1.0))

    def _value(self, place: float) -> float:
        if self._linear:
            return float(f"{self._high * place / STEPS:.3g}")
        if place == 0 and self._zero:
            return 0.0
        return float(f"{self._low * (self._high / self._low) ** (place / STEPS):.3g}")

    def _marks(self, marks: Sequence[tuple[float, str]]) -> tuple[tuple[int, str], ...]:
        """The ends and what is said, the ends left out where they would lie under it."""
        said = [(self._place(value), text) for value, text in marks]
        ends = [(0, "0" if self._zero or self._linear else short(self._low)), (STEPS, short(self._high))]
        kept = [end for end in ends if all(abs(end[0] - place) > STEPS / 6 for place, _ in said)]
        return tuple(sorted([*kept, *said]))


def short(number: float) -> str:
    """A number in two figures.

    >>> short(104.0), short(0.00125), short(2e7)
    ('100', '0.0013', '2e7')
    """
    return f"{float(f'{number:.2g}'):g}".replace("e+0", "e")
