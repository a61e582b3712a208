"""A visit to the live lab: `springlab live` in a process of its own, and a browser that looks at it."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.report.browser import chromium

ROOT = Path(__file__).parents[3]

#: WebGL by software, on machines without a graphics card.
WEBGL = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")

#: So long [ms] something may take to be seen, on a busy machine.
PATIENCE = 30_000


@contextmanager
def server(*words: str) -> Iterator[tuple[str, subprocess.Popen[str]]]:
    """`springlab live` at a free port: its address, and its process. It has to end when it is told to."""
    command = [sys.executable, "-m", "experiments.command_line", "live", "--no-open", "--port=0", *words]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    pipes: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    with subprocess.Popen(command, env=environment, **pipes) as process:
        try:
            assert process.stdout is not None
            line = process.stdout.readline()
            found = re.search(r"http://\S+", line)
            assert found, line
            yield found[0], process
        finally:
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=30)[0]
            assert "Traceback" not in said, said


@contextmanager
def browser() -> Iterator[Any]:
    """Chromium with WebGL."""
    with chromium(*WEBGL) as found:
        yield found


class Visitor:
    """One viewer's page.

    Attributes:
        page: Playwright's.
        asked: addresses it asked for.
        errors: what it complained of.
    """

    def __init__(self, browser: Any, address: str) -> None:
        self.asked: list[str] = []
        self.errors: list[str] = []
        self.page = browser.new_page(viewport={"width": 1280, "height": 900})
        self.page.set_default_timeout(PATIENCE)
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.on("console", lambda m: self.errors.append(m.text) if m.type == "error" else None)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.goto(address)
        self.status.wait_for()

    @property
    def status(self) -> Any:
        """The line with the time and the limits."""
        return self.page.get_by_role("status").filter(has_text="t = ")

    @property
    def alert(self) -> Any:
        """The banner."""
        return self.page.get_by_role("alert").filter(has_text=re.compile("blew up|stopped"))

    @property
    def time(self) -> float:
        """Of the scene [s]."""
        found = re.search(r"t = ([\d.]+) s", self.status.inner_text())
        assert found
        return float(found[1])

    def limit(self) -> float:
        """The predicted largest stable dt that is shown [ms]."""
        said = self.status.filter(has_text="largest stable dt")
        said.wait_for()
        found = re.search(r"largest stable dt, ([\d.e-]+) ms", said.inner_text())
        assert found
        return float(found[1])

    def type(self, label: str, value: float) -> None:
        """Type a number."""
        box = self.page.get_by_label(label, exact=True)
        box.fill(f"{value:.6g}")
        box.press("Enter")

    def choose(self, label: str, option: str) -> None:
        """Choose from a menu."""
        self.page.get_by_label(label, exact=True).click()
        self.page.get_by_role("option", name=option, exact=True).click()

    def press(self, name: str) -> None:
        """Press a button."""
        self.page.get_by_role("button", name=name).click()

    def wait_until(self, time: float) -> None:
        """Until the scene has come so far [s]."""
        self.page.wait_for_function(
            f"() => [...document.querySelectorAll('[role=status]')].some(e => "
            f"parseFloat((e.textContent.match(/t = ([0-9.]+) s/) || [])[1]) > {time})"
        )

    def rightmost_mass(self) -> tuple[int, int]:
        """Where the mass farthest to the right is on the screen [px], by its colour: blue, in whatever light."""
        from io import BytesIO

        import numpy as np
        from PIL import Image

        seen = np.asarray(Image.open(BytesIO(self.page.screenshot())).convert("RGB")).astype(int)
        r, g, b = seen[:, 350:890].transpose(2, 0, 1)
        rows, columns = np.nonzero((b > 130) & (b > r + 80) & (g > 70))
        last = columns.max()
        return 350 + int(last) - 3, int(np.median(rows[columns >= last - 4]))

    def command(self) -> str:
        """What "Copy command" shows."""
        self.press("Copy command")
        area = self.page.get_by_label("command", exact=True)
        area.wait_for()
        return str(area.input_value())
