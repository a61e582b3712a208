"""A number slider: a number to be typed, with its unit, and a logarithmic slider beneath it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from reference.errors import InputError
from report.live.events import Later, handler
from report.live.slider_marks import set_marks

if TYPE_CHECKING:
    from viser import ClientHandle

#: Steps from one end of a slider to the other.
STEPS = 400


class NumberSlider:
    """A number and its slider.

    Args:
        client: whose.
        label: with the unit.
        value: to begin with.
        low, high: the ends of the slider, both > 0; what is typed may lie beyond.
        later: has what is to be done done between two frames.
        on_move: told of every new number then. What it refuses with an InputError is put back.
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
        later: Later,
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
        self._marked = self._marks(())
        self._number.on_update(handler(later, lambda value: self._move(float(value))))
        self._slider.on_update(handler(later, lambda places: self._move(self._value(places[0]))))

    def show(self, value: float) -> None:
        """Another value, without telling of it."""
        if value != self.value:
            self.value = value
            self._put()

    def mark(self, marks: Sequence[tuple[float, str]]) -> None:
        """Say something at some values, such as where the limit is."""
        wanted = self._marks(marks)
        if wanted != self._marked:
            self._marked = wanted
            set_marks(self._slider, wanted)

    @property
    def parts(self) -> tuple[Any, Any]:
        """What it consists of."""
        return self._number, self._slider

    def _move(self, value: float) -> None:
        if value == self.value:
            return
        before, self.value = self.value, value
        try:
            self._on_move(value)
        except InputError:
            self.value = before
            raise
        finally:
            self._put()

    def _put(self) -> None:
        self._number.value = self.value
        self._slider.value = (self._place(self.value),)

    def _place(self, value: float) -> int:
        if self._linear:
            part = value / self._high
        elif value <= 0:
            part = 0.0
        else:
            part = (math.log(value) - math.log(self._low)) / math.log(self._high / self._low)
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

    >>> short(104.0), short(0.00125), short(2e7), short(2.5e-5)
    ('100', '0.0013', '2e7', '2.5e-5')
    """
    rounded = float(f"{number:.2g}")
    if 1e-3 <= rounded < 1e4:
        return f"{rounded:g}"
    return f"{rounded:.1e}".replace(".0e", "e").replace("e+0", "e").replace("e-0", "e-")
