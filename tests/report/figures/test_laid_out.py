"""Figures that are laid out and drawn once: the bytes that Matplotlib's own make, of half as many drawings."""

from __future__ import annotations

from io import StringIO

import numpy as np
import pytest
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from report.figures import STYLE
from report.figures.laid_out import LaidOut


def drawn(kind: type[Figure], laid_out: bool = True) -> str:
    """Two panels with what a layout has to make room for: titles, labels, ticks, a legend and a bar of colours."""
    with rc_context({**STYLE, "figure.constrained_layout.use": laid_out}):
        figure = kind(figsize=(6.0, 3.0))
        first, second = figure.subplots(1, 2)
        first.plot([1, 2, 30], [0.1, 2000.0, 3.0], label="a line")
        first.set(title="one", xlabel="time [s]", ylabel="height [m]", yscale="log")
        figure.colorbar(second.imshow([[1.0, 2.0], [3.0, 4.0]]), ax=second, label="force [N]")
        first.legend()
        file = StringIO()
        figure.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
    return file.getvalue()


@pytest.mark.rotating(3, in_turn=True)
def test_the_bytes_are_matplotlibs_own() -> None:
    """And not those of axes that nobody lays out."""
    assert drawn(LaidOut) == drawn(Figure)
    assert drawn(LaidOut) != drawn(Figure, laid_out=False)


@pytest.mark.rotating(3, in_turn=True)
def test_a_figure_that_is_saved_is_drawn_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Matplotlib's twice."""
    count = {LaidOut: 0, Figure: 0}
    of_line = Line2D.draw
    for kind in count:

        def counted(line: Line2D, renderer: object, kind: type[Figure] = kind) -> None:
            count[kind] += 1
            of_line(line, renderer)  # type: ignore[arg-type]

        monkeypatch.setattr(Line2D, "draw", counted)
        drawn(kind)
    assert count[Figure] == 2 * count[LaidOut] > 0


def test_what_is_drawn_without_being_saved_is_all_there() -> None:
    """On a canvas of pixels, as in a notebook."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    with rc_context(STYLE):
        figure = LaidOut(figsize=(2.0, 2.0))
        figure.subplots().plot([0, 1], [0, 1], color="red")
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
    red, green, blue, _ = np.asarray(canvas.buffer_rgba()).reshape(-1, 4).T.astype(int)
    assert ((red > 200) & (green < 50) & (blue < 50)).any()
