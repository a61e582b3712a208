"""The table of what engines refuse is sound, is held against them both ways, and is renewed by running them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from engines.engine import find, registry
from reference.errors import InputError
from tests.conformance import (
    doctored,
    refusals,
    test_capabilities,
    test_changes,
    test_cloths_on_obstacles,
    test_scenes,
)
from tests.conformance.cases import GROUPS, SCENES
from tests.conformance.doctored import Doctored
from tests.conformance.refusals import Row, refused_as_expected
from tests.conformance.runs import outcome_of

#: The test that each group of cases goes through.
TESTS = {
    "scenes": test_scenes.test_scenes_are_stepped_as_by_a_known_scheme,
    "cloths": test_cloths_on_obstacles.test_a_cloth_on_an_obstacle_is_as_in_the_reference,
    "capabilities": test_capabilities.test_a_capability_is_kept_or_its_lack_is_said,
    "changes": test_changes.test_a_change_acts_as_in_the_scheme_or_is_refused_by_name,
}

ALL = [(group, name) for group, cases in GROUPS.items() for name in cases]

#: An honest engine of the plane, and its like that takes everything all the same.
FLAT = Doctored(capabilities=Doctored().capabilities - {"3d"})
BOLD = replace(FLAT, refuses=False)


@pytest.fixture
def row() -> Iterator[Callable[[str, Row], None]]:
    """Gives an engine, by its name, a row in the table as it is read."""
    with pytest.MonkeyPatch.context() as patch:
        yield lambda name, row: patch.setattr(refusals, "read", lambda: {name: row})


# --- The table ---


def test_rows_are_of_engines_and_cases_there_are() -> None:
    """Whatever has left the project has left the table; every case is in it once at most for an engine."""
    for engine, groups in refusals.read().items():
        assert engine in registry()
        for group, reasons in groups.items():
            names = [name for cases in reasons.values() for name in cases]
            assert set(names) <= set(GROUPS[group])
            assert len(names) == len(set(names))


def test_no_engine_refuses_for_the_lack_of_a_capability_that_it_has() -> None:
    """Whatever the table was renewed with: an engine that can do something does not refuse for want of it."""
    for name, row in refusals.read().items():
        check_reasons(find(name).capabilities, row)


def check_reasons(capabilities: frozenset[str], row: Row) -> None:
    """A reason that is a capability is one that the engine lacks."""
    for reasons in row.values():
        assert not capabilities.intersection(reasons)


def test_the_check_of_reasons_sees_one_that_is_no_lack() -> None:
    """Shown to fail: the row of an engine that refuses what it can."""
    liar = Doctored(doctored.RefusesWhatItCan)
    check_reasons(FLAT.capabilities, {"scenes": {"3d": ["cloth"]}})
    with pytest.raises(AssertionError):
        check_reasons(liar.capabilities, {"scenes": {"3d": ["cloth"]}})


# --- Held against engines ---


@pytest.mark.rotating(5)
@pytest.mark.parametrize("liar", [doctored.RefusesEverything, doctored.RefusesWhatItCan])
@pytest.mark.parametrize(("group", "name"), ALL)
def test_an_engine_that_refuses_everything_passes_not_one_test(
    liar: type[doctored.KickDrift], group: str, name: str
) -> None:
    """Neither of scenes and cloths nor of capabilities and changes, by whatever reason; the honest one passes."""
    TESTS[group](Doctored(), name)
    with pytest.raises(AssertionError):
        TESTS[group](Doctored(liar), name)


@pytest.mark.parametrize("name", GROUPS["changes"])
def test_an_engine_that_refuses_every_change_fails(name: str) -> None:
    """Though it names what it refuses."""
    with pytest.raises(AssertionError, match="expected refusals"):
        TESTS["changes"](Doctored(doctored.RefusesChanges), name)


@pytest.mark.parametrize("name", SCENES)
def test_without_a_row_what_is_beyond_the_capabilities_is_to_be_refused(name: str) -> None:
    """An engine of the plane passes where it refuses space, and only there; one that takes space fails there."""
    in_space = SCENES[name].system.dimension == 3
    assert refused_as_expected(FLAT, "scenes", SCENES[name], outcome_of(FLAT, SCENES[name])) == in_space
    if in_space:
        with pytest.raises(AssertionError, match="done"):
            refused_as_expected(BOLD, "scenes", SCENES[name], outcome_of(BOLD, SCENES[name]))


def test_a_row_is_held_against_its_engine_both_ways(row: Callable[[str, Row], None]) -> None:
    """What it says is refused must be, for that reason; and what it does not say must be taken."""
    cloth, jello, bridge = (SCENES[name] for name in ("cloth", "jello", "bridge"))
    row(FLAT.name, {"scenes": {"3d": ["cloth", "bridge"], "mesh": ["flag"]}})
    assert refused_as_expected(FLAT, "scenes", cloth, outcome_of(FLAT, cloth))
    assert not refused_as_expected(BOLD, "scenes", jello, outcome_of(BOLD, jello))
    for engine, case in ((FLAT, jello), (FLAT, bridge), (BOLD, cloth), (FLAT, SCENES["flag"])):
        with pytest.raises(AssertionError, match="renew its row"):
            refused_as_expected(engine, "scenes", case, outcome_of(engine, case))


def test_a_reason_is_a_capability_or_the_engines_own_words() -> None:
    """Own words up to the first colon: what follows may have numbers in it."""
    assert refusals.reason_of(FLAT, outcome_of(FLAT, SCENES["cloth"])) == "3d"
    assert refusals.reason_of(FLAT, outcome_of(FLAT, SCENES["bridge"])) is None
    liar = Doctored(doctored.RefusesEverything)
    assert refusals.reason_of(liar, outcome_of(liar, SCENES["bridge"])) == "not today"


# --- Renewed ---


def test_a_row_is_what_an_engine_refuses() -> None:
    """In space nothing; in every group what lies there, for that reason."""
    in_space = {group: [c.name for c in cases.values() if c.system.dimension == 3] for group, cases in GROUPS.items()}
    assert refusals.row_of(FLAT) == {group: {"3d": names} for group, names in in_space.items() if names}
    assert refusals.row_of(Doctored()) == {}


def test_the_table_is_written_as_it_is_read() -> None:
    """Renewing what has not changed changes nothing."""
    assert refusals.written(refusals.read()) == refusals.FILE.read_text(encoding="utf-8")


def test_renewing_keeps_other_rows_and_drops_engines_that_are_gone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The named engine has its row made anew; an unknown name is refused with a suggestion."""
    file = tmp_path / "table.toml"
    file.write_text(refusals.written({"flat": {}, "other": {"scenes": {"mesh": ["cloth"]}}, "gone": {}}))
    engines = {"flat": FLAT, "other": FLAT}
    monkeypatch.setattr(refusals, "registry", lambda: engines)
    monkeypatch.setattr(refusals, "find", lambda name: engines[name])
    monkeypatch.setattr(refusals, "row_of", lambda engine: {"scenes": {"3d": ["jello"]}})
    refusals.main(["flat"], file)
    refusals.read.cache_clear()
    found = refusals.read(file)
    assert found["other"] == {"scenes": {"mesh": ["cloth"]}}
    assert "gone" not in found
    monkeypatch.undo()
    with pytest.raises(InputError, match="did you mean"):
        refusals.main(["mujoco_tendon"], file)
