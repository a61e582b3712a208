"""All figures: drawn with what there is, in the same way each time, with units, and so that all of it can be seen."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.figure import Figure

from experiments.experiment import NAMES
from report.figures import draw, from_nothing, look, new_figure, powers
from tests.experiments.canned.results import RESULTS
from tests.report.figures.artists import (
    cut_off,
    hidden_by_legend,
    laid_out,
    legend,
    odd_measures,
    out_of_sight,
    overlaps,
    tick_labels,
    unlabelled,
    words,
)
from tests.report.figures.shown import result, shown

ALL = [(name, case) for name, cases in RESULTS.items() for case in cases]

#: The case of each that has most in it.
FULLEST = {name: "full" if "full" in cases else "usual" for name, cases in RESULTS.items()}

#: Where something is cut off on purpose: what blows up leaves its frame, the fastest mode begins as next to nothing.
CUT_ON_PURPOSE = {"first_order_instability"}


def test_every_experiment_has_a_figure_and_a_result_to_draw_it_of() -> None:
    """In the module of its name."""
    for name in NAMES:
        assert name in RESULTS
        assert callable(importlib.import_module(f"report.figures.{name}").draw)


@pytest.mark.rotating(5)
@pytest.mark.parametrize(("name", "case"), ALL)
def test_it_is_drawn_with_what_there_is_and_has_words_that_stand_for_it(name: str, case: str) -> None:
    """However little that is."""
    assert len(shown(name, case).alt) > 40
    assert odd_measures(shown(name, case).figure) == []


@pytest.mark.rotating(8)
@pytest.mark.parametrize("name", RESULTS)
def test_all_of_it_can_be_seen(name: str) -> None:
    """Every axis with numbers has its unit; no words over one another or cut off, no data outside or under a legend."""
    figure = laid_out(shown(name, FULLEST[name]).figure)
    assert unlabelled(figure) == []
    assert overlaps(figure) == []
    assert cut_off(figure) == []
    for axes in (axes for axes in figure.get_axes() if axes.name != "3d"):
        assert hidden_by_legend(axes) == 0
        assert name in CUT_ON_PURPOSE or out_of_sight(axes) == []


def a_figure() -> Figure:
    """A line with its label in the legend, a note, and axes with units."""
    figure, axes = new_figure((7, 4))
    axes.plot([0, 1, 2], [0, 1, 4], label="a line", **look(0))
    axes.set_xlabel("time [s]")
    axes.set_ylabel("place [m]")
    axes.text(0.1, 3.5, "a note")
    axes.legend(loc="center left")
    return laid_out(figure)


def test_a_figure_is_well_where_nothing_is_wrong() -> None:
    """The one that is spoilt below."""
    figure = a_figure()
    assert unlabelled(figure) == overlaps(figure) == cut_off(figure) == out_of_sight(figure.axes[0]) == []
    assert hidden_by_legend(figure.axes[0]) == 0
    assert odd_measures(figure) == []
    assert {name for name, spine in figure.axes[0].spines.items() if spine.get_visible()} == {"left", "bottom"}


def rows(figure: Figure) -> None:
    """Three of them, the first on top."""
    figure.axes[0].set_yticks(range(3), ["heun", "rk4", "euler"])
    figure.axes[0].set_ylim(2.6, -0.6)


SPOILT: dict[str, tuple[Callable[[Figure], object], Callable[[Figure], object]]] = {
    "no unit": (lambda figure: figure.axes[0].set_xlabel("time"), unlabelled),
    "a note over another": (lambda figure: figure.axes[0].text(0.15, 3.5, "one more"), overlaps),
    "a note over a tick's label": (lambda figure: figure.axes[0].text(-0.3, 2.9, "far out"), overlaps),
    "a note beyond the paper": (lambda figure: figure.text(0.95, 0.5, "too long for this"), cut_off),
    "a point outside": (lambda figure: figure.axes[0].set_xlim(0, 1.5), lambda figure: out_of_sight(figure.axes[0])),
    "a line too wide": (lambda figure: figure.axes[0].lines[0].set_linewidth(16), odd_measures),
    "markers too small": (lambda figure: figure.axes[0].lines[0].set_markersize(-6), odd_measures),
    "words too large": (lambda figure: figure.axes[0].texts[0].set_fontsize(90), odd_measures),
    "too wide": (lambda figure: figure.set_size_inches(20, 4), odd_measures),
    "a note far from its place": (
        lambda figure: figure.axes[0].annotate("far", (1, 1), (60, 4), textcoords="offset points"),
        odd_measures,
    ),
    "a row cut in two": (lambda figure: (rows(figure), figure.axes[0].set_ylim(2.0, -0.6)), odd_measures),
    "a legend on the line": (
        lambda figure: figure.axes[0].legend(loc="lower left"),
        lambda figure: hidden_by_legend(figure.axes[0]),
    ),
}


@pytest.mark.rotating(3)
@pytest.mark.parametrize("what", SPOILT)
def test_a_figure_that_is_not_well_is_seen(what: str) -> None:
    """Shown to fail, on the same figure with one thing wrong."""
    spoil, look_for = SPOILT[what]
    figure = a_figure()
    spoil(figure)
    assert look_for(laid_out(figure))


def fingerprint(figure: Figure) -> list[object]:
    """The words in all axes, and the lines and points with their places and colours."""
    found: list[object] = []
    for axes in figure.get_axes():
        found += [axes.get_title(loc="left"), axes.get_xlabel(), axes.get_ylabel(), words(axes), sorted(labels(axes))]
        found += [(line.get_xydata().tolist(), line.get_color(), line.get_marker()) for line in axes.lines]
        found += [points.get_offsets().tolist() for points in axes.collections if isinstance(points, PathCollection)]
    return found


def labels(axes: Axes) -> list[str]:
    """What stands in the legend, if there is one."""
    return [] if axes.get_legend() is None else [*legend(axes)]


@pytest.mark.rotating(5)
@pytest.mark.parametrize("name", RESULTS)
def test_the_same_result_is_drawn_in_the_same_way_and_another_in_another(name: str) -> None:
    """To the last number."""
    once, again, *others = (
        repr(fingerprint(picture.figure))
        for picture in (draw(name, RESULTS[name]["usual"]()), *(shown(name, case) for case in RESULTS[name]))
    )
    assert once == again
    assert once not in others


def test_the_same_figure_is_the_same_bytes() -> None:
    """No date, no random identifiers: an SVG element and nothing else."""
    svg = draw("versions", result("versions")).svg()
    assert svg == draw("versions", result("versions")).svg()
    assert svg.startswith("<svg")
    assert svg.rstrip().endswith("</svg>")


def test_threads_that_draw_do_not_disturb_one_another() -> None:
    """Matplotlib's style is the process's: without turns, one thread takes it away while another draws."""
    made = result("versions")
    alone = draw("versions", made).svg()
    with ThreadPoolExecutor(4) as pool:
        drawn = list(pool.map(lambda _: draw("versions", made).svg(), range(4)))
    assert set(drawn) == {alone}


def test_figures_are_not_kept(recwarn: pytest.WarningsRecorder) -> None:
    """Two more than twenty, where Matplotlib's pyplot warns from the twenty-first that is never closed."""
    for _ in range(22):
        draw("stiff_limit", result("stiff_limit"))
    assert not recwarn.list


