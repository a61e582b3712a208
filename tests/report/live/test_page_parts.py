"""A viewer's page without a browser: what waits is done between frames, mistakes are said, files are sent."""

from __future__ import annotations

from io import BytesIO
from types import SimpleNamespace
from typing import Any
from unittest.mock import MagicMock, call

import numpy as np
import pytest
from PIL import Image

from reference.errors import InputError
from report.live import page as module
from report.live import scenes
from report.live.lab import Lab
from report.live.page import LATE, MOST_WAITING, RATE, SLOW_EVERY, Page
from report.live.parameters import PRESETS
from tests.report.live.labs import open_lab


@pytest.fixture
def page(labs: list[Lab], monkeypatch: pytest.MonkeyPatch) -> Page:
    """Of a string by two schemes; nobody draws it, no thread runs."""
    monkeypatch.setattr(Page, "_run", lambda self: None)
    monkeypatch.setattr(module, "guard_values", lambda client, say: client.guarded_by(say))
    made = Page(MagicMock(), "string", ["heun", "rk4"], lambda: "You are alone.")
    made._client.guarded_by.assert_called_once_with(made.say)
    made.lab = open_lab(labs, "string", ["heun", "rk4"])
    made.stage, made.controls, made._plots = MagicMock(), MagicMock(), MagicMock()
    return made


def said(page: Page) -> list[str]:
    """What the viewer was told."""
    return [told.args[1] for told in page._client.add_notification.call_args_list]


