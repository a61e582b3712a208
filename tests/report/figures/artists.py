"""What a figure shows, read from Matplotlib's artists: labels, data, colours, and whether all of it can be seen."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations, pairwise
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import LineCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.text import Annotation, Text
from matplotlib.transforms import Bbox

from reference.state import Array
from report.figures import STYLE

#: Texts may be this much over one another [pixels]: boxes of letters are larger than the letters.
SLACK = 2.0


def laid_out(figure: Figure) -> Figure:
    """The figure with everything where it will be when it is drawn."""
    with rc_context(STYLE):
        figure.draw_without_rendering()
    return figure


# --- Words ---


def words(axes: Axes) -> list[str]:
    """Texts and annotations, in the order they were put."""
    return [text.get_text() for text in axes.texts]


def text(axes: Axes, part: str) -> Text:
    """The one text with some words in it."""
    (found,) = [text for text in axes.texts if part in text.get_text()]
    return found


def tick_labels(axis: Axis) -> dict[float, str]:
    """Those that can be seen, by their places."""
    low, high = sorted(axis.get_view_interval())
    ticks = axis.get_major_ticks() + axis.get_minor_ticks()
    labels = {tick.get_loc(): tick for tick in ticks if low <= tick.get_loc() <= high}
    return {
        place: label.get_text()
        for place, tick in labels.items()
        for label in (tick.label1, tick.label2)
        if label.get_visible() and label.get_text()
    }


# --- Data ---


def lines(axes: Axes) -> list[Line2D]:
    """What was plotted, reference lines not among it."""
    return [line for line in axes.lines if line.get_transform().contains_branch(axes.transData) and not _spans(line)]


def _spans(line: Line2D) -> bool:
    """Whether it is one of axhline or axvline."""
    return np.asarray(line.get_xdata()).tolist() == [0, 1] or np.asarray(line.get_ydata()).tolist() == [0, 1]


def line(axes: Axes, label: str) -> Line2D:
    """The one with a label."""
    (found,) = [line for line in axes.lines if line.get_label() == label]
    return found


def data(line: Line2D) -> tuple[list[float], list[float]]:
    """What is drawn: x and y."""
    x, y = line.get_data()
    return np.asarray(x, dtype=float).tolist(), np.asarray(y, dtype=float).tolist()


def verticals(axes: Axes) -> list[float]:
    """Where reference lines stand upright."""
    return [line.get_xdata()[0] for line in axes.lines if np.asarray(line.get_ydata()).tolist() == [0, 1]]


def horizontals(axes: Axes) -> list[float]:
    """Where reference lines lie."""
    return [line.get_ydata()[0] for line in axes.lines if np.asarray(line.get_xdata()).tolist() == [0, 1]]


def marks(axes: Axes, **properties: Any) -> list[Line2D]:
    """The lines with properties such as marker="o", fillstyle="none"; colours in any form."""
    return [line for line in lines(axes) if all(_value(line, name) == _plain(v) for name, v in properties.items())]


def _value(line: Line2D, name: str) -> Any:
    return _plain(getattr(line, f"get_{name}")())


def _plain(value: Any) -> Any:
    """Colours in one form."""
    try:
        return to_hex(value)
    except ValueError:
        return value


def legend(place: Axes | Figure) -> dict[str, Line2D]:
    """What stands for each label in the legend."""
    found = place.get_legend() if isinstance(place, Axes) else place.legends[0]
    assert found is not None
    names = [text.get_text() for text in found.get_texts()]
    return dict(zip(names, found.legend_handles, strict=True))  # type: ignore[arg-type]


def looks(line: Line2D) -> tuple[str, Any, str]:
    """Colour, marker and whether it is full."""
    return to_hex(line.get_color()), line.get_marker(), line.get_fillstyle()


# --- Whether it can be seen, of a figure that is laid out ---


def unlabelled(figure: Figure) -> list[str]:
    """Axes with numbers at them and no unit in brackets beside these."""
    found = []
    for axes in _shown(figure):
        for name, axis in (("x", axes.xaxis), ("y", axes.yaxis)):
            shown = tick_labels(axis)
            if any(map(_is_number, shown.values())) and not re.search(r"\[.+\]", axis.get_label_text()):
                found.append(f"{name} axis {axis.get_label_text()!r} of {axes.get_title(loc='left')!r}")
    return found


def _is_number(label: str) -> bool:
    """Whether a tick's label is one; a power of ten is."""
    plain = label.replace("\N{MINUS SIGN}", "-")
    return bool(re.fullmatch(r"-?[\d.]+(e-?\d+)?|\$\\mathdefault\{-?10\^\{-?\d+\}\}\$", plain))


def overlaps(figure: Figure) -> list[str]:
    """Pairs of texts that are printed over one another."""
    boxes = list(_boxes(figure))
    small = [(name, box.padded(-SLACK)) for name, box in boxes if min(box.width, box.height) > 2 * SLACK]
    return [f"{a!r} over {b!r}" for (a, one), (b, other) in combinations(small, 2) if one.overlaps(other)]


def cut_off(figure: Figure) -> list[str]:
    """Texts that are not whole within the picture."""
    page = figure.bbox.padded(SLACK)
    return [name for name, box in _boxes(figure) if not (page.contains(*box.min) and page.contains(*box.max))]