def test_powers_of_ten_are_labelled_as_such() -> None:
    """Beside a place for nothing every third of them, as far as the axis goes."""
    assert powers(-2, 3) == {0.01: "$10^{-2}$", 1000.0: "$10^{3}$"}
    _, axes = new_figure((7, 4))
    axes.set_xscale("log")
    axes.set_xlim(1e-18, 1e-4)
    from_nothing(axes.xaxis, 1e-17)
    assert [*tick_labels(axes.xaxis).values()] == ["none", *(f"$10^{{{n}}}$" for n in (-15, -12, -9, -6))]
    assert [*tick_labels(axes.xaxis)] == pytest.approx([1e-17, 1e-15, 1e-12, 1e-9, 1e-6])


def test_64_things_look_different() -> None:
    """Colour and marker together; eight neighbours differ in both."""
    looks = [look(i) for i in range(64)]
    assert len({(found["color"], found["marker"]) for found in looks}) == 64
    for key in ("color", "marker"):
        assert len({found[key] for found in looks[:8]}) == 8


def test_points_that_are_not_finite_are_not_looked_for() -> None:
    """A line with a hole in it is all in sight."""
    _, axes = new_figure((3, 3))
    axes.plot([0, 1, 2], [0, np.nan, 1])
    assert out_of_sight(axes) == []
