"""The site as it is made: notebooks that have run, links that lead somewhere, nothing from outside, usable by all."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import pytest

from report.site.__main__ import build
from tests.report.chromium import Shown, chromium, new_page
from tests.report.html import Page

# What takes long here is run every few days, and with --full.
pytestmark = pytest.mark.rotating(7)

ROOT = Path(__file__).parents[3]

#: How pages are looked at in the browser: width [px], colours, medium; and which, unless with --full all are.
LOOKED_AT = {
    (1280, "light", "screen"): ["index", "notebooks/first-look"],
    (360, "dark", "screen"): ["which-dt", "notebooks/which-engine"],
}


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The whole site; a warning of Sphinx, or a notebook that fails, fails it."""
    folder = tmp_path_factory.mktemp("site") / "not there yet"
    with pytest.MonkeyPatch.context() as patch:
        # notebooks are run by a Python of their own
        paths = [str(ROOT), str(ROOT / "report" / "python"), os.environ.get("PYTHONPATH", "")]
        patch.setenv("PYTHONPATH", os.pathsep.join(filter(None, paths)))
        assert build(folder) == 0
    return folder


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium."""
    with chromium() as opened:
        yield opened


def pages(site: Path) -> dict[Path, Page]:
    """Every page, taken apart."""
    return {file: Page(file.read_text(encoding="utf-8")) for file in sorted(site.rglob("*.html"))}


def test_every_notebook_has_run_and_shows_what_came_out(site: Path) -> None:
    """A table and a figure with alternative text in each."""
    for notebook in (ROOT / "report" / "docs" / "notebooks").glob("*.ipynb"):
        text = (site / "notebooks" / f"{notebook.stem}.html").read_text(encoding="utf-8")
        assert re.search(r"<th scope=.col.>", text)
        assert re.search(r'<img alt="[^"]{20,}', text)


def test_every_internal_link_is_good(site: Path) -> None:
    """The page is there, and the place on it."""
    found = pages(site)
    for file, page in found.items():
        for address in [*page.attributes("href"), *page.attributes("src")]:
            split = urlsplit(address)
            if split.scheme or address in ("#", ""):
                continue
            target = (file.parent / unquote(split.path)).resolve() if split.path else file
            assert target.exists(), f"{file.name}: {address}"
            if split.fragment and target.suffix == ".html":
                places = found[target].attributes("id")
                assert unquote(split.fragment) in places, f"{file.name}: {address}"


def test_nothing_is_asked_for_from_outside(site: Path) -> None:
    """No script, style, font or picture of another place; links that people follow may lead there."""
    for file, page in pages(site).items():
        for name, attributes in page.elements:
            if name in ("script", "img", "iframe") or (name == "link" and attributes.get("rel") != "canonical"):
                address = attributes.get("src", attributes.get("href", ""))
                assert urlsplit(address).scheme in ("", "data"), f"{file.name}: {address}"
    for style in site.rglob("*.css"):
        assert not re.search(r"url\(\W*(https?:)?//", style.read_text(encoding="utf-8")), style.name


@pytest.mark.parametrize("view", LOOKED_AT, ids=["desktop", "phone, dark"])
def test_pages_are_for_everybody(
    site: Path, browser: Any, view: tuple[int, str, str], request: pytest.FixtureRequest
) -> None:
    """By axe-core without a violation, on a desktop and on a phone in the dark; no page scrolls sideways."""
    everything = [str(file.relative_to(site).with_suffix("")) for file in sorted(site.rglob("*.html"))]
    for name in everything if request.config.option.full else LOOKED_AT[view]:
        shown = Shown(browser, site / f"{name}.html", view)
        assert shown.violations() == [], name
        assert shown.sideways() == 0, name
        shown.page.close()


def test_search_finds_without_a_server(site: Path, browser: Any) -> None:
    """From a file on the disk: the page of schemes, for a scheme."""
    page = new_page(browser)
    page.goto((site / "search.html").as_uri() + "?q=velocity_verlet")
    page.wait_for_selector("#search-results a")
    assert any("schemes.html" in link.get_attribute("href") for link in page.query_selector_all("#search-results a"))
    page.close()
