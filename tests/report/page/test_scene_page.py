"""The report on a user's own scene: a page with advice, cards and downloads, whatever of it fails."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path

import pytest

from engines.engine import registry
from engines.process.isolation import EngineStepper
from experiments.advice import own_scene
from experiments.advice import wording as advice_words
from report.page.written import write_scene_page
from tests.report.commands.terminal import Said, springlab
from tests.report.html import check_self_contained, page_of

SCENE = """
scene = "string"
dt = 2e-3
duration = 0.05
[parameters]
masses = 2
stiffness = 400.0
"""


@pytest.fixture
def scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A scene in a file, and one engine to try it in."""
    one = next(engine for engine in map(EngineStepper, registry().values()) if engine.version)

    def installed() -> Sequence[EngineStepper]:
        return [one]

    monkeypatch.setattr(advice_words, "installed_engines", installed)
    monkeypatch.setattr(own_scene, "installed_engines", installed)
    file = tmp_path / "mine.toml"
    file.write_text(SCENE, encoding="utf-8")
    return file


def reported(scene: Path, *options: str) -> tuple[Said, str]:
    """What `springlab report` said of a scene, and its page."""
    out = scene.parent / "page"
    said = springlab("report", str(scene), "--out", str(out), *options)
    assert "Traceback" not in said.err
    html = (out / "index.html").read_text(encoding="utf-8")
    check_self_contained(html)
    return said, html


@pytest.mark.rotating(3, in_turn=True)
def test_the_page_has_advice_with_its_numbers_and_a_card_for_every_engine(scene: Path) -> None:
    """Which dt, first; the table to be taken away; and what each engine is."""
    said, html = reported(scene)
    assert said.code == 0
    shown = page_of(html)
    sections = [attributes["id"] for attributes in shown.of("section")]
    assert sections == ["found", "motion", "own_scene", "engines", "undone", "environment"]
    assert "which dt" in shown.words
    found = html[html.index('id="found"') : html.index('id="motion"', html.index('id="found"'))]
    assert found.count('<p class="finding">') == 1  # the advice, before its figure
    assert found.index('<p class="finding">') < found.index("<figure")
    assert {a["download"] for a in shown.of("a") if "download" in a} >= {"advice.csv", "scene.csv"}
    with (scene.parent / "page" / "advice" / "advice.csv").open(newline="", encoding="utf-8") as file:
        (row,) = csv.DictReader(file)
    assert f"<dt>identified here as</dt><dd>{row['identified as']}</dd>" in html
    assert float(row["advised dt [s]"]) < float(row["measured limit [s]"])


def test_advice_that_fails_is_told_in_its_place_and_asked_for_once(
    scene: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The page still comes, with what else there is to say of the scene, the reason, and exit code 1."""
    asked = []

    def fail(*_: object) -> None:
        asked.append(1)
        raise ArithmeticError("no engine today")

    monkeypatch.setattr(advice_words, "advise", fail)
    said, html = reported(scene)
    assert (said.code, len(asked)) == (1, 1)
    words = page_of(html).words
    assert "Which dt to use is not known: ArithmeticError: no engine today" in words
    assert "This experiment did not come to its end: ArithmeticError: no engine today" in words
    assert "has 3 masses and 2 springs" in words


@pytest.mark.rotating(3, in_turn=True)
def test_a_comparison_that_fails_leaves_the_advice(scene: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The failure stands in its section; the advice above it is whole."""

    def fail(*_: object) -> None:
        raise MemoryError("too much")

    monkeypatch.setattr(own_scene, "compare", fail)
    said, html = reported(scene)
    assert said.code == 1
    words = page_of(html).words
    assert "This experiment did not come to its end: MemoryError: too much" in words
    assert "engine settings with a limit are stable here" in words


def test_a_folder_that_is_there_is_written_to_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With folders above it that were not; the page of the last time is replaced."""
    monkeypatch.setattr("report.page.written.scene_sections", lambda *_: [])
    folder = tmp_path / "above" / "page"
    for text in ("<p>one</p>", "<p>two</p>"):
        monkeypatch.setattr("report.page.written.scene_page", lambda *_, text=text: text)
        written = write_scene_page("string", folder, lambda _: None)
        assert written.file.read_text(encoding="utf-8") == text
