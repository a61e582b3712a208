"""Sections that are shown again: only while nothing has changed, and none that failed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from experiments.experiment import NAMES, Result, find
from experiments.runs.progress import Progress
from experiments.runs.results import rows
from report.page import section_cache
from tests.import_graph import import_graph, modules
from tests.report.commands.terminal import springlab
from tests.report.page.canned import errata
from tests.report.page.doubles import put

COUNT: list[str] = []


def counted(_: Progress) -> Result:
    """The errata, once more."""
    COUNT.append("errata")
    return errata()


def failing(_: Progress) -> Result:
    """No errata."""
    COUNT.append("failure")
    raise ArithmeticError("not today")


@pytest.fixture(autouse=True)
def nothing_counted() -> Iterator[None]:
    """Each test counts for itself."""
    COUNT.clear()
    yield
    COUNT.clear()


def report(folder: Path, store: Path, *options: str) -> tuple[int, str]:
    """The exit code, and the page without its date."""
    said = springlab("report", "--only", "errata", "--out", str(folder), "--store", str(store), *options)
    html = (folder / "index.html").read_text(encoding="utf-8")
    return said.code, re.sub(r"\d{4}-\d\d-\d\d \d\d:\d\d UTC", "", html)


@pytest.mark.rotating(4, in_turn=True)
def test_an_experiment_is_run_once_and_the_page_is_the_same(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Byte for byte, with its files beside it; --fresh runs it again, and what that found is kept in its place."""
    put(monkeypatch, replace(find("errata"), run=counted))
    first = report(tmp_path / "first", tmp_path / "store.sqlite")
    assert report(tmp_path / "again", tmp_path / "store.sqlite") == first
    assert len(COUNT) == 1
    files = [sorted((f.name, f.read_bytes()) for f in (tmp_path / n / "errata").iterdir()) for n in ("first", "again")]
    assert files[0] == files[1]
    assert report(tmp_path / "fresh", tmp_path / "store.sqlite", "--fresh") == first
    assert len(COUNT) == 2
    assert report(tmp_path / "last", tmp_path / "store.sqlite") == first
    assert len(COUNT) == 2
    assert rows(tmp_path / "store.sqlite", {}) == []  # a section is no run


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize("what", ["sources", "versions"])
def test_what_changes_the_answer_runs_it_again(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, what: str) -> None:
    """Another source, another version of a package."""
    put(monkeypatch, replace(find("errata"), run=counted))
    report(tmp_path / "page", tmp_path / "store.sqlite")
    monkeypatch.setattr(section_cache, what, lambda: "another")
    report(tmp_path / "page", tmp_path / "store.sqlite")
    assert len(COUNT) == 2


@pytest.mark.rotating(3, in_turn=True)
def test_a_failed_section_is_not_kept(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """It is run again, and fails again, with exit code 1."""
    put(monkeypatch, replace(find("errata"), run=failing))
    for _ in range(2):
        assert report(tmp_path / "page", tmp_path / "store.sqlite")[0] == 1
    assert len(COUNT) == 2


def test_a_function_that_has_no_name_of_its_own_is_not_kept() -> None:
    """Another could have the same."""
    assert section_cache.name_of(lambda _: errata()) is None
    assert section_cache.name_of(counted) is not None
    assert section_cache.name_of(counted) != section_cache.name_of(failing)
    maps = find("maps")
    assert maps.run_in_full is not None
    assert section_cache.name_of(maps.run_in_full) != section_cache.name_of(maps.run)


@pytest.mark.rotating(4, in_turn=True)
def test_all_that_sections_are_made_with_is_in_the_digest() -> None:
    """Whatever the modules that make and keep them import, and what that imports, by the imports in their files.

    The page around them is not: it is made anew each time.
    """
    files = modules()
    graph = import_graph({name: file.read_text(encoding="utf-8") for name, file in files.items()})
    needed, waiting = set(), ["report.page.sections", *(f"report.figures.{name}" for name in NAMES)]
    while waiting:
        module = waiting.pop()
        if module not in needed:
            needed.add(module)
            waiting += graph[module]
    digested = set(section_cache.source_files())
    assert {name for name in needed if files[name] not in digested} == set()
    assert files["report.film.drawing"] in digested
    assert files["report.page.page"] not in digested
