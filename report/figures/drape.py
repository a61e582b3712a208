"""Drape coefficient against bending length; below, a limp cloth, one between, and a stiff one, and their shadows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import pi
from typing import Any

import numpy as np

from experiments.drape import DIRECTIONS, LENGTHS, RADIUS, SPACING, SUPPORT, folds, rows_of
from experiments.experiment import Result
from reference.scenes.drape import disc
from report.figures import COLOURS, NOTE, TITLE, Picture, few_ticks, look, new_figure

#: The bending lengths [m] of the cloths that are shown.
SHOWN = (LENGTHS[0], LENGTHS[2], LENGTHS[4])


def draw(result: Result) -> Picture:
    """A plot, three cloths and three shadows."""
    cloths = result.data["cloths"]
    figure, axes = new_figure(figsize=(11, 10), nrows=3, ncols=3, gridspec_kw={"height_ratios": (1.5, 1.2, 1)})
    for place in [*axes[0], *axes[1]]:
        place.remove()
    grid = place.get_gridspec()
    _coefficients(figure.add_subplot(grid[0, :]), cloths)
    shown = [one for c in SHOWN for one in cloths if _is(one, c)]
    for i, place in enumerate(axes[2]):
        if i >= len(shown):
            place.remove()
            continue
        _cloth(figure.add_subplot(grid[1, i], projection="3d"), shown[i])
        _shadow(place, shown[i])
    return Picture(figure, _alt(cloths))


def _is(one: Mapping[str, Any], length: float) -> bool:
    return (one["by"], one["length"], one["spacing"], one["sample"]) == ("kick_drift", length, SPACING, 0)


def _coefficients(axes: Any, cloths: Sequence[Mapping[str, Any]]) -> None:
    kinds = list(dict.fromkeys((one["spacing"], one["by"]) for one in cloths))
    for i, (spacing, by) in enumerate(kinds):
        alike = [one for one in cloths if (one["spacing"], one["by"]) == (spacing, by)]
        label = f"{by}, {1e3 * spacing:g} mm between masses"
        lengths, coefficients = ([one[name] for one in alike] for name in ("length", "coefficient"))
        size = 40 + 50 * (by != "kick_drift")
        style = look(i)
        hollow = {"facecolors": "none", "edgecolors": style["color"]} if by != "kick_drift" else {"c": style["color"]}
        axes.scatter(1e3 * np.array(lengths), coefficients, label=label, marker=style["marker"], s=size, **hollow)
    means = np.array(rows_of(cloths, SPACING))
    axes.plot(1e3 * means[:, 0], means[:, 1], color=COLOURS[0], zorder=0)
    axes.set_xscale("log")
    few_ticks(axes)
    axes.set_ylim(0, 1)
    axes.set_xlabel("bending length [mm]")
    axes.set_ylabel("drape coefficient, measured [1]")
    axes.legend(fontsize=NOTE, loc="upper left")


def _cloth(axes: Any, one: Mapping[str, Any]) -> None:
    """In space, seen from above and aside. As pixels: it is thousands of triangles."""
    x, y, z = 1e3 * one["positions"].T
    triangles = disc(RADIUS, one["spacing"], one["sample"]).triangles
    axes.plot_trisurf(x, z, y, triangles=triangles, color="#8fbbe0", linewidth=0, antialiased=False, rasterized=True)
    axes.set_box_aspect((2 * RADIUS, 2 * RADIUS, RADIUS - SUPPORT), zoom=1.4)
    axes.set_xlim(-1e3 * RADIUS, 1e3 * RADIUS)
    axes.set_ylim(-1e3 * RADIUS, 1e3 * RADIUS)
    axes.set_zlim(1e3 * (SUPPORT - RADIUS), 0)
    axes.view_init(elev=32, azim=-60)
    axes.set_axis_off()
    axes.set_title(f"bending length {1e3 * one['length']:g} mm", fontsize=TITLE)


def _shadow(axes: Any, one: Mapping[str, Any]) -> None:
    angles = np.linspace(-pi, pi, DIRECTIONS, endpoint=False)
    outline = 1e3 * np.asarray(one["outline"])
    axes.fill(outline * np.cos(angles), outline * np.sin(angles), color="#777777", linewidth=0)
    for radius, dash in ((SUPPORT, "-"), (RADIUS, ":")):
        axes.plot(1e3 * radius * np.cos(angles), 1e3 * radius * np.sin(angles), color="#D55E00", linestyle=dash)
    axes.set_aspect("equal")
    axes.set_xlabel("x [mm]")
    axes.set_ylabel("z [mm]")
    count, amplitude = folds(one["outline"])
    said = f"DC {one['coefficient']:.2f}, {count} folds of {1e3 * amplitude:.0f} mm"
    axes.set_title(said, fontsize=TITLE)


def _alt(cloths: Sequence[Mapping[str, Any]]) -> str:
    said = "; ".join(f"{1e3 * c:g} mm: {mean:.2f}" for c, mean, _ in rows_of(cloths, SPACING))
    return f"Drape coefficient by bending length: {said}. Below, draped cloths in space, and their shadows."
