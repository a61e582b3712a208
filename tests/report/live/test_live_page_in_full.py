"""Everything else that people can do on the live page, in headless Chromium: with `--full`, as it takes minutes."""

from __future__ import annotations

import csv
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from report.live.parameters import PRESETS
from report.live.server import FULL, MOST_VIEWERS
from tests.report.chromium import new_page
from tests.report.live.commands import begins, ends_of
from tests.report.live.visit import SCENE, Visitor, blue, dark, visit
from tests.soak.guests import Guest


@pytest.fixture(scope="module", autouse=True)
def _in_full(request: pytest.FixtureRequest) -> None:
    """Not in the ordinary tests."""
    if not request.config.getoption("--full"):
        pytest.skip("--full does everything on the live page")


@pytest.fixture
def at_rest(visitor: Visitor) -> Visitor:
    """A viewer whose string is at its start."""
    visitor.begin_again()
    return visitor


def test_the_past_can_be_gone_back_to(visitor: Visitor) -> None:
    """By seconds of the scene, while it is paused; then it goes on from there."""
    visitor.wait_until(2.0)
    visitor.pause()
    end = visitor.time
    visitor.type("back [s]", 1.0)
    then = visitor.once(lambda: visitor.time, lambda time: time < end)
    assert end - then < 1.1
    visitor.type("back [s]", 10.0)
    then = visitor.once(lambda: visitor.time, lambda time, before=then: time < before)
    visitor.play()
    visitor.once(lambda: visitor.time, lambda time: time > then)
    assert visitor.value("back [s]") == 0
    visitor.wait_until(end)


def test_a_mass_is_pinned_by_a_click_and_let_go_by_another(at_rest: Visitor, tmp_path: Path) -> None:
    """It is dark then, it stays where it is, and the command's file has it fixed."""
    x, y = at_rest.last_mass()
    around = {"x": x - 12, "y": y - 12, "width": 24, "height": 24}

    def is_dark() -> bool:
        return bool(dark(at_rest.scene_shown(around)).sum() > 10)

    assert not is_dark()
    at_rest.until(is_dark, lambda: at_rest.page.mouse.click(x, y))
    at_rest.play()
    at_rest.wait_until(0.3)
    at_rest.pause()
    line = at_rest.command("compare string-live.toml ", tmp_path)
    (state,) = ends_of(line, tmp_path).values()
    np.testing.assert_array_equal(state.positions[10], begins(line, tmp_path)[10])
    assert "fixed = [0, 10]" in (tmp_path / "string-live.toml").read_text()
    assert is_dark()
    at_rest.until(lambda: not is_dark(), lambda: at_rest.page.mouse.click(x, y))


def test_the_command_after_a_drag_comes_to_the_same_state(at_rest: Visitor, tmp_path: Path) -> None:
    """A mass is dragged and let go while everything swings; from where it was let go, to rounding."""
    at_rest.drag_last_mass(10, right=-60, down=60)
    at_rest.play(keys=True)
    at_rest.wait_until(0.2)
    at_rest.let_go()
    at_rest.wait_until(at_rest.time + 0.2)
    at_rest.pause()
    line = at_rest.command("compare string-live.toml ", tmp_path)
    (state,) = ends_of(line, tmp_path).values()
    at_rest.choose("lane 1", "heun")
    at_rest.see("heun")
    seen = begins(at_rest.command("--stepper=heun", tmp_path), tmp_path)
    np.testing.assert_allclose(state.positions, seen, rtol=0, atol=1e-12)


def test_the_picture_is_of_what_is_seen(at_rest: Visitor, tmp_path: Path) -> None:
    """As large as the scene is on the page, with the string in it."""
    file = at_rest.download("Picture", tmp_path)
    seen = Image.open(file)
    assert (file.name, seen.format) == ("string.png", "PNG")
    assert seen.width >= SCENE["width"]
    assert seen.height >= 0.9 * SCENE["height"]
    assert blue(np.asarray(seen.convert("RGB")).astype(int)).sum() > 100


def test_the_csv_has_what_was_measured(visitor: Visitor, tmp_path: Path) -> None:
    """A row for every frame, up to the time on the page."""
    visitor.wait_until(0.5)
    visitor.pause()
    file = visitor.download("CSV of this run", tmp_path)
    head, *rows = csv.reader(file.read_text().splitlines())
    assert file.name == "string.csv"
    assert head[:2] == ["time [s]", "kick_drift energy [J]"]
    times = np.array([float(row[0]) for row in rows])
    assert len(times) > 3
    assert (np.diff(times) > 0).all()
    assert times[-1] == pytest.approx(visitor.time, abs=5e-4)


