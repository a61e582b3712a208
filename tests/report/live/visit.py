"""A visit to the live lab: `springlab live` in a process of its own, and a browser that looks at it."""

from __future__ import annotations

import math
import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from io import BytesIO
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np

from tests.report.chromium import chromium

ROOT = Path(__file__).parents[3]

#: WebGL by software, on machines without a graphics card.
WEBGL = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")

#: So long [ms] something may take to be seen, on a busy machine; and [s] the server to end.
PATIENCE, FAREWELL = 600_000, 600

#: So long [ms] what the mouse does may take to be seen, before it is done again; then twice as long, and so on.
SOON = 5_000

#: So many pictures a second, each of so many points to a pixel along each side: the processor alone draws them.
PICTURES, GRAIN = 5, 0.5
SLOWLY = f"window.requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), {1000 // PICTURES})"

#: Keeps what is said for a while, as on a busy machine it may have gone before anybody looks.
KEEP_SAID = """window.said = [];
new MutationObserver(() => {
    for (const {textContent} of document.querySelectorAll(".mantine-Notification-root"))
        if (!window.said.includes(textContent)) window.said.push(textContent);
}).observe(document, {childList: true, subtree: true, characterData: true});"""

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
        has_chosen: whether anything has been chosen from its menus.
    """

    def __init__(self, browser: Any, address: str, window: dict[str, int] = WINDOW) -> None:
        self.asked: list[str] = []
        self.errors: list[str] = []
        self.has_chosen = False
        self._address = address
        self.page = browser.new_page(viewport=window, device_scale_factor=GRAIN)
        self.page.set_default_timeout(PATIENCE)
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.on("console", lambda m: self.errors.append(m.text) if m.type == "error" else None)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.add_init_script(SLOWLY + "; window.cancelAnimationFrame = clearTimeout")
        self.page.add_init_script(KEEP_SAID)
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

    def is_told(self, words: str) -> None:
        """Wait until it is said for a while, over the scene, or has been said already."""
        self.once(lambda: self.page.evaluate("window.said"), lambda said: any(words in one for one in said))

    def see(self, words: str) -> None:
        """Wait until the status says so."""
        self.status.filter(has_text=words).wait_for()

    def says(self, words: str) -> bool:
        """Whether the status says so now."""
        return words in self.status.inner_text()

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
        end = monotonic() + PATIENCE / 1000
        while not seen(found := look()):
            assert monotonic() < end, f"still {found}"
            self.page.wait_for_timeout(50)
        return found

    def until(self, seen: Callable[[], Any], do: Callable[[], object]) -> None:
        """Do something, and again where it is not seen to be done soon: what is done twice must be as done once.

        Where the page is laid out anew in between, the mouse misses, and nothing comes of it.
        """
        from playwright.sync_api import Error

        for patience in (SOON * 2**k for k in range(7)):
            with suppress(Error):
                do()
            end = monotonic() + patience / 1000
            while monotonic() < end:
                if seen():
                    return
                self.page.wait_for_timeout(50)
        raise AssertionError(f"done again and again, and never seen: {self.status.inner_text()}")

    def scene_shown(self, part: dict[str, int] = SCENE) -> np.ndarray:
        """A part of the page, as rows of colours."""
        from PIL import Image

        picture = Image.open(BytesIO(self.page.screenshot(clip=part, scale="css"))).convert("RGB")
        assert picture.size == (part["width"], part["height"])
        return np.asarray(picture).astype(int)

    def last_mass(self) -> tuple[int, int]:
        """Where the mass farthest to the right is in the window [px], once the picture stands still."""
        before = self.scene_shown()

        def still() -> bool:
            """Whether it is as it was before."""
            nonlocal before
            last, before = before, self.scene_shown()
            return bool((last == before).all() and blue(before).any())

        self.once(still, bool)
        rows, columns = np.nonzero(blue(before))
        last = int(columns.max())
        return SCENE["x"] + last - 3, SCENE["y"] + int(np.median(rows[columns >= last - 4]))

    # What they do.

    def type(self, label: str, value: float, seen: Callable[[], Any] | None = None) -> None:
        """Type a number, which then stands there, or is seen otherwise."""
        box = self.box(label)

        def typed() -> None:
            box.fill(f"{value:.6g}", timeout=SOON)
            box.press("Enter", timeout=SOON)

        self.until(seen or (lambda: box.input_value() and float(box.input_value()) == float(f"{value:.6g}")), typed)

    def choose(self, label: str, option: str) -> None:
        """Choose from a menu."""
        menu = self.page.get_by_label(label, exact=True)
        self.has_chosen = True

        def chosen() -> None:
            menu.click(timeout=SOON)
            self.page.get_by_role("option", name=option, exact=True).click(timeout=SOON)

        self.until(lambda: menu.input_value() == option, chosen)

    def press(self, name: str, seen: Callable[[], Any], exact: bool = False) -> None:
        """Press a button, until what it does is seen."""
        button = self.page.get_by_role("button", name=name, exact=exact)
        self.until(seen, lambda: button.click(timeout=SOON))

    def play(self, keys: bool = False) -> None:
        """And see that it goes on; by the keyboard where the mouse does something else."""
        button = self.page.get_by_role("button", name="Play", exact=True)
        press = (lambda: button.press("Enter", timeout=SOON)) if keys else (lambda: button.click(timeout=SOON))
        self.until(lambda: not self.says(", paused"), press)

    def pause(self) -> None:
        """And see that it has."""
        self.press("Pause", lambda: self.says(" s, paused"))

    def begin_again(self) -> None:
        """At rest at its start."""
        self.pause()
        self.press("Reset", lambda: self.says("t = 0.000 s, paused"))

    def drag_last_mass(self, number: int, right: int, down: int) -> None:
        """Take a mass of a scene at rest, the farthest to the right, so many pixels from its place, and hold it."""
        mouse, tried = self.page.mouse, False

        def drag() -> None:
            nonlocal tried
            if tried:
                mouse.up()
                self.begin_again()
            tried = True
            x, y = self.last_mass()
            mouse.move(x, y)
            mouse.down()
            mouse.move(x + right, y + down, steps=6)

        self.until(lambda: self.says(f"Mass {number} hangs on the cursor"), drag)

    def let_go(self) -> None:
        """Of what hangs on the cursor."""
        self.until(lambda: not self.says("hangs"), self.page.mouse.up)

    def slide_dt(self, beyond: float) -> None:
        """Drag the slider of dt to so many pixels beyond the mark of the limit."""
        slider = self.page.locator(".multi-slider-track-container").filter(has_text="▲")
        mark = slider.locator(".multi-slider-mark-wrapper").filter(has_text="▲")
        thumb = slider.locator(".multi-slider-thumb")

        def drag() -> None:
            (x, y), aim = centre(thumb), centre(mark)[0] + beyond
            self.page.mouse.move(x, y)
            self.page.mouse.down()
            self.page.mouse.move(aim, y, steps=4)
            self.page.mouse.up()

        self.until(lambda: abs(centre(thumb)[0] - centre(mark)[0] - beyond) < 3, drag)

    def command(self, holds: str, folder: Path | None = None) -> str:
        """What "Copy command" shows, once it holds some words; the file it needs is kept in a folder."""
        area = self.page.get_by_label("command", exact=True)
        if folder is not None:
            self.download("Copy command", folder)

        def shown() -> bool:
            """Whether the words are there, or nothing yet."""
            return bool(area.is_visible() and holds in area.input_value())

        if folder is None:
            self.press("Copy command", shown)
        else:
            self.once(shown, bool)
        return str(area.input_value())

    def download(self, button: str, folder: Path) -> Path:
        """A file that is there for a button."""
        got: list[Any] = []

        def handed() -> None:
            with self.page.expect_download(timeout=SOON) as download:
                self.page.get_by_role("button", name=button).click(timeout=SOON)
            got.append(download.value)

        self.until(lambda: got, handed)
        file = folder / got[0].suggested_filename
        got[0].save_as(file)
        return file


def centre(element: Any) -> tuple[float, float]:
    """Where the middle of an element is in the window [px]; nowhere where it is not shown just now."""
    box = element.bounding_box()
    if box is None:
        return math.nan, math.nan
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def blue(picture: np.ndarray) -> np.ndarray:
    """Where masses of the first world are, in whatever light."""
    r, g, b = picture.transpose(2, 0, 1)
    return np.asarray((b > 130) & (b > r + 80) & (g > 70))


def dark(picture: np.ndarray) -> np.ndarray:
    """Where fixed masses are."""
    return np.asarray(picture.max(axis=2) < 90)
