"""`springlab list`, and what is said where an engine is not installed."""

from __future__ import annotations

import json
from collections.abc import Iterator
from importlib import metadata

import pytest

from engines.engine import absence, find, installed_version, recorded_settings, registry, version
from engines.process.packages import APART
from experiments.experiment import NAMES
from experiments.runs.steppers import all_steppers
from reference.scenes import BESIDES, scenes
from reference.schemes.catalogue import constraint_schemes, wide_schemes
from reference.stepper import catalogued
from report.commands.terminal import FOLDED
from tests.report.commands.terminal import springlab


@pytest.fixture
def missing(monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """A package that engines come in, and that seems not to be installed."""
    package = next(engine.package for engine in registry().values() if engine.package not in APART)
    found = metadata.version

    def version_of(name: str) -> str:
        if name == package:
            raise metadata.PackageNotFoundError(name)
        return found(name)

    with monkeypatch.context() as patch:
        patch.setattr(metadata, "version", version_of)
        installed_version.cache_clear()
        yield package
    installed_version.cache_clear()


def test_the_json_lists_everything_there_is() -> None:
    """Scenes, all steppers that are no engines, engines, experiments; each with words on what it is."""
    said = springlab("list", "--json")
    assert said.code == 0
    document = json.loads(said.out)
    assert list(document) == ["scenes", "every scene", "schemes", "engines", "experiments"]
    assert [row["scene"] for row in document["scenes"]] == list(scenes())
    others = [stepper.name for stepper in all_steppers().values() if stepper.kind != "engine"]
    assert [row["stepper"] for row in document["schemes"]] == [*others, *constraint_schemes(), *wide_schemes()]
    assert [row["parameter"] for row in document["every scene"]] == list(BESIDES)
    assert [row["engine"] for row in document["engines"]] == list(registry())
    assert [row["experiment"] for row in document["experiments"]] == list(NAMES)
    assert all(value for rows in document.values() for row in rows for value in row.values())


def test_the_terminal_shows_every_name() -> None:
    """In tables that fold sentences but never names, each cell under its heading."""
    said = springlab("list")
    assert said.code == 0
    for rows in json.loads(springlab("list", "--json").out).values():
        cells = [str(value) for row in rows for key, value in row.items() if key not in ("settings", "precision")]
        # what is longer than a column of sentences is broken
        words = {word for cell in cells for word in cell.split() if len(word) <= FOLDED}
        assert words <= {*said.out.split()}
    for name in [*scenes(), *catalogued(), *constraint_schemes(), *registry(), *NAMES]:
        assert f" {name} " in said.out


def test_an_installed_engine_is_listed_with_its_version() -> None:
    """As its package's metadata has it."""
    rows = {row["engine"]: row for row in json.loads(springlab("list", "--json").out)["engines"]}
    for name, engine in registry().items():
        if installed_version(engine.package) is not None:
            assert rows[name]["version"] == metadata.version(engine.package)


def test_what_is_recorded_with_results_is_listed_and_claims_are_called_claims() -> None:
    """Settings and precision in the JSON; in the terminal the heading of the schemes says whose word they are."""
    rows = {row["engine"]: row for row in json.loads(springlab("list", "--json").out)["engines"]}
    for name, engine in registry().items():
        assert {**rows[name]["settings"], "precision": rows[name]["precision"]} == recorded_settings(engine)
        assert rows[name]["known to be"] == ", ".join(dict.fromkeys(engine.identified_as.values()))
    said = springlab("list").out
    assert "claims to be" in said
    assert "known to be" not in said


def test_a_missing_engine_is_listed_with_why(missing: str) -> None:
    """Where its version would stand."""
    rows = {row["engine"]: row for row in json.loads(springlab("list", "--json").out)["engines"]}
    for name, engine in registry().items():
        says = f"not available: {absence(engine)}"
        assert (rows[name]["version"] == says) == (engine.package == missing or version(engine) is None)


def test_a_missing_engine_that_is_asked_for_is_bad_input(missing: str) -> None:
    """One line, exit code 2, the package named: for compare and for identify."""
    name = next(name for name, engine in registry().items() if engine.package == missing)
    for words in (("compare", "--stepper", name), ("identify", name)):
        said = springlab(*words)
        assert (said.code, said.out) == (2, "")
        assert said.err == f"springlab: stepper {name!r} cannot run: {absence(find(name))}\n"


def test_a_missing_engine_is_a_row_of_the_default_comparison(missing: str) -> None:
    """Unsupported, with the reason; the other steppers report as ever."""
    said = springlab("compare", "--duration", "0.01", "--json")
    assert said.code == 0
    for run in json.loads(said.out)["runs"]:
        engine = registry().get(run["stepper"])
        gone = engine is not None and (engine.package == missing or version(engine) is None)
        assert (run["outcome"] == "unsupported") == gone, run
        if engine is not None and gone:
            assert (run["version"], run["reason"]) == (None, absence(engine))
