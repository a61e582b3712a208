"""Lanes that stopped, in Chromium: why where no dt is unstable, the way back, and what is told of those that go on."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from report.browser.lab_page import lab_page
from report.browser.presets import Preset
from tests.report.browser.test_lab_page import opened
from tests.report.chromium import chromium


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page, with a string and a cloth, on disk."""
    made = tmp_path_factory.mktemp("page") / "lab.html"
    made.write_text(lab_page([Preset("string"), Preset("cloth")]), encoding="utf-8")
    return made


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium."""
    with chromium() as found:
        yield found


#: A cloth in steps that two of these schemes find no solution of, at once, and the third for some.
UNSOLVED = "v=1&s=cloth&w=backward_euler,bdf2,implicit_midpoint&dt=0.2&n=10"


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.parametrize(
    ("language", "why", "back"),
    [
        ("en", "stable at any dt; but a step's equations must be solved, too", "Back to before it stopped"),
        ("de", "bei jedem dt stabil; aber die Gleichungen eines Schritts müssen auch gelöst", "Zurück vor den Abbruch"),
    ],
)
def test_where_a_solver_gives_up_it_says_why_that_is_no_instability(
    browser: Any, file: Path, language: str, why: str, back: str
) -> None:
    """Beside "stable at any dt"; with the way back before it, and half the dt, at which all go on."""
    shown = opened(browser, file, f"{UNSOLVED}&lang={language}")
    page = shown.page
    assert page.evaluate("lab.lanes.map(lane => (lab.limits[lane.scheme] || {}).limit)")[0] == np.inf
    assert why in page.inner_text("#said")
    buttons = page.locator("#said button")
    assert buttons.nth(0).inner_text() == back
    assert "dt = 100 ms" in buttons.nth(1).inner_text()
    buttons.nth(1).click()
    assert page.evaluate("[lab.dt, lab.short]") == [0.1, False]
    page.evaluate("for (let k = 0; k < 3; k++) oneStep(); keepPast(); showState()")
    assert page.evaluate("lab.lanes[0].world.steps") == 3
    assert shown.complaints == []
    page.close()


@pytest.mark.rotating(7, in_turn=True)
def test_where_an_explosion_came_first_the_way_back_is_before_that(browser: Any, file: Path) -> None:
    """Euler alone, which solves nothing, explodes."""
    shown = opened(browser, file, "s=string&w=euler&dt=0.02&n=3000")
    assert shown.page.locator("#said button").nth(0).inner_text() == "Back to before it"
    shown.page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_the_status_tells_of_the_lane_that_is_furthest(browser: Any, file: Path) -> None:
    """Lane 1 has stopped at once, the third goes on: its time and steps, in the link too; what is set then is its."""
    shown = opened(browser, file, UNSOLVED.replace("n=10", "n=2"))
    page = shown.page
    time, steps = page.evaluate("[timeOf(lab.lanes[2].world), lab.lanes[2].world.steps]")
    assert page.evaluate("lab.lanes[0].world.steps") == 0
    assert steps == 2
    assert f"t = {time:.5g} s, {steps} steps" in page.inner_text("#status")
    assert f"n={steps}" in page.evaluate("stateText()")
    assert "No lane" not in page.inner_text("#status")
    page.evaluate("change('damping', 0.7); showAll()")
    assert page.evaluate("[lab.changes[0].time, shownOf('damping')]") == [time, "0.7"]
    page.evaluate("rewind(lab.past.length - 1)")
    assert page.evaluate("laneTime()") == time
    # how far a lane is from one that stopped is no number
    assert page.evaluate("Number.isNaN(measured().apart[2])")
    page.close()


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.parametrize(("language", "said"), [("en", "No lane can go on"), ("de", "keine Bahn")])
def test_where_all_lanes_have_stopped_the_status_says_so(browser: Any, file: Path, language: str, said: str) -> None:
    """And not that play goes on; where one has not, that stands there, and this does not."""
    shown = opened(browser, file, f"s=cloth&w=backward_euler,bdf2&dt=0.2&n=10&lang={language}")
    status = shown.page.inner_text("#status")
    assert said in status
    assert shown.page.evaluate("say('link_short')") not in status
    shown.page.evaluate("goBack()")
    assert shown.page.evaluate("say('link_short')") not in shown.page.inner_text(
        "#status"
    )  # it was not for want of time
    shown.page.evaluate("lab.short = true; rewind(0); lab.lanes[0].world.blownUp = null; showState()")
    status = shown.page.inner_text("#status")
    assert said not in status
    assert shown.page.evaluate("say('link_short')") in status
    shown.page.close()


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.parametrize("lanes", ["backward_euler,bdf2", "backward_euler,implicit_midpoint"])
def test_a_link_to_lanes_that_stopped_opens_as_they_stopped(browser: Any, file: Path, lanes: str) -> None:
    """The same places and steps, and the same said of them: also where the last lane has stopped in the first step."""
    shown = opened(browser, file, f"s=cloth&w={lanes}&dt=0.2&n=10")
    told = "[stateText(), lab.lanes.map(({world}) => [world.steps, (world.blownUp || {}).what]), "
    told += "lab.lanes.map(({world: {memory: {F, at}}}) => Array.from(F.slice(at.x, at.x + 2 * at.n * at.d)))]"
    first, said = shown.page.evaluate(told), shown.page.inner_text("#said")
    assert "stopped" in said
    shown.page.close()
    again = opened(browser, file, first[0])
    assert again.page.evaluate(told) == first
    assert again.page.inner_text("#said") == said
    again.page.close()