def test_gravity_as_on_the_moon_and_on_jupiter(at_rest: Visitor) -> None:
    """The number beside it says so, and the command."""
    for place, gravity in (("Moon", 1.62), ("Jupiter", 24.79), ("Earth", 9.81)):
        at_rest.press(place, lambda wanted=gravity: at_rest.value("gravity [m/s^2]") == wanted)
        at_rest.command(f"--change=0.0:gravity={gravity}")


@pytest.mark.parametrize("slide", PRESETS)
def test_the_lectures_pictures_in_one_click(visitor: Visitor, slide: str) -> None:
    """The scene, the steppers and the parameters are set, and it moves; on slide 15 Euler blows up."""
    visitor.press(slide, lambda: visitor.says(f"{PRESETS[slide].scene}, t = ") and visitor.says("heun"), exact=True)
    for name, number in PRESETS[slide].parameters.items():
        assert visitor.value(f"{name} [N s/m]") == pytest.approx(number)
    if slide == "15":
        visitor.alert.filter(has_text="euler blew up").wait_for()
    else:
        visitor.wait_until(1.0)
        assert not visitor.alert.is_visible()


def test_an_engine_that_goes_to_nan_is_one_line_on_the_page(visitor: Visitor) -> None:
    """Pymunk does so in silence; the page pauses and says what happened, and everything goes on from there."""
    visitor.choose("lane 1", "pymunk_springs")
    visitor.see("pymunk_springs")
    visitor.type("dt [ms]", 100, visitor.alert.filter(has_text="pymunk_springs blew up").is_visible)
    visitor.press("Start again with dt", lambda: visitor.value("dt [ms]") < 20)
    visitor.wait_until(0.2)
    assert not visitor.alert.is_visible()


def test_a_scheme_with_parameters_is_a_lane_by_name(visitor: Visitor) -> None:
    """It has its limit and its place in the menus; a name that nothing has is one line, and no lane."""
    scheme = "drift_kick_sequential_damping(rounds=3)"
    for name, seen in (
        (scheme, lambda: visitor.says(f"{scheme}: dt is")),
        ("huen", visitor.page.get_by_text("unknown stepper 'huen': did you mean 'heun'?").first.is_visible),
    ):
        visitor.box("by name").fill(name)
        visitor.press("Add lane", seen)
    visitor.command(f"--stepper=kick_drift '--stepper={scheme}' ")
    visitor.choose("lane 1", scheme)
    # each lane goes on from where it was: a command for each
    for i in (1, 2):
        visitor.command(f"compare string-live-{i}.toml '--stepper={scheme}' ")


def test_what_makes_no_sense_is_one_line_and_put_back(visitor: Visitor) -> None:
    """A mass of nothing; the number is again what it was."""
    visitor.type("mass [kg]", 0, visitor.page.get_by_text("mass = 0: expected a number > 0").first.is_visible)
    visitor.once(lambda: visitor.value("mass [kg]"), lambda mass: mass == 0.02)


def test_eight_viewers_have_a_simulation_each_and_the_ninth_none(chromium: Any, address: str) -> None:
    """What one moves the others do not see; who comes when one has left is let in."""
    with ExitStack() as stack:
        one, other = (stack.enter_context(visit(chromium, address)) for _ in range(2))
        guests = [Guest(address) for _ in range(MOST_VIEWERS - 2)]
        one.see(f"{MOST_VIEWERS} viewers are here")
        limit = one.limit()
        other.type("stiffness [N/m]", 50)
        assert other.limit(unlike=limit) == pytest.approx(2 * limit, rel=1e-3)
        assert one.limit() == limit
        ninth = new_page(chromium)
        ninth.goto(address)
        ninth.get_by_text(FULL.format(MOST_VIEWERS)).wait_for()
        ninth.close()
        guests.pop().leave(politely=False)
        one.see(f"{MOST_VIEWERS - 1} viewers are here")
        with visit(chromium, address) as another:
            another.see(f"{MOST_VIEWERS} viewers are here")
        for guest in guests:
            guest.leave()
        one.see("2 viewers are here")


def test_slower_is_slower(visitor: Visitor) -> None:
    """At a twentieth of the speed a second shows at most a tenth of one, once that has arrived."""
    visitor.wait_until(0.05)
    visitor.type("speed [s of the scene in 1 s]", 0.05)
    paces = []
    for _ in range(20):
        begin = visitor.time
        visitor.page.wait_for_timeout(1000)
        paces.append(visitor.time - begin)
        if len(paces) > 1 and all(0 < pace < 0.1 for pace in paces[-2:]):
            return
    raise AssertionError(paces)
