"""Live plots: energy, momentum and distance over the last seconds, a line for each lane."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.state import Array
from report.live.colours import LANE_COLOURS
from report.live.deferred_removal import DeferredRemoval
from report.live.recorder import Recorder

if TYPE_CHECKING:
    from viser import ClientHandle

#: What is shown: its title with its unit, its place among what is recorded, and whether it is its logarithm.
PLOTS = (
    ("energy gained since the start [{}J]", 0, False),
    ("momentum, off the true one's: log10 of kg m/s", 1, True),
    ("distance from the true motion: log10 of m", 2, True),
)

#: Parts and multiples of a unit, so that the numbers of an axis have few figures.
PREFIXES = {-12: "p", -9: "n", -6: "\N{MICRO SIGN}", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}

#: How much of the past is shown [s], and by how many points.
PAST, POINTS = 10.0, 240

#: Of logarithms nothing is smaller than rounding.
LEAST = 1e-16

#: Dashes tell the lanes apart without colours.
DASHES = ((), (8, 4), (2, 3), (8, 3, 2, 3))

#: An axis that has its zero, for uPlot: ticks a little apart, far from zero, would all read the same.
WITH_ZERO = {"pad": 0.1, "soft": 0, "mode": 1}


@dataclass(frozen=True)
class Drawn:
    """What a plot consists of. One that is to consist of something else is made anew.

    Attributes:
        title: with the unit.
        lines: the numbers of the lanes it has lines for, and their names.
    """

    title: str
    lines: tuple[tuple[int, str], ...]


class Plots:
    """A plot of everything that is known of some lane.

    Args:
        client: the viewer.
        room: where they go.
        removal: takes those that are no more.
    """

    def __init__(
        self, client: ClientHandle, room: Callable[[], AbstractContextManager[Any]], removal: DeferredRemoval
    ) -> None:
        self._client, self._room, self._removal = client, room, removal
        self._drawn: list[tuple[Drawn, Any] | None] = [None] * len(PLOTS)
        self._powers = 0

    def show(self, recorder: Recorder) -> None:
        """What has been measured last; after a reset, nothing."""
        times, numbers = recorder.last(PAST, POINTS)
        if len(times) < 2:
            for i in range(len(PLOTS)):
                self._hide(i)
            return
        for i, (title, place, log) in enumerate(PLOTS):
            values = numbers[:, :, place]
            if log:
                values = logarithms(values)
            else:
                values = values - recorder.begin[:, place]
                self._powers = power(values, self._powers)
                values = values / 10.0**self._powers
            known = np.flatnonzero(np.isfinite(values).any(axis=0)).tolist()
            wanted = Drawn(title.format(PREFIXES[self._powers]), tuple((k, recorder.names[k]) for k in known))
            self._show(i, wanted, (times, *np.ascontiguousarray(values.T[known])), log)

    def _show(self, i: int, wanted: Drawn, data: tuple[Array, ...], log: bool) -> None:
        drawn = self._drawn[i]
        if drawn is not None and drawn[0] == wanted:
            drawn[1].data = data
            return
        self._hide(i)
        if wanted.lines:
            self._drawn[i] = (wanted, self._plot(i, wanted, data, log))

    def _hide(self, i: int) -> None:
        drawn, self._drawn[i] = self._drawn[i], None
        if drawn is not None:
            self._removal.hide(drawn[1])

    def _plot(self, i: int, wanted: Drawn, data: tuple[Array, ...], log: bool) -> Any:
        lines = [
            {
                "label": name,
                "stroke": f"rgb{LANE_COLOURS[lane]}",
                "width": 2,
                "dash": DASHES[lane],
                "points": {"show": False},
            }
            for lane, name in wanted.lines
        ]
        scales: dict[str, Any] = {"x": {"time": False}}
        if not log:
            scales["y"] = {"range": {"min": WITH_ZERO, "max": WITH_ZERO}}
        with self._room():
            return self._client.gui.add_uplot(
                data=data,
                series=({"label": "t [s]"}, *lines),
                scales=scales,
                axes=({"label": "t [s]", "size": 36, "labelSize": 16}, {"size": 54}),
                legend={"live": False},
                title=wanted.title,
                height=190,
                padding=(12, 24, 0, 0),
                order=float(i),
            )


def logarithms(values: Array) -> Array:
    """To base ten; nothing but rounding is as small as the smallest that is more. Where unknown, NaN."""
    more = values[values > LEAST]
    return np.log10(np.maximum(values, more.min(initial=1.0)))


def power(values: Array, now: int) -> int:
    """The power of ten to divide by for the largest to have at most three figures; as it is now, if that will do."""
    most = float(np.abs(values).max(initial=0.0, where=np.isfinite(values)))
    if 0.2 * 10.0**now <= most < 1000 * 10.0**now:
        return now
    return next((p for p in PREFIXES if most < 1000 * 10.0**p), max(PREFIXES))
