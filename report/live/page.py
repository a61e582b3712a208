"""The page of one viewer: a lab of their own, what it shows, and what they can move. All else is in `lab`.

What viewers do arrives in other threads; it is put in a queue and done between two frames, in the page's own thread.
"""

from __future__ import annotations

import contextlib
import queue
import sys
import threading
import time
import traceback
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from reference.errors import InputError, unknown_name
from reference.printable import printable
from report.live import scenes
from report.live.controls import Controls
from report.live.lab import Lab
from report.live.parameters import PRESETS
from report.live.plots import Plots
from report.live.stage import Stage
from report.live.values import guard_values
from report.plain import shortened

if TYPE_CHECKING:
    from viser import ClientHandle

#: Frames in a second, and how many go by between two looks at what is slow to show.
RATE, SLOW_EVERY = 60, 12

#: So much can wait to be done between two frames; what comes on top of that is not done.
MOST_WAITING = 1000

#: No sentence is longer.
SENTENCE = 300

#: How much of being late is made up for [s]; more than that is lost.
LATE = 0.1


class Page:
    """One viewer's page, in a thread of its own until `end`.

    Args:
        client: the viewer.
        scene, steppers: to begin with.
        company: says how many viewers there are.

    Attributes:
        frames: how many there have been.
        lab: what is shown and moved, once the thread has made it; and so are the others.
        stage: where it is shown.
        controls: what can be moved and read.
    """

    lab: Lab
    stage: Stage
    controls: Controls

    def __init__(self, client: ClientHandle, scene: str, steppers: Sequence[str], company: Callable[[], str]) -> None:
        self._client, self._company, self._steppers = client, company, tuple(steppers)
        self._todo: queue.Queue[Callable[[], None]] = queue.Queue(MOST_WAITING)
        self._picturing = threading.Lock()
        guard_values(client, self.say)
        self._ended = threading.Event()
        self._scene = scene
        self.frames = 0
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def end(self) -> None:
        """The viewer is gone: no more frames."""
        self._ended.set()

    def wait(self) -> None:
        """Until the last frame is done, but not for long."""
        self._thread.join(5)

    def do(self, action: Callable[[], None]) -> None:
        """Have something done between two frames, unless too much is waiting for that."""
        with contextlib.suppress(queue.Full):
            self._todo.put_nowait(action)

    # The thread.

    def _run(self) -> None:
        lab = None
        try:
            with np.errstate(all="ignore"):  # numbers that leave all bounds are seen in the lanes, which stop
                lab = self.lab = Lab(self._scene, self._steppers)
                self._open()
                self._frames()
        except InputError as error:
            # The file it was started with may be gone.
            self.say(str(error))
        except Exception as error:
            # A viewer that is gone in the middle of a frame is no error.
            if not self._ended.is_set():
                traceback.print_exc(file=sys.stderr)
                self.say(f"The lab has stopped here, by a mistake of its own ({error}): load the page again.")
        finally:
            if lab is not None:
                lab.end()

    def _open(self) -> None:
        self.stage = Stage(self._client, self._dragged, lambda mass: self.do(lambda: self._pin(mass)))
        self.controls = Controls(self._client, self)
        self._plots = Plots(self._client, self.controls.room_for_plots, self.controls.removal)
        self.renew()
        # a viewer is here once their page has drawn a picture: a tab in the background has not
        self.lab.play()

    def _frames(self) -> None:
        before = due = time.perf_counter()
        while not self._ended.is_set():
            self._do_all()
            now = time.perf_counter()
            self.lab.frame(min(now - before, 0.1))
            before = now
            self.stage.show(self.lab.timeline)
            if self.frames % SLOW_EVERY == 0:
                self._show_slow()
            self.frames += 1
            # from one frame's due time to the next one's, as sleeping takes longer than asked
            due = max(due + 1 / RATE, time.perf_counter() - LATE)
            time.sleep(max(due - time.perf_counter(), 0.001))

    def _do_all(self) -> None:
        while True:
            try:
                action = self._todo.get_nowait()
            except queue.Empty:
                return
            try:
                action()
            except InputError as error:
                self.say(str(error))
            except Exception as error:
                traceback.print_exc(file=sys.stderr)
                self.say(f"This was not done, by a mistake of the lab's own: {error}")

    def _show_slow(self) -> None:
        self._plots.show(self.lab.timeline.recorder)
        self.controls.show(self.lab, self._company())
        self.controls.removal.remove_old()

    # What viewers do.

    def renew(self) -> None:
        """The lab has another scene, or other lanes: all that depends on it is made anew."""
        self.controls.renew(self.lab)
        self._show_slow()

    def open(self, scene: str, settings: dict[str, str] | None = None, barrier: bool | None = None) -> None:
        """Another scene that can be chosen, or the same with other parameters. Raises InputError."""
        if scene not in self.scene_names():
            raise unknown_name("scene", shortened(scene), scenes.names())
        try:
            self.lab.open(scene, settings, barrier)
            self.lab.play()
        finally:
            self.renew()

    def preset(self, slide: str) -> None:
        """One of the lecture's pictures. Raises InputError for a slide without one."""
        if slide not in PRESETS:
            raise unknown_name("slide", shortened(slide), PRESETS)
        preset = PRESETS[slide]
        self.lab.set_steppers(preset.steppers)
        self.lab.open(preset.scene, dt=preset.dt)
        for name, number in preset.parameters.items():
            self.lab.set_parameter(name, number)
        self.renew()
        self.lab.play()

    def start_again_with(self, dt: float) -> None:
        """From the start, with a step that is stable."""
        self.lab.reset()
        self.lab.set_dt(dt)
        self.lab.play()

    def _dragged(self, mass: int, place: np.ndarray | None) -> None:
        self.do(self.lab.release if place is None else lambda: self.lab.grab(mass, place))

    def _pin(self, mass: int) -> None:
        self.lab.toggle_pin(mass)
        self.stage.repaint(self.lab.timeline)

    def say(self, text: str) -> None:
        """A sentence, for a while."""
        text = shortened(printable(text), SENTENCE)
        self._client.add_notification("springlab", text, auto_close_seconds=8.0, color="orange")

    def download(self, name: str, content: bytes) -> None:
        """A file for the viewer."""
        self._client.send_file_download(name, content, save_immediately=True)

    def picture(self) -> None:
        """What is seen, as a PNG file; one at a time."""
        if not self._picturing.acquire(blocking=False):
            return

        def ask() -> None:
            try:
                self._picture()
            finally:
                self._picturing.release()

        # The browser's answer may take a while: not in the thread that makes frames.
        threading.Thread(target=ask, daemon=True).start()

    def _picture(self) -> None:
        from io import BytesIO

        from PIL import Image

        camera = self._client.camera
        try:
            seen = self._client.get_render(camera.image_height, camera.image_width, timeout=10.0)
        except Exception as error:  # what a viewer sends need not be a picture: then nobody gets one
            if not self._ended.is_set():
                self.say(f"There is no picture: {error}")
            return
        file = BytesIO()
        Image.fromarray(seen).save(file, "PNG")
        self.download(f"{self.lab.timeline.opened.stem}.png", file.getvalue())

    def csv(self) -> None:
        """What was measured since the last reset."""
        self.download(f"{self.lab.timeline.opened.stem}.csv", self.lab.timeline.recorder.csv().encode())

    def scene_names(self) -> list[str]:
        """What can be chosen: the scenes, and the file the lab was started with."""
        known = scenes.names()
        return known if self._scene in known else [self._scene, *known]
