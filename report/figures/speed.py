"""Our kernels against tuned C on the same mesh, as a ratio of times."""

from __future__ import annotations

from collections.abc import Sequence

from experiments.experiment import Result
from experiments.speed import Timing
from report.figures import Picture, look, new_figure


def draw(result: Result) -> Picture:
    """A row per mesh, a mark for one thread and one for all; left of the line we are quicker than tuned C."""
    rows: Sequence[Timing] = [row for row in result.data["rows"] if row.ratio is not None]
    names = list(dict.fromkeys(row.what for row in rows))
    figure, axes = new_figure(figsize=(8.5, 1.6 + 0.32 * max(len(names), 1)))
    if not rows:
        axes.set_axis_off()
        axes.text(0, 0.5, "no ratios: there is no C compiler here")
        return Picture(
            figure, "There is no C compiler here to compare with, and so there are no ratios of times: 0 meshes."
        )
    for i, threads in enumerate(sorted({row.threads for row in rows})):
        some = [row for row in rows if row.threads == threads]
        label = f"{threads} thread{'s' if threads > 1 else ''}"
        axes.plot(
            [row.ratio for row in some],
            [names.index(row.what) for row in some],
            linestyle="none",
            label=label,
            **look(i),
        )
    axes.axvline(1, color="black", linewidth=1)
    axes.set_xscale("log")
    axes.set_xlabel("time of our kernel / time of tuned C on one thread [1]")
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2)
    worst = max((row.ratio or 0.0 for row in rows if row.threads == 1), default=0.0)
    return Picture(figure, f"Ratios of times to tuned C for {len(names)} meshes, on one thread at most {worst:.2f}.")
