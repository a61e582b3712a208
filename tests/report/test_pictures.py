"""README's pictures and the sample: what they are made of, of sections that are there already."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from experiments.experiment import find
from report import readme, sample
from report.commands.runner_options import STORE
from report.page.section import Section
from tests.experiments.canned import divergence


@pytest.fixture(params=[readme, sample])
def made(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> tuple[Any, list[Any]]:
    """One of the two programs, and what it asks for."""
    asked: list[Any] = []

    def all_sections(experiments: Any, folder: Path, tell: Any, store: Path) -> list[Section]:
        asked.append(([experiment.name for experiment in experiments], store))
        pages = [Section(one, svg=f"<svg>{one.name}</svg>", downloads=[("a.csv", "data:")]) for one in experiments]
        return [Section(find("divergence"), divergence.usual(), "<svg></svg>"), *pages[1:]]

    @contextmanager
    def chosen_runner(resume: bool, store: Path) -> Iterator[None]:
        asked.append((resume, store))
        yield

    monkeypatch.setattr(request.param, "all_sections", all_sections)
    monkeypatch.setattr(request.param, "chosen_runner", chosen_runner)
    return request.param, asked


def test_they_are_made_of_what_the_last_report_has_kept(
    made: tuple[Any, list[Any]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first figure and the maps; the sample's three sections, without downloads."""
    program, asked = made
    if program is readme:
        monkeypatch.setattr(readme, "PICTURES", tmp_path)
        drawn = lambda engines: SimpleNamespace(svg=lambda: " ".join(one.engine for one in engines))  # noqa: E731
        monkeypatch.setattr("report.figures.overview.draw", drawn)
        readme.write_pictures()
        assert asked == [(True, STORE), (["divergence", "maps"], STORE)]
        assert (tmp_path / "maps.svg").read_text(encoding="utf-8") == "<svg>maps</svg>"
        assert (tmp_path / "found.svg").read_text(encoding="utf-8").startswith("KickDrift ")
        return
    shown: list[Any] = []
    monkeypatch.setattr(sample, "SAMPLE", tmp_path / "new" / "index.html")
    monkeypatch.setattr(sample, "page", lambda sections: shown.extend(sections) or "page")
    for _ in range(2):  # the folder may be there
        sample.main()
    assert asked[:2] == [(True, STORE), (list(sample.NAMES), STORE)]
    assert [(one.experiment.name, one.downloads) for one in shown[:3]] == [(name, ()) for name in sample.NAMES]
    assert sample.SAMPLE.read_text(encoding="utf-8") == "page"
