"""Sections: which begin first, which run alone, what is kept of them, and how their failures are told."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from engines.process.isolation import Outcome
from experiments.experiment import Experiment, Result, Table, find
from report.page import section_cache, sections
from report.page.section import Section
from report.page.section_cache import cache_section, cached_section, document, from_document

RESULT = Result(["f"], [Table("t", ["a [m]", "b"], [[0.5, "x"], [1.5, "y"]])], {}, ["failed"])
FULL = Section(
    find("order"), RESULT, "<svg>", "alt", [("t.csv", "data:text/csv;base64,YSxi")], full=True, motions="<m>"
)


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Which sections are made, by how many at once, and what of their making is kept; a store that has `maps`."""
    asked: list[Any] = []

    def make_each(
        experiments: list[Experiment], workers: int | None, make: Callable[[Any], Any], when_made: Callable[..., None]
    ) -> None:
        asked.append((workers, [experiment.name for experiment in experiments]))
        for experiment in experiments:
            when_made(make(experiment), 2.5)

    def isolated(task: Any, name: str, *others: Any, **limits: Any) -> Any:
        asked.append((name, *others, limits))
        return Outcome("timed out", "900 s") if name == "order" else Section(find(name), RESULT)

    store = SimpleNamespace(name="kept")
    monkeypatch.setattr(sections, "_make_each", make_each)
    monkeypatch.setattr(sections, "isolated", isolated)
    monkeypatch.setattr(sections, "prepare_processes", lambda: None)
    monkeypatch.setattr(sections, "current", lambda: SimpleNamespace(store=store))
    monkeypatch.setattr(
        sections,
        "cached_section",
        lambda one, full, store, folder: Section(one, RESULT, "kept") if one.name == "maps" else None,
    )
    monkeypatch.setattr(
        sections, "cache_section", lambda made, full, store, seconds: asked.append((full, seconds)) or made
    )
    return asked


def test_what_takes_longest_begins_first_and_what_measures_times_is_alone_at_the_end(
    asked: list[Any], tmp_path: Path
) -> None:
    """In the order they were asked for they come back; what is kept is not made again; a failure says how it ended."""
    names = ["speed", "errata", "order", "maps", "stability", "barrier"]
    assert [name for name in names if find(name).timed] == ["speed"]
    told: list[str] = []
    made = sections.all_sections([find(n) for n in names], tmp_path, told.append, tmp_path / "s", full=True)
    assert [one.experiment.name for one in made] == names
    groups = [entry for entry in asked if isinstance(entry[1], list)]
    assert [group for _, group in groups] == [["stability", "order", "errata", "barrier"], ["speed"]]
    assert groups[1][0] == 1
    assert made[2].failure == "timed out: 900 s"
    assert made[3].svg == "kept"
    run = next(entry for entry in asked if entry[0] == "errata")
    assert run[1:5] == ((tmp_path / "errata").resolve(), (tmp_path / "s").resolve(), False, True)
    assert run[5] == {"time_limit": 900.0, "memory_limit": 16 * 2**30}
    assert (True, 2.5) in asked
    assert told[0] == "1 of 6 done"
    assert told[1] == "2 of 6 done; next: speed, errata, order, barrier"
    assert told[-1].startswith("6 of 6 done")


def test_to_begin_anew_makes_all_again(asked: list[Any], tmp_path: Path) -> None:
    """Also what is kept."""
    made = sections.all_sections([find("maps")], tmp_path, lambda _: None, tmp_path / "s", fresh=True)
    assert made[0].svg == ""
    assert asked[1][3:5] == (True, False)


def test_a_section_is_kept_and_shown_again_with_its_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Word for word, but for the data that only figures need; into a folder that may be there."""
    again = from_document(FULL.experiment, document(FULL))
    assert again == FULL
    monkeypatch.setattr(section_cache, "task_of", lambda experiment, full: SimpleNamespace(key=(experiment.name, full)))
    store: Any = SimpleNamespace(find=lambda task: SimpleNamespace(answer=document(FULL)))
    for _ in range(2):
        assert cached_section(FULL.experiment, True, store, tmp_path / "new") == FULL
    files = {file.name: file.read_text(encoding="utf-8") for file in (tmp_path / "new" / "order").iterdir()}
    assert files == {"order.svg": "<svg>", "t.csv": "a,b"}
    store.find = lambda task: None
    assert cached_section(FULL.experiment, True, store, tmp_path) is None


def test_only_what_came_to_its_end_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    """In place of what was there; what the store cannot hold, and what has no name, is shown as it is."""
    done: list[Any] = []
    task = SimpleNamespace(key="key")
    monkeypatch.setattr(section_cache, "task_of", lambda experiment, full: task if full else None)

    def keep(task: Any, answer: Any, seconds: float) -> None:
        done.append((answer["svg"], seconds))
        if answer["svg"] == "odd":
            raise TypeError

    kept = SimpleNamespace(answer={**document(FULL), "svg": "as kept"})
    store: Any = SimpleNamespace(retire=lambda keys: done.append(keys), keep=keep, find=lambda task: kept)
    assert cache_section(FULL, True, store, 2.5).svg == "as kept"
    assert done == [["key"], ("<svg>", 2.5)]
    done.clear()
    failed, nameless = Section(FULL.experiment, failure="no"), FULL
    assert cache_section(failed, True, store, 1.0) is failed
    assert cache_section(nameless, False, store, 1.0) is nameless
    assert done == []
    odd = Section(FULL.experiment, RESULT, "odd")
    assert cache_section(odd, True, store, 1.0) is odd
    store.find = lambda task: None
    assert cache_section(FULL, True, store, 1.0) is FULL
