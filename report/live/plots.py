"""Live plots: energy, momentum and distance over the last seconds, a line for each world."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from report.live.stage import WORLD_COLOURS

if TYPE_CHECKING:
    from viser import ClientHandle

    from report.live.lab import Lab

#: What is shown: its title, its place among the measures, and whether it is its logarithm.
PLOTS = (
    ("energy [J]", 0, False),
    ("momentum, off the true one's: log10 of kg m/s", 1, True),
    ("distance from the true motion: log10 of m", 2, True),
)

#: So much of the past [s], and so many points of it.
PAST, POINTS = 10.0, 240

#: Of logarithms nothing is smaller than rounding.
LEAST = 1e-16

#: Dashes tell the worlds apart without colours.
DASHES = ((), (8, 4), (2, 3), (8, 3, 2, 3))


class Plots:
    """Three plots, where the client's panels are just now.

    Args:
        client: the viewer.
        names: of the steppers, one for each world.
    """

    def __init__(self, client: ClientHandle, names: Sequence[str]) -> None:
        self._handles = [self._plot(client, names, title) for title, _, _ in PLOTS]

    def _plot(self, client: ClientHandle, names: Sequence[str], title: str) -> Any:
        nothing = np.array([0.0, 1.0])
        colours = [f"rgb{WORLD_COLOURS[i]}" for i in range(len(names))]
        lines = [
            {"label": name, "stroke": colours[i], "width": 2, "dash": DASHES[i], "spanGaps": False}
            for i, name in enumerate(names)
        ]
        return client.gui.add_uplot(
            data=(nothing, *(np.zeros(2) for _ in names)),
            series=({"label": "t [s]"}, *lines),
            scales={"x": {"time": False}},
            axes=({"label": "t [s]", "size": 36, "labelSize": 16}, {"size": 66}),
            title=title,
            height=190,
        )

    def show(self, lab: Lab) -> None:
        """What has been measured last."""
        times, numbers = lab.measures.last(PAST, POINTS)
        if len(times) < 2:
            return
        for handle, (_, place, log) in zip(self._handles, PLOTS, strict=True):
            values = [numbers[:, i, place] for i in range(numbers.shape[1])]
            handle.data = (times, *(np.log10(np.maximum(v, LEAST)) if log else v for v in values))

    def remove(self) -> None:
        """Take them away."""
        for handle in self._handles:
            handle.remove()
