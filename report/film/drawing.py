"""A system drawn on axes: springs coloured by strain, what is near in front; masses, what holds them, obstacles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from reference.springs.breaking import without_force
from reference.state import Array
from reference.system import BoolArray, MassSpringSystem
from report.figures import NOTE, SMALL
from report.film.obstacle_image import HIDDEN, ObstacleImage
from report.film.view import View, Window

#: Pushed together, as it should be, pulled apart: blue and orange are told apart by everyone, in print and on black.
STRAIN_COLOURS = ((0, "#00429d"), (0.38, "#4a9be0"), (0.5, "#a6a6a6"), (0.62, "#f5923e"), (1, "#a32a00"))

#: Systems of more masses are drawn without dots, in thinner lines.
FEW = 30

#: What is farthest away is drawn in this part of its colour and of its width.
FAR = 0.45

#: In large systems springs longer than the shortest, such as go across cells, are thinner, but not below this part.
THINNEST = 0.3

#: Strain of this part of all springs is within the colours; the rest has those of the ends.
WITHIN = 0.98


@dataclass(frozen=True, eq=False)
class Look:
    """What the panels of one picture have in common.

    Attributes:
        view: where one looks from.
        window: what is seen.
        most: the strain at both ends of the colours, 0.1 for 10 %.
        depths: how near to the eye the nearest and the farthest is [m].
        obstacles: behind the springs.
    """

    view: View
    window: Window
    most: float
    depths: tuple[float, float]
    obstacles: ObstacleImage | None


@dataclass(frozen=True, eq=False)
class Lines:
    """The springs at one time as they are drawn, the farthest first.

    Attributes:
        segments: their ends in the picture [m], shape (s, 2, 2).
        colours: red, green, blue, opacity, shape (s, 4), 0 to 1.
        widths: [points], shape (s,).
        hidden: which an obstacle hides, shape (s,).
    """

    segments: Array
    colours: Array
    widths: Array
    hidden: BoolArray


def strain(system: MassSpringSystem, positions: Array) -> Array:
    """Of every spring, length over rest length less one, shape (..., s), at positions (..., n, d) [m]."""
    a, b = system.springs.T
    with np.errstate(over="ignore", invalid="ignore"):
        length = np.linalg.norm(positions[..., b, :] - positions[..., a, :], axis=-1)
        return np.asarray(length / _natural(system) - 1)


def _natural(system: MassSpringSystem) -> Array:
    """Rest lengths [m], and where one is zero, the length at the start or the scene's size, shape (s,)."""
    a, b = system.springs.T
    start = np.linalg.norm(system.positions[b] - system.positions[a], axis=1)
    at_least = np.where(start > 0, start, system.scale)
    return np.where(system.rest_lengths > 0, system.rest_lengths, at_least)


def colour_map() -> Any:
    """From strain, mapped to 0 to 1, to colours."""
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list("strain", STRAIN_COLOURS)


def lines(system: MassSpringSystem, positions: Array, look: Look, colours: Any) -> Lines:
    """The springs of a system at positions (n, d) [m], by the colours of `colour_map`, but for those without force."""
    places, depth = look.view.project(positions)
    near = depth[system.springs].mean(axis=1)
    order = np.argsort(near, kind="stable")
    order = order[~without_force(system)[order]]
    ends, near = places[system.springs[order]], near[order]
    widths = _widths(system)[order]
    far, close = look.depths
    with np.errstate(over="ignore", invalid="ignore"):
        shade = colours(0.5 + strain(system, positions)[order] / (2 * look.most))
        if close > far:
            clear = FAR + (1 - FAR) * np.clip(np.nan_to_num((near - far) / (close - far)), 0, 1)
            shade[:, 3], widths = clear, widths * clear
        middles = ends.mean(axis=1)
    slack = HIDDEN * look.view.distance
    hidden = look.obstacles.hides(middles, near, slack) if look.obstacles else np.zeros(len(ends), bool)
    return Lines(_within_reach(ends, look.window), shade, widths, hidden)


def _widths(system: MassSpringSystem) -> Array:
    """Of the springs where they are nearest [points], shape (s,)."""
    lengths = _natural(system)
    if len(system.masses) <= FEW:
        return np.full(len(lengths), 2.2)
    most = 1.6 if len(lengths) < 1000 else 0.9
    return np.asarray(most * np.clip((lengths.min() / lengths) ** 2, THINNEST, 1))


def scale_of(system: MassSpringSystem, positions: Array, seen: BoolArray | None = None) -> float:
    """The strain for both ends of the colours, for positions (m, n, d) [m].

    Args:
        seen: which springs are drawn at which time, shape (m, s); all where left out.
    """
    found = np.abs(strain(system, positions))
    found = found if seen is None else found[seen]
    return nice(max(float(np.quantile(found, WITHIN)) if found.size else 0.0, 1e-6))


