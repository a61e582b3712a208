"""A page opened in headless Chromium: Debian's, driven by Playwright."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

#: What is looked at: width [px], colours, medium.
VIEWS = [(1280, "light", "screen"), (1280, "dark", "screen"), (360, "light", "screen"), (360, "dark", "screen")]
VIEWS += [(800, "dark", "print")]

#: So long [ms] anything in a browser may take, on a busy machine.
PATIENCE = 120_000


@contextmanager
def chromium(*graphics: str) -> Iterator[Any]:
    """The browser; where there is none the test is skipped, but never in CI. Without graphics unless told how."""
    found = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if found is None:
        if os.environ.get("CI"):
            pytest.fail("chromium is not installed, and in CI it must be: see .ci/run")
        pytest.skip("chromium is not installed")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=found, args=["--no-sandbox", *(graphics or ["--disable-gpu"])], timeout=PATIENCE
        )
        try:
            yield browser
        finally:
            browser.close()


def new_page(browser: Any, **how: Any) -> Any:
    """A new page of a browser, as Playwright has it, that is patient."""
    page = browser.new_page(**how)
    page.set_default_timeout(PATIENCE)
    return page


#: A page that draws so many pictures a second, as the processor alone paints them: for who does not count them.
CALMLY = "window.requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), 50)"


class Shown:
    """A page as it is shown, and what it asked for and complained of meanwhile.

    Attributes:
        complaints: errors and warnings in the console.
    """

    def __init__(
        self, browser: Any, file: Path, view: tuple[int, str, str], state: str = "", calmly: bool = False
    ) -> None:
        width, colours, medium = view
        self._asked: list[str] = []
        self.complaints: list[str] = []
        self.page = new_page(browser, viewport={"width": width, "height": 900}, color_scheme=colours)
        self.page.emulate_media(media=medium)
        self._address = file.resolve().as_uri()
        self.page.on("request", lambda request: self._asked.append(request.url))
        self.page.on("console", lambda m: self.complaints.append(m.text) if m.type in ("error", "warning") else None)
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        if calmly:
            self.page.add_init_script(CALMLY)
        self.page.goto(f"{self._address}#{state}" if state else self._address)

    @property
    def requests(self) -> list[str]:
        """Addresses it asked for, but its own, and what it holds itself."""
        return [url for url in self._asked if url != self._address and not url.startswith(("data:", "blob:"))]

    def violations(self) -> list[str]:
        """What axe-core has to say against the page, each with the place, all that is folded opened."""
        from axe_playwright_python.sync_playwright import Axe

        self.page.evaluate("for (const d of document.querySelectorAll('details')) d.open = true")
        found = Axe().run(self.page).response["violations"]
        return [f"{v['id']}: {node['target']} {node['failureSummary']}" for v in found for node in v["nodes"]]

    def sideways(self) -> int:
        """How far the page as a whole can be scrolled sideways [px]."""
        return int(self.page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth"))

    def cut_off(self) -> list[str]:
        """Elements with text that reach out of the window, but for those in boxes that scroll."""
        found: Sequence[str] = self.page.evaluate(
            """() => [...document.querySelectorAll("h1, h2, h3, h4, p, li, dt, dd, summary, code, a")]
                .filter(e => !e.closest(".wide") && !e.classList.contains("skip") && e.offsetParent)
                .filter(e => e.getBoundingClientRect().right > document.documentElement.clientWidth + 1
                    || e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).display !== "inline")
                .map(e => e.tagName + ": " + e.textContent.slice(0, 60))"""
        )
        return list(found)

    def outside_their_pictures(self) -> list[str]:
        """Parts of figures that reach out of them by more than a pixel, and so are cut."""
        found: Sequence[str] = self.page.evaluate(
            """() => [...document.querySelectorAll("figure svg")].flatMap(svg => {
                const whole = svg.getBoundingClientRect();
                return [...svg.querySelectorAll("g[transform]")]
                    .filter(g => !g.closest("defs") && !g.closest("[clip-path]"))
                    .map(g => [g, g.getBoundingClientRect()])
                    .filter(([g, box]) => box.width && (box.left < whole.left - 1 || box.right > whole.right + 1
                        || box.top < whole.top - 1 || box.bottom > whole.bottom + 1))
                    .map(([g, box]) => svg.getAttribute("aria-label").slice(0, 40) + ": " + [box.x, box.y, box.right])
            })"""
        )
        return list(found)
