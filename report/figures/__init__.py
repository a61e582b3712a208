"""One file per experiment: its figure, and the words that stand for the figure where it cannot be seen."""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from io import StringIO
from threading import RLock
from typing import TYPE_CHECKING, Any

from experiments.experiment import Result

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Okabe and Ito's colours, told apart by everyone; each goes with a marker of its own.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8C6D31")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")

#: How the three words are drawn, in every figure: predicted a line, measured a dot, identified a ring.
PREDICTED: dict[str, Any] = {"color": COLOURS[6], "linestyle": "-", "marker": ""}
MEASURED: dict[str, Any] = {"marker": "o", "fillstyle": "full"}
IDENTIFIED: dict[str, Any] = {"marker": "o", "fillstyle": "none", "markeredgewidth": 1.4}

#: Black that stays black where the page is dark: what is drawn upon a heat map, whose colours stay too.
BLACK_ON_COLOURS = "#000001"

#: Sizes of words [points]: above a panel, in it or beside it, and where there are many.
TITLE, NOTE, SMALL = 11, 9, 8

STYLE = {
    "figure.constrained_layout.use": True,
    "font.size": TITLE,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.6,
    "legend.frameon": False,
    "svg.hashsalt": "springlab",
}

#: Matplotlib's style is the whole process's: threads that draw take turns.
ONE_AT_A_TIME = RLock()


@dataclass(frozen=True)
class Picture:
    """A figure and its alternative text."""

    figure: Figure
    alt: str

    def svg(self) -> str:
        """The figure as an SVG element, the same bytes for the same figure."""
        from matplotlib import rc_context

        file = StringIO()
        with ONE_AT_A_TIME, rc_context(STYLE):
            self.figure.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
        text = file.getvalue()
        return text[text.index("<svg") :]


def new_figure(figsize: tuple[float, float], **options: Any) -> tuple[Any, Any]:
    """A figure of a size [inches] and its axes in the report's style; options as for Figure.subplots.

    Made without pyplot, which would keep every figure for ever.
    """
    from matplotlib import rc_context

    from report.figures.laid_out import LaidOut

    with ONE_AT_A_TIME, rc_context(STYLE):
        figure = LaidOut(figsize=figsize)
        return figure, figure.subplots(**options)


def few_ticks(axes: Any) -> None:
    """Label 1, 2 and 5 of every decade of a logarithmic axis, in plain numbers that do not run into one another."""
    from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())


def from_nothing(axis: Any, nothing: float) -> None:
    """Label a logarithmic axis that has a place for zero, too, which has no logarithm: every third power of ten.

    Args:
        axis: one of the axes' two, with its limits.
        nothing: where zero is drawn.
    """
    labels = {place: text for place, text in powers(*range(-15, 1, 3)).items() if place <= axis.get_view_interval()[1]}
    axis.set_ticks([nothing, *labels], ["none", *labels.values()])
    axis.set_ticks([], minor=True)


def powers(*exponents: int) -> dict[float, str]:
    """Powers of ten and their labels."""
    return {10.0**n: f"$10^{{{n}}}$" for n in exponents}


def look(i: int) -> dict[str, str]:
    """Colour and marker of the i-th thing in a figure: 64 pairs, as each time round the colours the markers move on."""
    return {"color": COLOURS[i % len(COLOURS)], "marker": MARKERS[(i + i // len(COLOURS)) % len(MARKERS)]}


def draw(name: str, result: Result) -> Picture:
    """The picture of an experiment's result, drawn by report.figures.NAME."""
    from matplotlib import rc_context

    with ONE_AT_A_TIME, rc_context(STYLE):
        picture: Picture = importlib.import_module(f"report.figures.{name}").draw(result)
    return picture


def animate(name: str, result: Result) -> str:
    """The animations of an experiment's result as HTML, by report.figures.NAME where that makes any."""
    found = getattr(importlib.import_module(f"report.figures.{name}"), "animate", None)
    return "" if found is None else str(found(result))
