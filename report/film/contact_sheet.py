"""The contact sheet: the panels of a film side by side, names above each, the time and the colours once."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil
from typing import Any

from reference.outcome import Outcome
from reference.state import Trajectory
from reference.system import MassSpringSystem
from report.figures import NOTE, SMALL, TITLE
from report.film.drawing import Drawing, Look, add_length, add_strain_bar
from report.film.view import Window

#: Most width and height of the sheet [inches]; pixels per inch; least and most height of a panel [inches].
WIDE, HIGH, PIXELS, LEAST, HIGHEST = 12.4, 8.6, 100, 0.8, 5.2

#: The least room of titles [inches], however narrow the panels are.
TITLES = 2.3

#: Room for the line above all, for a line of a panel's title, between panels, and for the colours [inches].
TOP, LINE, BETWEEN, BAR = 0.5, 0.165, 0.15, 1.1

#: The most height of the colours [inches].
BAR_HIGH = 4.0


@dataclass(frozen=True, eq=False)
class Shot:
    """One panel.

    Attributes:
        names: the steppers that move like this.
        caption: which scheme that is.
        outcome: how they ended, with the first one's trajectory.
        left: when a mass first leaves the picture [s], if one does.
    """

    names: tuple[str, ...]
    caption: str
    outcome: Outcome
    left: float | None = None

    @property
    def motion(self) -> Trajectory:
        """The first one's trajectory."""
        assert self.outcome.trajectory is not None
        return self.outcome.trajectory


@dataclass(frozen=True, eq=False)
class ContactSheet:
    """What is to be filled in for every picture.

    Attributes:
        figure: all of it.
        drawings: one for each panel.
        clock: the text that tells the time.
        notes: the texts that say that masses have left the picture, one for each panel.
    """

    figure: Any
    drawings: Sequence[Drawing]
    clock: Any
    notes: Sequence[Any]


@dataclass(frozen=True)
class Grid:
    """Where panels go.

    Attributes:
        columns: how many there are.
        size: width and height of a panel [inches].
        titles: the height of the titles above each row [inches].
    """

    columns: int
    size: tuple[float, float]
    titles: tuple[float, ...]

    @property
    def sheet(self) -> tuple[float, float]:
        """Width and height of the whole [inches]: even numbers of pixels, as some formats want it."""
        wide, high = self.size
        across = max(self.columns * (max(wide, TITLES) + BETWEEN) + BETWEEN + BAR, 6.0)
        tall = TOP + sum(self.titles) + len(self.titles) * high + BETWEEN
        return 2 * round(across * PIXELS / 2) / PIXELS, 2 * round(tall * PIXELS / 2) / PIXELS

    def corner(self, i: int) -> tuple[float, float]:
        """The lower left corner of panel i [inches from the sheet's]."""
        row, column = divmod(i, self.columns)
        above = TOP + sum(self.titles[: row + 1]) + (row + 1) * self.size[1]
        return BETWEEN + column * (max(self.size[0], TITLES) + BETWEEN), self.sheet[1] - above


def grid(shots: Sequence[Shot], window: Window) -> Grid:
    """That in which panels are largest; of several, as where all have the least size, the one with the fewest rows."""
    ratio = (window[1] - window[0]) / (window[3] - window[2])
    grids = []
    most = max(1, int((WIDE - BAR - BETWEEN) / (TITLES + BETWEEN)))
    for columns in range(1, min(len(shots), most) + 1):
        rows, high = ceil(len(shots) / columns), 1.0
        titles: tuple[float, ...] = ()
        # how many lines the titles have depends on how wide the panels are, and these on what room titles leave
        for _ in range(4):
            lines = [sum(map(len, _title(shot, high * ratio))) for shot in shots]
            titles = tuple(LINE * max(lines[r * columns : (r + 1) * columns]) + 0.1 for r in range(rows))
            across = ((WIDE - BAR - BETWEEN) / columns - BETWEEN) / ratio
            high = max(LEAST, min(across, (HIGH - TOP - BETWEEN - sum(titles)) / rows, HIGHEST))
        grids.append(Grid(columns, (high * ratio, high), titles))
    return max(grids, key=lambda found: (found.size[1], -len(found.titles)))


def contact_sheet(system: MassSpringSystem, shots: Sequence[Shot], look: Look, title: str) -> ContactSheet:
    """A contact sheet with an empty drawing for each shot."""
    from matplotlib.figure import Figure

    laid = grid(shots, look.window)
    wide, high = laid.sheet
    figure = Figure(figsize=(wide, high), dpi=PIXELS)
    drawings, notes = [], []
    for i, shot in enumerate(shots):
        x, y = laid.corner(i)
        axes = figure.add_axes((x / wide, y / high, laid.size[0] / wide, laid.size[1] / high))
        drawings.append(Drawing(axes, system, look))
        notes.append(_titled(axes, shot, laid.size[0]))
        add_length(axes, look.window)
    room = high - TOP - laid.titles[0] - 2 * BETWEEN
    tall = min(room, BAR_HIGH)
    bar = ((wide - BAR + 0.1) / wide, (BETWEEN + (room - tall) / 2) / high, 0.14 / wide, tall / high)
    add_strain_bar(figure, figure.add_axes(bar), look.most)
    line = 1 - 0.28 / high
    figure.text(BETWEEN / wide, line, title, fontsize=TITLE, va="center")
    clock = figure.text(1 - BETWEEN / wide, line, "", fontsize=TITLE, va="center", ha="right", family="monospace")
    return ContactSheet(figure, drawings, clock, notes)


def _title(shot: Shot, wide: float) -> tuple[list[str], list[str]]:
    """The steppers' names, and their scheme, in lines that go above a panel so wide [inches]."""
    room = max(wide, TITLES)
    return textwrap.wrap(", ".join(shot.names), int(12.5 * room)), textwrap.wrap(shot.caption, int(17 * room))


def _titled(axes: Any, shot: Shot, wide: float) -> Any:
    """Names and scheme above a panel; what is returned is the note that masses have left it."""
    above: dict[str, Any] = {"xy": (0, 1), "xycoords": "axes fraction", "textcoords": "offset points"}
    names, caption = _title(shot, wide)
    axes.annotate("\n".join(caption), xytext=(0, 3), fontsize=SMALL, color="#555555", **above)
    place = (0, 3 + 11 * len(caption))
    axes.annotate("\n".join(names), xytext=place, fontsize=NOTE, fontweight="bold", linespacing=1.1, **above)
    says = "" if shot.left is None else f"left the picture\nat t = {shot.left:.3f} s"
    box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 2}
    where = (0.03, 0.97, says)
    return axes.text(*where, transform=axes.transAxes, fontsize=SMALL, va="top", color="#a32a00", zorder=6, bbox=box)
