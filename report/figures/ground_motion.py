"""How far a bridge sways by the frequency it is shaken at, and how far a truck that crosses sinks its middle."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from experiments.experiment import Result
from experiments.ground_motion import DT, SPEEDS, SWEEP, Ran, off_the_line, peak
from reference.state import Array
from reference.system import IntArray
from report.figures import COLOURS, MARKERS, NOTE, SMALL, Picture, look, new_figure

#: What is predicted lies on what is measured, and is dotted so that both can be seen.
PREDICTED = {"color": "#333333", "linewidth": 1.2, "linestyle": ":"}

#: The axis of the sways goes this many times as far as these, for the legend's sake.
HEADROOM = 1.5


def draw(result: Result) -> Picture:
    """Two plots."""
    figure, (sway, truck) = new_figure(figsize=(11, 4.8), ncols=2)
    rows: Mapping[str, Ran] = result.data["rows"]
    _draw_sway(sway, rows, result.data["natural"], result.data["linear"])
    _draw_truck(truck, rows, result.data["line"])
    return Picture(figure, _alt(result))


def crests(motion: Array) -> IntArray:
    """The numbers of the frames at which a motion is as far from rest as it gets in each half swing."""
    size = np.abs(motion)
    return np.asarray(np.flatnonzero((size[1:-1] >= size[:-2]) & (size[1:-1] > size[2:])) + 1, dtype=np.int64)


def _draw_sway(axes: Any, rows: Mapping[str, Ran], natural: Array, linear: Array) -> None:
    at = crests(linear)
    axes.plot(
        SWEEP.frequency(at * DT), 1e3 * np.abs(linear[at]), label="linear bridge, predicted", zorder=5, **PREDICTED
    )
    for frequency in natural:
        axes.axvline(frequency, color="#999999", linewidth=1)
        says = f"natural frequency, predicted: {frequency:.2f} Hz"
        axes.text(frequency, 1.01, says, transform=axes.get_xaxis_transform(), fontsize=NOTE, ha="center")
    for i, (name, ran) in enumerate(rows.items()):
        at = crests(ran.shaken)
        frequencies = SWEEP.frequency(at * DT)
        axes.plot(
            frequencies,
            1e3 * np.abs(ran.shaken[at]),
            label=name,
            linewidth=3.2 - 0.5 * i,
            markevery=(2 * i, 10),
            **look(i),
        )
    axes.set_xlabel("frequency of the ground [Hz]")
    axes.set_ylabel("amplitude of the sway of the middle [mm]")
    axes.set_ylim(0, HEADROOM * 1e3 * max(np.abs(sway).max() for sway in (linear, *(r.shaken for r in rows.values()))))
    axes.legend(fontsize=SMALL, loc="upper right")


def _draw_truck(axes: Any, rows: Mapping[str, Ran], line: tuple[Array, Array]) -> None:
    axes.plot(line[0], 1e3 * line[1], label="influence line: it stands there, predicted", zorder=5, **PREDICTED)
    for i, speed in enumerate(SPEEDS):
        for k, ran in enumerate(rows.values()):
            sag = ran.crossed[speed]
            places = speed * DT * np.arange(len(sag))
            style = {"color": COLOURS[i], "marker": MARKERS[i], "markersize": 4, "linewidth": 1.2}
            spread = max(1, len(sag) // 8)
            label = f"crosses at {speed:g} m/s, {len(rows)} steppers" if k == 0 else None
            axes.plot(places, 1e3 * sag, label=label, markevery=(k * spread // max(1, len(rows)), spread), **style)
    axes.invert_yaxis()
    axes.set_xlabel("position of the truck [m]")
    axes.set_ylabel("sag of the middle [mm]")
    axes.legend(fontsize=SMALL)


def _alt(result: Result) -> str:
    rows, line = result.data["rows"], result.data["line"]
    natural = ", ".join(f"{f:.2f}" for f in result.data["natural"])
    peaks = {"predicted": peak(result.data["linear"]), **{name: peak(ran.shaken) for name, ran in rows.items()}}
    sways = "; ".join(f"{name} at {at:.2f} Hz, by {1e3 * by:.0f} mm" for name, (at, by) in peaks.items())
    off = "; ".join(
        f"{name} at {speed:g} m/s: {100 * off_the_line(sag, speed, line):.0f} %"
        for name, ran in rows.items()
        for speed, sag in ran.crossed.items()
    )
    return (
        f"A bridge on ground that shakes ever faster sways most: {sways}; its natural frequencies, predicted: "
        f"{natural} Hz. A truck that crosses takes its middle off the influence line by, of the largest sag: {off}."
    )
