"""The live page in headless Chromium, which draws WebGL by the processor alone here: what nobody should be without.

Every page here has asked for nothing from elsewhere, and had no error in its console, when it is left.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import viser

from report.live.scenes import names
from tests.report.chromium import new_page
from tests.report.live.commands import begins, ends_of
from tests.report.live.visit import Visitor, visit


@pytest.fixture(scope="module")
def only(chromium: Any, address: str) -> Iterator[Visitor]:
    """One viewer for all tests: most of a visit's time is the page's opening."""
    with visit(chromium, address) as found:
        yield found


@pytest.fixture
def newcomer(only: Visitor, chromium: Any, address: str) -> Iterator[Visitor]:
    """A viewer of a page that has shown no other scene: its first limit is this one's. That viewer, if first."""
    if not only.has_chosen:
        yield only
        return
    with visit(chromium, address) as found:
        yield found


@pytest.fixture
def visitor(only: Visitor) -> Visitor:
    """That viewer, at the beginning of the scene that the lab opens with, which plays."""
    if only.page.get_by_label("lane 1", exact=True).input_value() != "kick_drift":
        only.choose("lane 1", "kick_drift")
        only.see("kick_drift")
    if only.page.get_by_label("scene", exact=True).input_value() == "string":
        only.choose("scene", "spring")  # and back, as what is open is not opened again
        only.see("spring, t = ")
    only.choose("scene", "string")
    only.see("string, t = ")
    return only


@pytest.mark.rotating(5, in_turn=True)
def test_past_the_limit_the_banner_comes_and_below_it_does_not(newcomer: Visitor) -> None:
    """By the slider, whose mark is at the limit; then stiffness is changed while it runs.

    The motion goes on, and the limit falls as one over the root of the stiffness.
    """
    limit = newcomer.limit()
    newcomer.slide_dt(beyond=4)
    newcomer.alert.wait_for()
    newcomer.is_told("blew up")
    assert 1.05 * limit < newcomer.value("dt [ms]") < 1.3 * limit
    assert "times the predicted largest stable dt" in newcomer.alert.inner_text()
    newcomer.slide_dt(beyond=-10)
    newcomer.begin_again()
    assert not newcomer.alert.is_visible()
    newcomer.play()
    newcomer.wait_until(0.3)
    assert 0.5 * limit < newcomer.value("dt [ms]") < 0.95 * limit
    newcomer.type("dt [ms]", 1.0)
    before = newcomer.time
    newcomer.type("stiffness [N/m]", 150)
    assert newcomer.limit(unlike=limit) == pytest.approx(limit * (200 / 150) ** 0.5, rel=1e-3)
    assert newcomer.time >= before
    newcomer.wait_until(before + 0.3)
    assert not newcomer.alert.is_visible()


def test_every_scene_opens_and_moves(visitor: Visitor, corpus_part: slice) -> None:
    """One after the other, others every day; none blows up at its own dt."""
    for scene in names()[corpus_part]:
        visitor.choose("scene", scene)
        visitor.see(f"{scene}, t = ")
        visitor.wait_until(0.02)
        assert not visitor.alert.is_visible(), scene


@pytest.mark.rotating(5, in_turn=True)
def test_a_stepper_takes_over_and_the_command_comes_to_the_same_state(visitor: Visitor, tmp_path: Path) -> None:
    """From the file with the state where it took over, to rounding: to the state where the next one takes over.

    The command is that of what is seen, a change of stiffness on the way included.
    """
    visitor.choose("lane 1", "rk4")
    visitor.see("rk4")
    begin = visitor.time
    visitor.type("stiffness [N/m]", 150)
    visitor.wait_until(begin + 0.2)
    visitor.pause()
    line = visitor.command("--stepper=rk4", tmp_path)
    (state,) = ends_of(line, tmp_path).values()
    visitor.choose("lane 1", "heun")
    visitor.see("heun")
    seen = begins(visitor.command("--stepper=heun", tmp_path), tmp_path)
    assert state.time > 0.1
    np.testing.assert_allclose(state.positions, seen, rtol=0, atol=1e-12)


@pytest.mark.rotating(5, in_turn=True)
def test_a_mass_is_dragged(visitor: Visitor) -> None:
    """With the mouse, while nothing else moves; then it is no run that a command alone can say."""
    visitor.begin_again()
    visitor.command("compare string ")
    visitor.drag_last_mass(10, right=-60, down=60)
    visitor.let_go()
    visitor.command("compare string-live.toml ")
    visitor.play()
    visitor.wait_until(0.1)


def test_a_page_from_elsewhere_does_not_get_in(only: Visitor, chromium: Any, address: str) -> None:
    """In the real browser: the same socket opens from the lab's own page, and from a foreign one it does not.

    Nor does a name of somebody's own that leads to this machine, as DNS rebinding has it.
    """
    knock = f"""() => new Promise(done => {{
        const socket = new WebSocket("{address.replace("http", "ws")}", "viser-v{viser.__version__}");
        socket.onopen = () => {{ socket.close(); done("open"); }};
        socket.onerror = () => done("refused");
    }})"""
    page = new_page(chromium)
    page.route("http://evil.example/", lambda route: route.fulfill(body="<html></html>", content_type="text/html"))
    page.goto("http://evil.example/")
    assert page.evaluate(knock) == "refused"
    page.close()
    assert only.page.evaluate(knock) == "open"
