"""The page in headless Chromium: on wide and narrow screens, light and dark, and on paper."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from experiments.experiment import find, write_tables
from report.figures import animate, draw
from report.page.page import page
from report.page.section import Section
from report.page.sections import embedded
from tests.report.chromium import VIEWS, Shown, chromium
from tests.report.page.canned import RESULTS


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """One browser for all tests of this file."""
    with chromium() as found:
        yield found


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A page with every kind of thing on it: an experiment that failed, too, and a long table."""
    return _page([name for name in RESULTS if name != "errata"], tmp_path_factory.mktemp("page"))


@pytest.fixture(scope="module")
def short(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """As it is, with one experiment that came to its end."""
    return _page(["divergence"], tmp_path_factory.mktemp("short"))


def _page(names: list[str], folder: Path) -> Path:
    sections = [_section(name, folder) for name in names]
    sections.append(Section(find("errata"), failure="ArithmeticError: a long reason " + "x" * 200))
    written = folder / "index.html"
    written.write_text(page(sections), encoding="utf-8")
    return written


def _section(name: str, folder: Path) -> Section:
    result = RESULTS[name]["usual"]()
    result = replace(result, findings=[*result.findings, "One more.", "And another."])
    picture = draw(name, result)
    files = write_tables(result, folder)
    downloads = [(file.name, embedded(file)) for file in files]
    return Section(find(name), result, picture.svg(), picture.alt, downloads, motions=animate(name, result))


@pytest.mark.rotating(5)
@pytest.mark.parametrize("view", VIEWS, ids=str)
def test_the_page_has_no_violation_and_asks_for_nothing(browser: Any, file: Path, view: tuple[int, str, str]) -> None:
    """Zero by axe-core, best practices included; no request, no complaint, nothing cut, nothing too wide."""
    shown = Shown(browser, file, view)
    assert shown.sideways() == 0
    assert shown.cut_off() == []
    assert shown.outside_their_pictures() == []
    assert shown.violations() == []
    assert shown.sideways() == 0
    assert (shown.requests, shown.complaints) == ([], [])
    shown.page.close()


@pytest.mark.rotating(5)
@pytest.mark.parametrize(
    ("put", "said"),
    [
        ("<h5>too deep</h5>", "heading-order"),
        ('<p style="color: #bbb; background: #fff">pale</p>', "color-contrast"),
        ('<img alt="there" src="http://127.0.0.1:9/a.png">', "asks for"),
        ('<p style="width: 2000px">wide</p>', "sideways"),
        (
            '<figure><svg aria-label="x"><g transform="translate(2000 0)"><path d="M0 0h9v9z"/></g></svg></figure>',
            "cut",
        ),
    ],
)
def test_a_page_that_is_not_so_is_caught(browser: Any, short: Path, tmp_path: Path, put: str, said: str) -> None:
    """Shown to fail, on the same page with one thing more."""
    spoilt = tmp_path / "spoilt.html"
    spoilt.write_text(short.read_text(encoding="utf-8").replace("</main>", f"{put}</main>"), encoding="utf-8")
    shown = Shown(browser, spoilt, (360, "light", "screen"))
    caught = {
        "asks for": bool(shown.requests and shown.complaints),
        "sideways": shown.sideways() > 0 and bool(shown.cut_off()),
        "cut": bool(shown.outside_their_pictures()),
    }
    assert caught[said] if said in caught else any(said in violation for violation in shown.violations())
    shown.page.close()


@pytest.mark.rotating(3, in_turn=True)
def test_dark_is_dark_and_paper_is_white(browser: Any, short: Path) -> None:
    """The page's paper and the ink of its figures turn round; on paper they are as by day, whatever the screen is."""
    colours = {}
    for view in ((800, "light", "screen"), (800, "dark", "screen"), (800, "dark", "print")):
        shown = Shown(browser, short, view)
        colours[view[1:]] = shown.page.evaluate(
            """() => [getComputedStyle(document.body).backgroundColor,
                getComputedStyle(document.querySelector("figure svg path")).fill]"""
        )
        shown.page.close()
    assert colours["light", "screen"] == ["rgb(255, 255, 255)"] * 2 == colours["dark", "print"]
    assert colours["dark", "screen"] == ["rgb(23, 23, 23)"] * 2


@pytest.mark.rotating(5, in_turn=True)
def test_the_keyboard_reaches_everything(browser: Any, file: Path) -> None:
    """From the skip link through the contents; what has the focus shows it."""
    shown = Shown(browser, file, (1280, "light", "screen"))
    reached = []
    for _ in range(40):
        shown.page.keyboard.press("Tab")
        reached.append(
            shown.page.evaluate(
                """() => [document.activeElement.getAttribute("href") || document.activeElement.tagName,
                    getComputedStyle(document.activeElement).outlineStyle]"""
            )
        )
    places = [place for place, _ in reached]
    assert places[0] == "#found"
    assert {"#found", "#divergence", "#engines", "#undone", "#environment", "SUMMARY", "DIV"} <= {*places}
    assert {outline for _, outline in reached} == {"solid"}
    shown.page.close()


@pytest.mark.rotating(3, in_turn=True)
def test_on_paper_findings_are_open_and_tables_are_folded(browser: Any, short: Path) -> None:
    """Also tables that are open on the screen; a finding that is folded there has a height on paper."""
    heights = {}
    for medium in ("screen", "print"):
        shown = Shown(browser, short, (800, "light", medium))
        heights[medium] = shown.page.evaluate(
            """() => [...document.querySelectorAll("details:not(.cards *)")].map(d => [
                d.querySelector("table") !== null,
                d.getBoundingClientRect().height - d.querySelector("summary").getBoundingClientRect().height])"""
        )
        shown.page.close()
    on_screen, on_paper = heights["screen"], heights["print"]
    assert any(height > 10 for table, height in on_screen if table)
    assert all(height < 1 for table, height in on_paper if table)
    assert all(height > 10 for table, height in on_paper if not table)
    assert any(not table for table, _ in on_paper)


@pytest.mark.rotating(3, in_turn=True)
def test_a_section_prints_on_less_than_a_page(browser: Any, file: Path) -> None:
    """A figure is at most 9.5 cm high, so that a report of fifteen experiments has under 15 pages of A4.

    `page.pdf` counts: a page object for each page of the document.
    """
    shown = Shown(browser, file, (800, "light", "print"))
    sections = shown.page.evaluate("document.querySelectorAll('main > section').length")
    pages = len(re.findall(rb"/Type\s*/Page[^s]", shown.page.pdf(format="A4")))
    assert 1 < pages < sections
    shown.page.close()
