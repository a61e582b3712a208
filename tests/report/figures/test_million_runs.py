"""Predicted hours against cores: falling as one over them down to the floor of what is done one after another."""

from __future__ import annotations

import numpy as np
import pytest

from experiments.million_runs import CORES, RUNS, in_words, predicted
from report.figures import look
from tests.experiments.canned.million_runs import HANDS, KINDS
from tests.report.figures.artists import data, legend, marks, text
from tests.report.figures.shown import shown


def test_lines_are_the_predicted_hours_and_markers_are_at_the_cores_of_the_table() -> None:
    """The slowest kind first; RUNS seconds-per-run over cores while that is more than the floor."""
    axes = shown("million_runs").figure.axes[0]
    slow, fast = sorted(KINDS, key=lambda kind: -kind.seconds)
    for i, kind in enumerate((slow, fast)):
        (curve,) = marks(axes, color=look(i)["color"], marker="None")
        cores, hours = data(curve)
        assert hours == pytest.approx([predicted(kind, HANDS, n) / 3600 for n in cores])
        assert hours[0] == pytest.approx(RUNS * kind.seconds / cores[0] / 3600)
        (dots,) = marks(axes, linestyle="None", marker=look(i)["marker"])
        assert data(dots) == (list(CORES), pytest.approx([predicted(kind, HANDS, n) / 3600 for n in CORES]))
        assert dots.get_label() == f"{kind.name}: {1e3 * kind.seconds:.0f} ms"
    assert [*legend(axes)] == [f"{kind.name}: {1e3 * kind.seconds:.0f} ms" for kind in (slow, fast)]
    assert axes.get_legend().get_title().get_text() == "a run, measured"


def test_axes_have_units_and_words_say_why_it_is_flat() -> None:
    """Hours; beneath the lowest line."""
    axes = shown("million_runs").figure.axes[0]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("cores [1]", "predicted time of a million runs [h]")
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
    lowest = min(min(data(line)[1]) for line in axes.lines)
    assert axes.get_ylim()[0] < text(axes, "flat: ").xy[1] < lowest
    assert np.isfinite(lowest)
    last = max(max(data(line)[0]) for line in axes.lines)
    assert text(axes, "flat: ").xy[0] == last == pytest.approx(10 * max(CORES))


def test_the_words_for_it_have_the_times_of_the_slowest() -> None:
    """On each number of cores."""
    slowest = max(KINDS, key=lambda kind: kind.seconds)
    for cores in CORES:
        assert f"{in_words(predicted(slowest, HANDS, cores))} on {cores}" in shown("million_runs").alt
