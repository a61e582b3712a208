"""Whether the lab is written beside a report: where a section shows it, and nowhere else."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from experiments.experiment import NAMES
from report.browser.beside import BESIDE
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
