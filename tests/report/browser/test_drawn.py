"""What the page draws and says besides masses and springs: gravity, plots, descriptions in another language."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from report.browser.lab_page import TEMPLATES, lab_page
from report.browser.presets import Preset
from report.browser.programs import page_schemes
from tests.report.browser.test_lab_page import opened
from tests.report.chromium import chromium

WORDS = json.loads((TEMPLATES / "browser/words.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A string alone, on disk."""
    made = tmp_path_factory.mktemp("page") / "lab.html"
    made.write_text(lab_page([Preset("string")]), encoding="utf-8")
    return made


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium."""
    with chromium() as found:
        yield found


@pytest.mark.rotating(4, in_turn=True)
def test_gravity_that_swings_is_no_moving_ground(browser: Any, tmp_path: Path) -> None:
    """A file's sine of gravity, and one of a ground motion: each is told as what it is."""
    tables = {
        "swings": '[[sines]]\nparameter = "gravity"\namplitude = 4.0\nfrequency = 1.0\n',
        "ground": "[ground_motion]\nfrom_frequency = 1.0\nto_frequency = 3.0\namplitude = 1.0\nduration = 0.5\n",
    }
    for name, table in tables.items():
        (tmp_path / f"{name}.toml").write_text(f'scene = "string"\ndt = 1e-3\nduration = 0.5\n\n{table}')
    made = tmp_path / "lab.html"
    made.write_text(lab_page([Preset(str(tmp_path / f"{name}.toml")) for name in tables]), encoding="utf-8")
    written = "(() => { const all = [], own = paper.fillText; paper.fillText = function (text, ...at) { all.push(text);"
    written += "own.call(this, text, ...at); }; draw(); paper.fillText = own; return all.join(' '); })()"
    for name, said, other in (("swings", "gravity: ", "ground"), ("ground", "ground accelerated", "gravity: ")):
        shown = opened(browser, made, f"s={name}&w=kick_drift&n=100")
        text = shown.page.evaluate(written)
        assert said in text
        assert other not in text
        shown.page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_plots_have_axes_before_the_first_step(browser: Any, page: Path) -> None:
    """Energy from less to more than the system was given, distances from a millionth of the scene on."""
    shown = opened(browser, page, "s=string&w=kick_drift,rk4")
    ends = "(() => { const found = {}, own = plot; plot = (id, of) => { found[id] = [of.low, of.high]; }; drawPlots();"
    ends += "plot = own; return found; })()"
    found, given = shown.page.evaluate(ends), shown.page.evaluate("lab.lanes[0].world.given")
    assert found["energy"] == [-given, given]
    low, high = found["apart"]
    assert 1e-7 < low < 1e-5 < 0.1 <= high <= 10
    shown.page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_all_schemes_and_scenes_have_german_descriptions(browser: Any, page: Path) -> None:
    """English ones are the catalogue's own; what has none in German would be shown in English."""
    german = WORDS["de"]
    assert not [name for name in page_schemes() if f"about_{name}" not in german]
    shown = opened(browser, page, "s=string&w=backward_euler&lang=de")
    assert german["about_backward_euler"] in shown.page.inner_text("#equations")
    assert "Newton's" not in shown.page.inner_text("#equations")
    shown.page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_of_a_table_the_sides_that_are_seen_are_filled(browser: Any, tmp_path: Path) -> None:
    """Places on its top, its long side and its end, each beside the cloth: none is as the paper is; beside it is."""
    made = tmp_path / "lab.html"
    made.write_text(lab_page([Preset("tablecloth")]), encoding="utf-8")
    shown = opened(browser, made)
    colour = """place => { view.zoom = 0.3; draw();
        const [x, y] = seen(place, 3), ratio = canvas.width / canvas.clientWidth;
        return [...paper.getImageData(ratio * (canvas.clientWidth / 2 + view.scale * x),
            ratio * (canvas.clientHeight / 2 - view.scale * y), 1, 1).data].join() }"""
    x, y, z, half_x, half_y, half_z = (-0.54, -0.1, 0.27, 0.81, 0.1, 0.81)
    top, side, end = (x, y + half_y, z + 0.9 * half_z), (x + half_x, y, z), (x, y, z + half_z)
    paper = shown.page.evaluate(colour, (x + 2 * half_x, y + half_y, z))
    assert paper == "255,255,255,255"
    assert all(shown.page.evaluate(colour, place) != paper for place in (top, side, end))
    shown.page.close()