def out_of_sight(axes: Axes) -> list[tuple[float, float]]:
    """Points of lines that are outside the limits of the axes."""
    points = np.concatenate([line.get_xydata() for line in lines(axes)] or [np.empty((0, 2))])
    points = points[np.isfinite(points).all(axis=1)]
    (left, right), (bottom, top) = sorted(axes.get_xlim()), sorted(axes.get_ylim())
    x, y = points.T
    near = 1e-9
    inside = (x >= left - near * abs(left)) & (x <= right + near * abs(right))
    inside &= (y >= bottom - near * abs(bottom)) & (y <= top + near * abs(top))
    return [(a, b) for a, b in points[~inside].tolist()]


def hidden_by_legend(axes: Axes) -> int:
    """How many points along lines lie behind the legend of the axes."""
    found = axes.get_legend()
    if found is None:
        return 0
    box = found.get_window_extent()
    hidden = 0
    for line in lines(axes):
        points = axes.transData.transform(line.get_xydata())
        points = points[np.isfinite(points).all(axis=1)]
        hidden += int(sum(box.contains(*point) for point in _along(points, line.get_linestyle())))
    return hidden


def _along(points: Array, style: Any) -> Array:
    """The points, and where they are joined, some between."""
    if style == "None" or len(points) < 2:
        return points
    parts = np.linspace(0, 1, 10)[:, None]
    return np.concatenate([(1 - parts) * a + parts * b for a, b in pairwise(points)])


def _shown(figure: Figure) -> list[Axes]:
    return [axes for axes in figure.get_axes() if axes.get_visible() and axes.axison]


def _boxes(figure: Figure) -> Iterator[tuple[str, Bbox]]:
    """Texts, of legends too, with the places they take [pixels]."""
    for axes in figure.get_axes():
        if axes.get_visible():
            shown = (text for text in _texts(axes) if text.get_text() and text.get_visible())
            # Of an annotation without its arrow, which may well be long.
            yield from ((text.get_text(), Text.get_window_extent(text)) for text in shown)
    yield from ((text.get_text(), text.get_window_extent()) for text in figure.texts)
    for found in figure.legends:
        yield from ((text.get_text(), text.get_window_extent()) for text in _of_legend(found))


def _texts(axes: Axes) -> Iterator[Text]:
    yield from axes.texts
    yield from (axes.title, axes._left_title, axes._right_title)  # type: ignore[attr-defined]
    if axes.axison:
        for axis in (axes.xaxis, axes.yaxis):
            yield axis.label
            low, high = sorted(axis.get_view_interval())
            for tick in axis.get_major_ticks() + axis.get_minor_ticks():
                if low <= tick.get_loc() <= high:
                    yield from (tick.label1, tick.label2)
    found = axes.get_legend()
    if found is not None:
        yield from _of_legend(found)


def _of_legend(found: Legend) -> list[Text]:
    return [*found.get_texts(), found.get_title()] if found.get_title().get_text() else list(found.get_texts())


def segments(axes: Axes) -> Array:
    """Of all collections of lines: their ends, shape (s, 2, 2)."""
    found = [np.array(c.get_segments()) for c in axes.collections if isinstance(c, LineCollection)]
    return np.concatenate([segments for segments in found if len(segments)])


# --- Whether its measures are those of a figure ---


def odd_measures(figure: Figure) -> list[str]:
    """What is too large or too small: the figure, lines, markers, words, and how far notes are from their places.

    Also rows that have not half a row of room below the last, and some above the first, which is on top.
    """
    width, height = figure.get_size_inches()
    found = [f"{width} x {height} inches"] * (not (6.5 <= width <= 14 and 1.9 <= height <= 16))
    words = [text for text in figure.findobj(Text) if text.get_text()]
    found += [f"{text.get_text()!r} of {text.get_fontsize()}" for text in words if not 8 <= text.get_fontsize() <= 13.2]
    for axes in figure.get_axes():
        found += [f"a line {line.get_linewidth()} wide" for line in axes.lines if not 0.6 <= line.get_linewidth() <= 4]
        marks = [line for line in axes.lines if line.get_marker() not in ("None", "")]
        found += [f"a marker of {mark.get_markersize()}" for mark in marks if not 3 <= mark.get_markersize() <= 13]
        edges = [mark.get_markeredgewidth() for mark in marks if mark.get_fillstyle() == "none"]
        found += [f"a ring {edge} wide" for edge in edges if not 0.9 <= edge <= 1.6]
        layers = [artist.get_alpha() for artist in (*axes.collections, *axes.patches) if artist.get_alpha() is not None]
        found += [f"a part of {alpha} seen through" for alpha in layers if not 0.2 <= alpha <= 0.5]
        notes = [text for text in axes.texts if isinstance(text, Annotation) and text.anncoords == "offset points"]
        found += [f"{note.get_text()!r} at {note.xyann}" for note in notes if np.abs(note.xyann).max() > 25]
        rows = tick_labels(axes.yaxis)
        if len(rows) > 1 and [*rows] == [*range(len(rows))] and not any(map(_is_number, rows.values())):
            bottom, top = axes.get_ylim()
            good = 0.3 <= bottom - (len(rows) - 1) <= 0.7 and -2 <= top <= -0.4
            found += [f"{len(rows)} rows from {bottom} to {top}"] * (not good)
            upright = [y for x, y in map(data, lines(axes)) if len(x) == 2 and x[0] == x[1] and y[0] != y[1]]
            within = [
                0.6 < high - low < 0.9 and abs((low + high) / 2 - round((low + high) / 2)) < 1e-9
                for low, high in upright
            ]
            found += [f"a bar at {y}" for y, good in zip(upright, within, strict=True) if not good]
    return found
