"""Figures: the same bytes for the same numbers, and something to see even where nothing ran."""

from __future__ import annotations

import importlib
from concurrent.futures import ThreadPoolExecutor

import pytest

from experiments.experiment import NAMES
from report.figures import draw
from tests.report.page.canned import RESULTS, engines_that_run, stiff_limit

ALL = [(name, case) for name, cases in RESULTS.items() for case in cases]


@pytest.mark.parametrize(("name", "case"), ALL)
def test_a_figure_is_drawn_with_what_there_is(name: str, case: str) -> None:
    """And has words that stand for it."""
    picture = draw(name, RESULTS[name][case]())
    assert picture.svg().startswith("<svg")
    assert picture.svg().rstrip().endswith("</svg>")
    assert len(picture.alt) > 40


@pytest.mark.parametrize("name", RESULTS)
def test_the_same_result_is_drawn_in_the_same_bytes(name: str) -> None:
    """No date, no random identifiers; and another result is drawn in others, or the test would see nothing."""
    result = RESULTS[name]["usual"]()
    svg = draw(name, result).svg()
    assert svg == draw(name, result).svg()
    others = [make for case, make in RESULTS[name].items() if case != "usual"]
    assert all(draw(name, make()).svg() != svg for make in others)


def test_threads_that_draw_do_not_disturb_one_another() -> None:
    """Matplotlib's style is the process's: without turns, one thread takes it away while another draws."""
    result = RESULTS["errata"]["usual"]()
    alone = draw("errata", result).svg()
    with ThreadPoolExecutor(4) as pool:
        drawn = list(pool.map(lambda _: draw("errata", result).svg(), range(8)))
    assert set(drawn) == {alone}


def test_figures_are_not_kept(recwarn: pytest.WarningsRecorder) -> None:
    """Thirty of them, where Matplotlib's pyplot warns from the twenty-first that is never closed."""
    for _ in range(30):
        draw("stiff_limit", stiff_limit(None))
    assert not recwarn.list


def test_the_words_for_the_divergence_figure_name_engines_schemes_and_strangers() -> None:
    """As the figure does; an engine that did not run is not in it."""
    alt = draw("divergence", engines_that_run()).alt
    assert "m from kick_drift" in alt
    assert "StifferByAMillionth" in alt
    assert "not identified" in alt
    assert "Segfaults" not in alt


def test_every_experiment_has_a_figure() -> None:
    """In the module of its name."""
    for name in NAMES:
        assert callable(importlib.import_module(f"report.figures.{name}").draw)
