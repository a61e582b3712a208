"""A visit to the live lab: `springlab live` in a process of its own, and a browser that looks at it."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from tests.report.chromium import chromium

ROOT = Path(__file__).parents[3]

#: WebGL by software, on machines without a graphics card.
WEBGL = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")

#: So long [ms] something may take to be seen, on a busy machine; and [s] the server to end.
PATIENCE, FAREWELL = 600_000, 600

#: So long [ms] one click may take to be seen, before it is made again.
SOON = 5_000

#: So many pictures a second, each of so many points to a pixel along each side: the processor alone draws them.
PICTURES, GRAIN = 5, 0.5
SLOWLY = f"window.requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), {1000 // PICTURES})"

#: What viser's own page has to say against itself when something is dragged; nothing comes of it.
THEIRS = ("Unable to preventDefault inside passive event listener invocation.",)

#: The window [px], and the part of it between the panels, where the scene is.
WINDOW = {"width": 1280, "height": 720}
SCENE = {"x": 355, "y": 0, "width": 520, "height": 720}


def command_line(*words: str) -> list[str]:
    """`springlab live` without a browser of its own."""
    return [sys.executable, "-m", "report.commands.main", "live", "--no-open", *words]


@contextmanager
def server(*words: str) -> Iterator[tuple[str, subprocess.Popen[str]]]:
    """`springlab live` at a free port: its address, and its process. It has to end when it is told to, and in peace.

    It is told by SIGTERM: of SIGINT a process in the background knows nothing.
    """
    # Of one that does not end the stacks of its threads are seen.
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONFAULTHANDLER": "1"}
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        environment.pop(name, None)
    pipes: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    with subprocess.Popen(command_line("--port=0", *words), env=environment, **pipes) as process:
        try:
            assert process.stdout is not None
            before = []
            while not (found := re.search(r"http://\S+", line := process.stdout.readline())):
                before.append(line)
                assert line, "".join(before)
            process.said = before  # type: ignore[attr-defined]
            yield found[0], process
        finally:
            process.send_signal(signal.SIGTERM)
            try:
                said = process.communicate(timeout=FAREWELL)[0]
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGABRT)
                said = process.communicate()[0]
            assert process.returncode == 0, said
            assert said.strip() == "", said


@contextmanager
def browser() -> Iterator[Any]:
    """Chromium with WebGL."""
    with chromium(*WEBGL) as found:
        yield found


@contextmanager
def visit(browser: Any, address: str) -> Iterator[Visitor]:
    """One viewer, who leaves in the end."""
    found = Visitor(browser, address)
    yield found
    found.leave()


class Visitor:
    """One viewer's page.

    Attributes:
        page: Playwright's.
        asked: addresses it asked for.
        errors: what it complained of.
    """

    def __init__(self, browser: Any, address: str, window: dict[str, int] = WINDOW) -> None:
        self.asked: list[str] = []
        self.errors: list[str] = []
        self._address = address
        self.page = browser.new_page(viewport=window, device_scale_factor=GRAIN)
        self.page.set_default_timeout(PATIENCE)
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.on("console", lambda m: self.errors.append(m.text) if m.type == "error" else None)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.add_init_script(SLOWLY + "; window.cancelAnimationFrame = clearTimeout")
        self.page.goto(address)
        self.status.wait_for()

    def leave(self) -> None:
        """They have asked for nothing from elsewhere, and had no error."""
        elsewhere = [url for url in self.asked if not re.match(rf"(blob:)?{self._address}/|data:", url)]
        self.page.close()
        assert (elsewhere, [error for error in self.errors if error not in THEIRS]) == ([], [])

    # What they see.

    @property
    def status(self) -> Any:
        """The line with the time and the limits."""
        return self.page.get_by_role("status").filter(has_text="t = ")

    @property
    def alert(self) -> Any:
        """The banner, which stays; what passes by says the same."""
        return self.page.locator("[role=alert][style*='border-left']").filter(has_text=re.compile("blew up|stopped"))

    @property
    def passing(self) -> Any:
        """What is said for a while, over the scene."""
        return self.page.locator(".mantine-Notification-root")

    def see(self, words: str) -> None:
        """Wait until the status says so."""
        self.status.filter(has_text=words).wait_for()

    @property
    def time(self) -> float:
        """Of the scene [s]."""
        found = re.search(r"t = ([\d.]+) s", self.status.inner_text())
        assert found
        return float(found[1])

    def wait_until(self, time: float) -> None:
        """Until the scene has come so far [s]."""
        self.once(self.status.inner_text, lambda said: float(said.split("t = ")[1].split(" s")[0]) > time)

    def limit(self, unlike: float = 0.0) -> float:
        """The predicted largest stable dt that is shown [ms], once it is another than that."""

        def shown() -> float:
            found = re.search(r"largest stable dt, ([\d.e-]+) ms", self.status.inner_text())
            return float(found[1]) if found else unlike

        return float(self.once(shown, lambda limit: limit != unlike))

    def value(self, label: str) -> float:
        """The number in a box."""
        return float(self.box(label).input_value())

    def box(self, label: str) -> Any:
        """The box for a number; of viser's own sliders it has no label that it knows of."""
        row = self.page.get_by_text(label, exact=True).locator("xpath=ancestor::div[.//input][1]")
        return row.locator("input:not([type=hidden])")

    def once(self, look: Callable[[], Any], seen: Callable[[Any], bool]) -> Any:
        """What is looked at again and again, once it is as it should be."""
        for _ in range(PATIENCE // 50):
            found = look()
            if seen(found):
                return found
            self.page.wait_for_timeout(50)
        raise AssertionError(f"still {found}")

    def scene_shown(self, part: dict[str, int] = SCENE) -> np.ndarray:
        """A part of the page, as rows of colours."""
        from PIL import Image

        picture = Image.open(BytesIO(self.page.screenshot(clip=part, scale="css"))).convert("RGB")
        assert picture.size == (part["width"], part["height"])
        return np.asarray(picture).astype(int)

    def last_mass(self) -> tuple[int, int]:
        """Where the mass farthest to the right is in the window [px], once the picture stands still."""
        before = self.scene_shown()
        while True:
            seen = self.scene_shown()
            if (seen == before).all() and blue(seen).any():
                break
            before = seen
        rows, columns = np.nonzero(blue(seen))
        last = int(columns.max())
        return SCENE["x"] + last - 3, SCENE["y"] + int(np.median(rows[columns >= last - 4]))

    # What they do.

    def type(self, label: str, value: float) -> None:
        """Type a number."""
        box = self.box(label)
        box.fill(f"{value:.6g}")
        box.press("Enter")

    def choose(self, label: str, option: str) -> None:
        """Choose from a menu; again where the page was drawn anew in between, and the mouse has missed it."""
        from playwright.sync_api import TimeoutError as Missed
        from playwright.sync_api import expect

        menu = self.page.get_by_label(label, exact=True)

        def chosen() -> str:
            """What the menu says after one try, which is soon seen or not at all."""
            menu.click()
            with suppress(Missed, AssertionError):
                self.page.get_by_role("option", name=option, exact=True).click(timeout=SOON)
                expect(menu).to_have_value(option, timeout=SOON)
            return str(menu.input_value())

        self.once(chosen, lambda said: said == option)

    def press(self, name: str, exact: bool = False) -> None:
        """Press a button."""
        self.page.get_by_role("button", name=name, exact=exact).click()

    def press_key(self, name: str) -> None:
        """Press a button by the keyboard, while the mouse does something else."""
        self.page.get_by_role("button", name=name, exact=True).press("Enter")

    def pause(self) -> None:
        """And see that it has."""
        self.press("Pause")
        self.see(" s, paused")

    def begin_again(self) -> None:
        """At rest at its start."""
        self.pause()
        self.press("Reset")
        self.see("t = 0.000 s, paused")

    def slide_dt(self, beyond: float) -> None:
        """Drag the slider of dt to so many pixels beyond the mark of the limit.

        Where the page was drawn anew in between, the mouse has missed it, and drags again.
        """
        slider = self.page.locator(".multi-slider-track-container").filter(has_text="▲")
        mark = slider.locator(".multi-slider-mark-wrapper").filter(has_text="▲")
        thumb = slider.locator(".multi-slider-thumb")

        def missed_by() -> float:
            """How far the thumb is from where it should be, after one drag [px]."""
            (x, y), aim = centre(thumb), centre(mark)[0] + beyond
            self.page.mouse.move(x, y)
            self.page.mouse.down()
            self.page.mouse.move(aim, y, steps=4)
            self.page.mouse.up()
            return abs(centre(thumb)[0] - centre(mark)[0] - beyond)

        self.once(missed_by, lambda pixels: pixels < 3)

    def command(self, holds: str, folder: Path | None = None) -> str:
        """What "Copy command" shows, once it holds some words; the file it needs is kept in a folder."""
        if folder is None:
            self.press("Copy command")
        else:
            with self.page.expect_download() as download:
                self.press("Copy command")
            download.value.save_as(folder / download.value.suggested_filename)
        area = self.page.get_by_label("command", exact=True)
        area.wait_for()
        return str(self.once(area.input_value, lambda text: holds in text))

    def download(self, button: str, folder: Path) -> Path:
        """A file that is there for a button."""
        with self.page.expect_download() as download:
            self.press(button)
        file = folder / download.value.suggested_filename
        download.value.save_as(file)
        return file


def centre(element: Any) -> tuple[float, float]:
    """Where the middle of an element is in the window [px]."""
    box = element.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def blue(picture: np.ndarray) -> np.ndarray:
    """Where masses of the first world are, in whatever light."""
    r, g, b = picture.transpose(2, 0, 1)
    return np.asarray((b > 130) & (b > r + 80) & (g > 70))


def dark(picture: np.ndarray) -> np.ndarray:
    """Where fixed masses are."""
    return np.asarray(picture.max(axis=2) < 90)
