"""A section's command, what a page says of what was not done and of engines, and which sections begin first."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from engines.engine import registry
from experiments.experiment import Result, Table, find
from report.figures.overview import Explained
from report.page import page
from report.page.page import _identified, _undone, scene_page
from report.page.section import Section

ORDER, MAPS = find("order"), find("maps")


def test_a_section_says_what_makes_it() -> None:
    """Its experiment alone, in full, or what it was made by."""
    assert Section(ORDER).command == "springlab run order"
    assert Section(ORDER, full=True).command == "springlab report --only order --full"
    assert Section(ORDER, full=True, made_by="springlab report chain").command == "springlab report chain"


def test_what_did_not_come_to_its_end_is_told() -> None:
    """Of an experiment that failed, and of one with failures among its results; of others nothing."""
    table = Table("t", ["a"], [[1.0]])
    some, none = Result(["f"], [table], {}, ["one", "two"]), Result(["f"], [table])
    undone = _undone([Section(ORDER, failure="it raised"), Section(MAPS, none), Section(MAPS, some)])
    assert [(one.experiment, one.title, one.reasons) for one in undone] == [
        ("order", ORDER.title, ["it raised"]),
        ("maps", MAPS.title, ["one", "two"]),
    ]


def test_engines_are_told_with_their_scheme_and_how_close_it_is() -> None:
    """Or that there is none."""
    engines = [Explained("a", "heun", 0.5, 2.5e-14), Explained("b", None, 0.5, 1e-3)]
    assert _identified(engines) == {"a": "heun, to 2.5e-14 m", "b": "no scheme of the catalogue"}


@pytest.mark.parametrize("failed", [False, True])
def test_a_scenes_page_begins_with_its_advice(failed: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its findings, figure, table and file; or why there are none. The engines' cards know what was identified."""
    made: list[Any] = []
    monkeypatch.setattr(page, "_rendered", lambda *parts: made.append(parts) or "html")
    engine, other = [*registry()][:2]
    columns, rows = ["engine", "identified as"], [[engine, "heun"], [other, None]]
    result = Result(["f", "g"], [Table("advice", columns, rows), Table("other", ["x"], [])])
    advice = find("order")
    first = (
        Section(advice, failure="it raised")
        if failed
        else Section(advice, result, "<svg width='1'></svg>", "alt", [("a.csv", "data:")], made_by="springlab report s")
    )
    others = [Section(MAPS), Section(ORDER)]
    assert scene_page("pair", [first, *others]) == "html"
    ((shown, following, every, cards),) = made
    assert (shown.title, shown.above) == ("pair: which dt", 1)
    assert "on the scene pair" in shown.lead
    assert (following, every) == (others, [first, *others])
    known = {card.name: card.here for package in cards for card in package.cards if card.here}
    if failed:
        assert (shown.sentences, shown.picture) == (["Which dt to use is not known: it raised."], "")
        assert (shown.columns, shown.rows, known) == ([], [], {})
        return
    assert (shown.sentences, shown.columns, shown.rows) == (["f", "g"], columns, rows)
    assert 'aria-label="alt"' in shown.picture
    assert (shown.made_by, shown.downloads) == ("springlab report s", [("a.csv", "data:")])
    assert known == {engine: "heun"}


def test_without_engines_there_is_no_first_figure(monkeypatch: pytest.MonkeyPatch) -> None:
    """With some there is one."""
    drawn = SimpleNamespace(svg=lambda: '<svg id="x"></svg>', alt="in words")
    monkeypatch.setattr("report.figures.overview.draw", lambda engines: drawn)
    assert page._overview([]) == ""
    engine = Explained("a", "heun", 0.5, 2.5e-14)
    assert page._overview([engine]) == '<svg role="img" aria-label="in words" id="overview-x"></svg>'


def test_everything_rests_on_packages_that_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each that engines come in, also one that is not there."""
    names = sorted({engine.package for engine in registry().values()})
    monkeypatch.setattr(page, "available_version", lambda name: "1.2" if name == names[0] else None)
    told = page._environment()
    assert [told[name] for name in names] == ["1.2", *["not installed"] * (len(names) - 1)]
    assert {*told} > {*names}
