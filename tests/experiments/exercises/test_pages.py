"""The texts of exercises in headless Chromium: on wide and narrow screens, light and dark, and on paper."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from experiments.exercises.exercise import Exercise, exercises
from experiments.exercises.page import page
from tests.report.browser import VIEWS, Shown, chromium


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """One browser for all tests of this file."""
    with chromium() as found:
        yield found


@pytest.mark.parametrize("exercise", exercises().values(), ids=lambda e: e.name)
def test_a_text_has_no_violation_and_asks_for_nothing(
    browser: Any, exercise: Exercise, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    """Zero by axe-core, no request, nothing cut or too wide, tables neither: in one view; with --full in all."""
    file = tmp_path / "text.html"
    file.write_text(page(exercise), encoding="utf-8")
    views = VIEWS if request.config.getoption("--full") else [VIEWS[(exercise.number + 1) % len(VIEWS)]]
    for view in views:
        shown = Shown(browser, file, view)
        assert shown.violations() == []
        assert (shown.requests, shown.complaints) == ([], [])
        assert (shown.sideways(), shown.cut_off()) == (0, [])
        assert shown.page.evaluate("[...document.querySelectorAll('table')].every(t => t.scrollWidth <= t.clientWidth)")
        shown.page.close()
