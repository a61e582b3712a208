"""The texts of exercises in headless Chromium: on wide and narrow screens, light and dark, and on paper."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from experiments.exercises.exercise import exercises
from experiments.exercises.teaching.page import page
from tests.report.chromium import VIEWS, Shown, chromium

# What takes long here is run every few days, and with --full.
pytestmark = pytest.mark.rotating(3)


@pytest.mark.rotating(9)
def test_the_texts_have_no_violation_and_ask_for_nothing(tmp_path: Path, request: pytest.FixtureRequest) -> None:
    """Zero by axe-core, no request, nothing cut or too wide, tables neither: in one view; with --full in all.

    One test for all texts, as starting the browser is most of what they take.
    """
    wrong = {}
    with chromium() as browser:
        check_that_faults_are_noticed(browser, tmp_path / "wrong.html")
        for exercise in exercises().values():
            file = tmp_path / f"{exercise.name}.html"
            file.write_text(page(exercise, exercise.text), encoding="utf-8")
            views = VIEWS if request.config.getoption("--full") else [VIEWS[(exercise.number + 1) % len(VIEWS)]]
            wrong |= {(exercise.name, view): complaints(Shown(browser, file, view)) for view in views}
    assert {where: found for where, found in wrong.items() if found} == {}


def test_markup_in_a_text_is_text(tmp_path: Path) -> None:
    """As in a comparison of a < b that is taken for a tag; Markdown's own tables are tables."""
    folder = tmp_path / "e99_markup"
    folder.mkdir()
    (folder / "text.md").write_text("Is <b>a</b> < *c*?\n\n| x |\n| - |\n| 1 |\n\n", encoding="utf-8")
    exercise = replace(next(iter(exercises().values())), folder=folder)
    body = page(exercise, exercise.text).partition("<main>")[2]
    assert "Is &lt;b&gt;a&lt;/b&gt; &lt; <em>c</em>?" in body
    assert "<td>1</td>" in body


def complaints(shown: Shown) -> list[str]:
    """What there is to say against a text as it is shown; closes its page."""
    found = [*shown.violations(), *shown.requests, *shown.complaints, *shown.cut_off()]
    found += [f"{shown.sideways()} px too wide"] if shown.sideways() else []
    narrow = shown.page.evaluate("[...document.querySelectorAll('table')].every(t => t.scrollWidth <= t.clientWidth)")
    found += [] if narrow else ["a table is too wide"]
    shown.page.close()
    return found


def check_that_faults_are_noticed(browser: Any, file: Path) -> None:
    """Shown to fail: a picture without words from elsewhere, and a table and a line that are too wide."""
    wide = "a" * 400
    file.write_text(f"<p>{wide}</p><img src='nowhere.png'><table style='display: block'><td>{wide}</td></table>")
    found = " ".join(complaints(Shown(browser, file, VIEWS[0])))
    for word in ("image-alt", "nowhere.png", "px too wide", "a table"):
        assert word in found