def test_what_is_asked_for_is_done_in_its_order_and_mistakes_are_said(
    page: Page, capsys: pytest.CaptureFixture[str]
) -> None:
    """What one thing fails with stops no other; a mistake of the lab's own is told with where it is."""
    done: list[int] = []

    def refuse() -> None:
        raise InputError("mass = -1: expected a number > 0")

    for action in (lambda: done.append(1), refuse, lambda: done.append(1 // 0), lambda: done.append(2)):
        page.do(action)
    page._do_all()
    assert done == [1, 2]
    mine, own = said(page)
    assert mine == "mass = -1: expected a number > 0"
    assert own == "This was not done, by a mistake of the lab's own: integer division or modulo by zero"
    assert "ZeroDivisionError" in capsys.readouterr().err


def test_no_more_waits_than_can_be_done(page: Page) -> None:
    """What comes on top of it is not done, and nobody has to wait."""
    done: list[int] = []
    for i in range(MOST_WAITING + 5):
        page.do(lambda i=i: done.append(i))  # type: ignore[misc]
    page._do_all()
    assert done == [*range(MOST_WAITING)]


def test_sentences_are_short_and_printable(page: Page) -> None:
    """300 letters at most; they go by themselves."""
    page.say("one\x1b[2J" + "o" * 1000)
    (text,) = said(page)
    assert len(text) <= 300
    assert text.isprintable()
    assert page._client.add_notification.call_args.args[0] == "springlab"
    assert page._client.add_notification.call_args.kwargs["auto_close_seconds"] > 1


def test_another_scene_plays_from_its_start_and_all_is_made_anew(page: Page) -> None:
    """Also where it cannot be opened; it has to be one of the menu's."""
    page.lab.advance(3)
    page.open("spring", {}, barrier=True)
    assert page.lab.timeline.opened.name == "spring"
    assert len(page.lab.timeline.system.obstacles) == 1
    assert (page.lab.playing, page.lab.timeline.time) == (True, 0.0)
    assert page.controls.renew.call_args_list == [call(page.lab)]
    page._plots.show.assert_called_once_with(page.lab.timeline.recorder)
    page.lab.playing = False
    with pytest.raises(InputError, match="masses"):
        page.open("string", {"masses": "none"})
    assert (page.lab.playing, page.lab.timeline.opened.name) == (False, "spring")
    assert page.controls.renew.call_count == 2
    for unknown in ("strin", "/etc/passwd"):
        with pytest.raises(InputError, match="unknown scene"):
            page.open(unknown)
    assert page.controls.renew.call_count == 2


def test_the_file_it_was_started_with_can_be_chosen_too(page: Page) -> None:
    """Before all others; a scene is not named twice."""
    assert page.scene_names() == scenes.names()
    page._scene = "own.toml"
    assert page.scene_names() == ["own.toml", *scenes.names()]


def test_a_picture_of_the_lecture_is_its_scene_stepper_dt_and_parameters(page: Page) -> None:
    """It plays; of a slide without one nothing changes."""
    page.preset("14")
    timeline = page.lab.timeline
    assert (timeline.opened.name, timeline.steppers, timeline.dt) == ("string", ("heun",), 1e-3)
    assert timeline.system.drag == PRESETS["14"].parameters["drag"] == 0.004
    assert page.lab.playing
    page.preset("15")
    assert page.lab.timeline.steppers == ("heun", "euler")
    assert page.controls.renew.call_count == 2
    with pytest.raises(InputError, match="unknown slide '98'"):
        page.preset("98")
    assert page.lab.timeline.steppers == ("heun", "euler")


def test_it_starts_again_with_a_stable_step(page: Page) -> None:
    """From the start, playing."""
    page.lab.advance(5)
    page.start_again_with(2e-3)
    assert (page.lab.timeline.dt, page.lab.timeline.time, page.lab.playing) == (2e-3, 0.0, True)


def test_drags_and_clicks_are_done_between_frames(page: Page) -> None:
    """A mass is held and let go of; pinned, and painted so."""
    page._dragged(3, np.array([0.3, 0.1]))
    assert page.lab.timeline.grabbed is None
    page._do_all()
    assert page.lab.timeline.grabbed == 3
    page._dragged(3, None)
    page._do_all()
    assert page.lab.timeline.grabbed is None
    page._pin(2)
    assert page.lab.timeline.system.fixed[2]
    page.stage.repaint.assert_called_once_with(page.lab.timeline)  # type: ignore[attr-defined]


def test_the_table_is_named_after_the_scene(page: Page) -> None:
    """What was recorded since the last reset."""
    page.lab.advance(3)
    page.csv()
    page._client.send_file_download.assert_called_once_with(
        "string.csv", page.lab.timeline.recorder.csv().encode(), save_immediately=True
    )


def test_a_picture_is_what_the_viewer_sees(page: Page) -> None:
    """Of the size of their screen, as PNG, named after the scene."""
    seen = np.arange(2 * 3 * 3, dtype=np.uint8).reshape(2, 3, 3)
    page._client.camera = SimpleNamespace(image_height=2, image_width=3)
    page._client.get_render.return_value = seen
    page._picture()
    assert page._client.get_render.call_args.args == (2, 3)
    name, content = page._client.send_file_download.call_args.args
    assert name == "string.png"
    with Image.open(BytesIO(content)) as image:
        assert image.format == "PNG"
        assert np.array(image).tolist() == seen.tolist()


@pytest.mark.parametrize("gone", [False, True])
def test_what_is_no_picture_is_said_to_who_is_still_there(page: Page, gone: bool) -> None:
    """Nothing is sent."""
    page._client.get_render.side_effect = TimeoutError("too late")
    if gone:
        page.end()
    page._picture()
    assert said(page) == ([] if gone else ["There is no picture: too late"])
    page._client.send_file_download.assert_not_called()


def test_one_picture_is_made_at_a_time(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    """In a thread that keeps nobody from ending; whoever asks meanwhile is not kept waiting. Then the next can be."""
    threads: list[Any] = []

    def thread(target: Any, daemon: bool) -> Any:
        threads.append(target)
        assert daemon
        return SimpleNamespace(start=lambda: None)

    monkeypatch.setattr(module.threading, "Thread", thread)
    page.picture()
    page.picture()
    assert len(threads) == 1
    page._client.get_render.side_effect = TimeoutError
    monkeypatch.setattr(page, "_picture", MagicMock(side_effect=ZeroDivisionError))
    with pytest.raises(ZeroDivisionError):
        threads[0]()
    page.picture()
    assert len(threads) == 2


class Clock:
    """In place of `time`: asleep, time goes by; each frame takes some besides."""

    def __init__(self, page: Page, frames: int, each: float, gap: dict[int, float]) -> None:
        self.now, self.slept, self.each = 100.0, [], each  # type: ignore[var-annotated]
        self.page, self.frames, self.gap = page, frames, gap

    def perf_counter(self) -> float:
        """As it is now."""
        return self.now

    def sleep(self, seconds: float) -> None:
        """As long, and then the next frame's work."""
        self.slept.append(seconds)
        self.now += seconds + self.gap.get(self.page.frames, self.each)
        if self.page.frames == self.frames:
            self.page.end()


def test_frames_come_in_their_rate_and_are_told_how_much_time_has_passed(
    page: Page, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A sixtieth of a second from one to the next; late by much, that is lost; slow things are shown now and then."""
    frames: list[float] = []
    clock = Clock(page, 30, 0.004, {10: 0.5})
    monkeypatch.setattr(module, "time", clock)
    monkeypatch.setattr(page.lab, "frame", frames.append)
    page._frames()
    assert frames[0] == 0
    assert frames[1:10] == pytest.approx([1 / RATE + 0.004, *[1 / RATE] * 8])
    assert frames[10] == pytest.approx(0.1)
    assert clock.slept[10:12] == [0.001, 0.001]
    assert sum(clock.slept[10:]) + 0.5 + 19 * 0.004 == pytest.approx(20 / RATE + (0.5 - LATE), abs=0.03)
    assert page.frames == 30
    assert page.stage.show.call_args_list == [call(page.lab.timeline)] * 30  # type: ignore[attr-defined]
    assert page.controls.show.call_args_list == [call(page.lab, "You are alone.")] * -(-30 // SLOW_EVERY)
    assert page.controls.removal.remove_old.call_count == page._plots.show.call_count == 3


def test_its_own_thread_opens_a_lab_and_ends_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Playing, with everything made for it; then the lab is ended."""
    parts = {name: MagicMock() for name in ("Stage", "Controls", "Plots", "guard_values")}
    for name, part in parts.items():
        monkeypatch.setattr(module, name, part)
    ended: list[bool] = []
    monkeypatch.setattr(Page, "_frames", lambda self: ended.append(self.lab.playing))
    monkeypatch.setattr(Lab, "end", lambda self: ended.append(False))
    page = Page(MagicMock(), "string", ["heun"], lambda: "")
    page.wait()
    assert ended == [True, False]
    assert not page._thread.is_alive()
    assert page._thread.daemon
    (client, on_drag, _), _ = parts["Stage"].call_args
    assert (client, on_drag) == (page._client, page._dragged)
    assert parts["Controls"].call_args.args == (page._client, page)
    assert parts["Plots"].call_args.args == (page._client, page.controls.room_for_plots, page.controls.removal)
    parts["Controls"].return_value.renew.assert_called_once_with(page.lab)


@pytest.mark.parametrize("gone", [False, True])
def test_what_stops_it_is_said_to_who_is_still_there(
    page: Page, gone: bool, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A file that is gone in its own line; a mistake of the lab's with where it is, unless the viewer has left."""
    monkeypatch.undo()
    if gone:
        page.end()
    page._scene = "gone.toml"
    page._run()
    assert len(said(page)) == 1
    assert "gone.toml" in said(page)[0]
    assert capsys.readouterr().err == ""
    page._scene = "string"
    monkeypatch.setattr(Page, "_open", lambda self: 1 // 0)
    page._run()
    assert len(said(page)) == 2 - gone
    assert ("ZeroDivisionError" in capsys.readouterr().err) == (not gone)
    assert gone or said(page)[1].startswith("The lab has stopped here, by a mistake of its own (integer division")
