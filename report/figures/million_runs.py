"""The time a million runs take, against the cores they run on."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from experiments.experiment import Result
from experiments.million_runs import CORES, Hand, Kind, in_words, predicted
from report.figures import NOTE, Picture, look, new_figure


def draw(result: Result) -> Picture:
    """A line per kind of run, falling with the cores until it meets the floor of what is done one after another."""
    kinds: Sequence[Kind] = sorted(result.data["kinds"], key=lambda kind: -kind.seconds)
    hands: Sequence[Hand] = result.data["hands"]
    figure, axes = new_figure(figsize=(9, 5))
    cores = np.geomspace(1, 10 * max(CORES))
    for i, kind in enumerate(kinds):
        style = look(i)
        axes.plot(cores, [predicted(kind, hands, n) / 3600 for n in cores], color=style["color"])
        hours = [predicted(kind, hands, n) / 3600 for n in CORES]
        axes.plot(CORES, hours, linestyle="none", label=f"{kind.name}: {1e3 * kind.seconds:.0f} ms", **style)
    floor = predicted(kinds[-1], hands, cores[-1]) / 3600
    text = "flat: the one process that hands out tasks and keeps results"
    axes.annotate(text, (cores[-1], 0.9 * floor), ha="right", va="top", fontsize=NOTE)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(bottom=floor / 2)
    axes.set_xlabel("cores [1]")
    axes.set_ylabel("predicted time of a million runs [h]")
    axes.legend(title="a run, measured", loc="upper right")
    slowest = kinds[0]
    times = ", ".join(f"{in_words(predicted(slowest, hands, n))} on {n}" for n in CORES)
    return Picture(
        figure, f"Predicted time of a million runs against cores, {len(kinds)} kinds; {slowest.name}: {times}."
    )
