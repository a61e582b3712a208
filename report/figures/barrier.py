"""Where a mass leaves a circle, and how deep it sinks in, against dt; below, strings on the scene's circle."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from experiments.barrier import OWN, STEPS, Slide, predicted
from experiments.experiment import Result
from reference.obstacles import Circle
from reference.state import Trajectory
from report.figures import COLOURS, NOTE, SMALL, Picture, few_ticks, from_nothing, look, new_figure
from report.figures.filmstrip import Strip, draw_row

#: When the string is drawn [s], and how far a frame reaches to either side of the anchor, below and above it [m].
TIMES = (0.1, 0.3, 0.5, 0.7, 0.9)
FRAME = (1.35, 1.4, 0.15)

#: What is drawn in the first row of the film.
RULES = ("heun", "kick_drift", "lecture_barrier")

#: Where a depth of nothing is drawn, which has no place on a logarithmic axis [m].
FLOOR = 1e-17


def draw(result: Result) -> Picture:
    """Two plots, and two rows of a film."""
    figure, axes = new_figure(figsize=(11, 9.5), nrows=3, ncols=2, gridspec_kw={"height_ratios": (2.2, 1, 1)})
    angles, depths = axes[0]
    for i, (label, found) in enumerate(_alike(result.data["slides"]).items()):
        again = {"linestyle": "--" if i >= len(COLOURS) else "-"}  # colours begin anew: so do their lines, in dashes
        last = [np.nan if slide is None else np.degrees(slide.last) for slide in found]
        deep = [np.nan if slide is None else max(slide.depth, FLOOR) for slide in found]
        angles.plot(STEPS, last, label=label, **look(i), **again)
        depths.plot(STEPS, deep, **look(i), **again)
    for fraction, says in ((2 / 3, "cos = 2/3: true"), (1 / 2, "cos = 1/2: held on")):
        height = np.degrees(predicted(fraction=fraction))
        angles.axhline(height, color="#333333", linewidth=1, linestyle=":")
        angles.text(STEPS[-1], height + 1.2, f"predicted, {says}", fontsize=NOTE)
    angles.set_ylim(0, 70)
    angles.set_ylabel("angle from the top where it leaves, or is in the end [deg]")
    depths.set_ylabel("deepest inside [m]")
    depths.set_yscale("log")
    for plot in (angles, depths):
        plot.set_xscale("log")
        plot.set_xlabel("dt [s]")
        few_ticks(plot)
    from_nothing(depths.yaxis, FLOOR)
    angles.legend(fontsize=SMALL, loc="center right", bbox_to_anchor=(1.0, 0.35))
    strings = result.data["strings"]
    _film(_row(figure, axes, 1), {name: strings[name] for name in RULES if name in strings}, result.data["circle"])
    engines = {name: strings[name] for name, rule in result.data["slides"] if rule == OWN and name in strings}
    _film(_row(figure, axes, 2), engines, result.data["circle"])
    return Picture(figure, _alt(result))


def _alike(slides: Mapping[tuple[str, str], Sequence[Slide | None]]) -> dict[str, Sequence[Slide | None]]:
    """What was measured, under the names of all for whom it is the same to five figures."""
    names: dict[str, list[str]] = {}
    kept: dict[str, Sequence[Slide | None]] = {}
    for (name, rule), found in slides.items():
        numbers = repr([None if s is None else (f"{s.last:.4e}", f"{s.depth:.4e}", s.angle is None) for s in found])
        names.setdefault(numbers, []).append(name if rule == OWN else f"{name}: {rule}")
        kept.setdefault(numbers, found)
    return {", ".join(names[numbers]).replace(", ", ",\n"): found for numbers, found in kept.items()}


def _row(figure: Any, axes: Any, row: int) -> Any:
    """Both places of a row as one."""
    for place in axes[row]:
        place.remove()
    return figure.add_subplot(place.get_gridspec()[row, :])


def _film(axes: Any, motions: Mapping[str, Trajectory], circle: Circle) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Circle as Disc

    styles: dict[str, dict[str, Any]] = {
        name: {"linewidth": 1.0, "markersize": 3, **look(i)} for i, name in enumerate(motions)
    }
    strips = [Strip(motion, styles[name]) for name, motion in motions.items()]
    draw_row(axes, strips, TIMES, FRAME)
    for i in range(len(TIMES)):
        x, y = circle.centre
        axes.add_patch(Disc((2 * FRAME[0] * i + x, y), circle.radius, color="#dddddd", zorder=0))
    handles = [Line2D([], [], label=name, **style) for name, style in styles.items()]
    axes.legend(handles=handles, fontsize=SMALL, loc="upper left", bbox_to_anchor=(1.0, 1.15))


def _alt(result: Result) -> str:
    parts = []
    for (name, rule), found in result.data["slides"].items():
        slide = found[-1]
        if slide is not None:
            verb = "leaves at" if slide.angle is not None else "stays on, at"
            parts.append(f"{name} ({rule}) {verb} {np.degrees(slide.last):.1f} degrees, {slide.depth:.1e} m inside")
    return (
        f"Where a mass leaves a circle, predicted {np.degrees(predicted()):.1f} degrees, at the smallest step: "
        + "; ".join(parts)
        + ". Below, strings on a circle at several times."
    )
