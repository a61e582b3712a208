"""Whether the lab is written beside a report: where a section shows it, and nowhere else."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from experiments.experiment import NAMES, find
from report.browser.beside import BESIDE, scenes_beside
from report.page import written


@pytest.mark.parametrize("beside", [True, False])
def test_the_lab_is_written_where_a_section_shows_it(
    beside: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One such section among others is enough; what is asked for is passed on to the sections."""
    others = [name for name in NAMES if name not in BESIDE][:2]
    names = [others[0], *([next(iter(BESIDE))] if beside else []), others[1]]
    labs: list[Path] = []
    asked: list[dict[str, Any]] = []
    monkeypatch.setattr(written, "_write_lab", labs.append)
    monkeypatch.setattr(written, "all_sections", lambda *_, **options: asked.append(options) or [])
    monkeypatch.setattr(written, "page", lambda sections, lab: f"page beside {lab or 'nothing'}")
    made = written.write_page(names, tmp_path / "new", tmp_path / "store", lambda what: None, fresh=True)
    assert made.file == tmp_path / "new" / "index.html"
    assert made.file.read_text(encoding="utf-8") == f"page beside {written.LAB if beside else 'nothing'}"
    assert labs == ([tmp_path / "new" / written.LAB] if beside else [])
    assert asked == [{"fresh": True, "full": False}]


def test_the_lab_beside_a_report_has_the_scenes_that_its_states_show(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By the names that links have for them: a larger cloth, of another name, is not among them."""
    made: list[Any] = []
    monkeypatch.setattr(written, "lab_page", lambda presets: made.extend(presets) or "lab")
    written._write_lab(tmp_path / "lab.html")
    assert (tmp_path / "lab.html").read_text(encoding="utf-8") == "lab"
    names = [preset.name or preset.scene for preset in made]
    assert {*names} == scenes_beside()
    assert len(names) == len({*names})


def test_which_experiments_are_on_a_page() -> None:
    """Those named, each once, in that order; of no names those that belong in the report, in full all."""
    left_out = [name for name in NAMES if not find(name).in_report]
    assert left_out
    names = lambda given, full: [one.name for one in written._wanted(given, full)]  # noqa: E731
    assert names(["maps", left_out[0], "maps"], False) == ["maps", left_out[0]]
    assert names([], True) == list(NAMES)
    assert names([], False) == [name for name in NAMES if name not in left_out]
    assert names(["maps"], True) == ["maps"]