def _within_reach(places: Array, window: Window) -> Array:
    """Places not so far away that numbers of a drawing run over."""
    reach = 1e3 * max(window[1] - window[0], window[3] - window[2])
    return np.clip(places, -reach + np.array([window[0], window[2]]), reach + np.array([window[1], window[3]]))


class Drawing:
    """A system on axes, to be shown at one time after another.

    Attributes:
        behind, front: the collections of springs that an obstacle hides, and of the others.
    """

    def __init__(self, axes: Any, system: MassSpringSystem, look: Look) -> None:
        from matplotlib.collections import LineCollection

        self._fixed, self._look, self._colours = system.fixed, look, colour_map()
        few = len(system.masses) <= FEW
        self._true: Any = LineCollection([], zorder=0.5, capstyle="round", linewidths=5, color="#d9d9d9")
        self.behind: Any = LineCollection([], zorder=1, capstyle="round")
        self.front: Any = LineCollection([], zorder=3, capstyle="round")
        for collection in (self._true, self.behind, self.front):
            axes.add_collection(collection)
        (self.masses,) = axes.plot([], [], linestyle="", marker="o", markersize=3.5, color="#222222", zorder=4)
        size = 6 if system.fixed.sum() <= 4 else 3.5
        (self.held,) = axes.plot([], [], linestyle="", marker="s", markersize=size, color="#222222", zorder=4)
        self.masses.set_visible(few)
        if look.obstacles is not None:
            axes.imshow(
                look.obstacles.image, extent=look.obstacles.window, origin="lower", zorder=2, interpolation="bilinear"
            )
        axes.set_aspect("equal")
        axes.set_xlim(look.window[:2])
        axes.set_ylim(look.window[2:])
        axes.set_xticks([])
        axes.set_yticks([])
        axes.grid(visible=False)
        for spine in axes.spines.values():
            spine.set(visible=True, color="#cccccc", linewidth=0.8)

    def show(
        self, positions: Array, system: MassSpringSystem, true: tuple[Array, MassSpringSystem] | None = None
    ) -> None:
        """Draw the system, as it is now, at positions (n, d) [m]; what is not finite, or broken, is not drawn.

        Args:
            true: where it should be, and as what, drawn behind it.
        """
        if true is not None:
            there = true[1].springs[~without_force(true[1])]
            self._true.set_segments(self._look.view.project(true[0])[0][there])
        drawn = lines(system, positions, self._look, self._colours)
        for collection, chosen in ((self.behind, drawn.hidden), (self.front, ~drawn.hidden)):
            collection.set_segments(drawn.segments[chosen])
            collection.set_color(drawn.colours[chosen])
            collection.set_linewidths(drawn.widths[chosen])
        places = _within_reach(self._look.view.project(positions)[0], self._look.window)
        self.masses.set_data(*places[~self._fixed].T)
        self.held.set_data(*places[self._fixed].T)


def nice(value: float) -> float:
    """The nearest of 1, 2 and 5 times a power of ten that is not below a number > 0.

    >>> nice(0.013), nice(0.2), nice(7.0)
    (0.02, 0.2, 10.0)
    """
    power = 10.0 ** np.floor(np.log10(value))
    return float(next(f * power for f in (1, 2, 5, 10) if f * power >= value * (1 - 1e-9)))


def add_length(axes: Any, window: Window) -> None:
    """A bar in the lower left corner that says how long it is [m]."""
    left, right, bottom, top = window
    length = nice((right - left) / 10)
    x, y = left + 0.04 * (right - left), bottom + 0.04 * (top - bottom)
    axes.plot([x, x + length], [y, y], color="#444444", linewidth=2, solid_capstyle="butt", zorder=5)
    beside: dict[str, Any] = {"textcoords": "offset points", "va": "center", "fontsize": SMALL, "color": "#444444"}
    axes.annotate(f"{length:g} m", (x + length, y), (4, 0), zorder=5, **beside)


def add_strain_bar(
    figure: Any, axes: Any, most: float, label: str = "strain [%]: pushed together (-), pulled apart (+)"
) -> None:
    """The colours of strain, in percent, on axes of their own."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    bar = figure.colorbar(ScalarMappable(Normalize(-100 * most, 100 * most), colour_map()), cax=axes, extend="both")
    bar.set_label(label, fontsize=NOTE)
    bar.ax.tick_params(labelsize=NOTE)
    bar.ax.grid(visible=False)
    bar.outline.set_visible(False)
