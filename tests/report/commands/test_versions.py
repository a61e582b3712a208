"""What `springlab versions` prints and writes, of versions that are made up."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from engines.engine import registry
from engines.process.packages import APART
from experiments.engine_versions import baseline
from experiments.engine_versions import versions as engine_versions
from experiments.engine_versions.versions import VersionMeasurements
from report.commands.main import springlab
from report.commands.versions import _show
from tests.experiments.engine_versions.spring_versions import LIMIT, MEASURED, subject
from tests.report.commands.terminal import springlab as springlab_says


def test_as_json_it_prints_what_was_measured_and_nothing_else(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The versions as they are, and each change with both numbers; its files are written too."""
    assert _show([(subject(), MEASURED)], True, tmp_path) == 0
    document = json.loads(capsys.readouterr().out)["spring"]
    assert document["versions"] == dict(MEASURED.rows)
    first = next(change for change in document["changes"] if change["measure"] == LIMIT)
    assert [first[key] for key in ("from", "to", "before", "after")] == ["1.9.0", "1.10.0", 0.01, 0.011]
    assert json.loads((tmp_path / "spring.json").read_text(encoding="utf-8")) == document


def test_in_words_it_prints_the_findings_and_the_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """No JSON; every file it names is there."""
    assert _show([(subject(), MEASURED)], False, tmp_path) == 0
    printed = " ".join(capsys.readouterr().out.split())
    with pytest.raises(json.JSONDecodeError):
        json.loads(printed)
    files = printed.partition("written: ")[2].split(", ")
    assert len(files) >= 3
    assert f"{LIMIT} 0.01 0.011" in printed
    assert "engine measure 1.9.0 1.10.0 2.0.0" in printed
    alone = VersionMeasurements("spring", {"1.9.0": MEASURED.rows["1.9.0"]})
    assert _show([(subject(), alone)], False, tmp_path) == 0
    assert "engine measure" not in capsys.readouterr().out  # no changes, no table of them
    for file in files:
        assert Path(file).stat().st_size > 0


@pytest.mark.parametrize("update", [False, True])
def test_the_baseline_is_written_where_that_is_asked_for(
    update: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """And only there: with --update-baseline, one file for each engine that was measured."""
    written: list[object] = []
    asked_patiently: list[bool] = []

    def measure(*asked: object, patient: bool) -> VersionMeasurements:
        asked_patiently.append(patient)
        return MEASURED

    monkeypatch.setattr(engine_versions, "find_subject", lambda name: subject())
    monkeypatch.setattr(engine_versions, "measure_versions", measure)
    monkeypatch.setattr(baseline, "write", lambda found: written.append(found) or tmp_path)
    words = ["versions", "spring", "1.9.0", "1.10.0", "--out", str(tmp_path)]
    assert springlab.main([*words, *["--update-baseline"] * update], standalone_mode=False) == 0
    assert written == [MEASURED] * update
    assert asked_patiently == [False]  # versions that are named are not waited for


def test_an_environment_is_made_of_a_package_or_of_an_engine_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """And of no other; its folder is told."""
    asked: list[tuple[str, str]] = []

    def environment(package: str, version: str) -> Path:
        asked.append((package, version))
        return Path("/kept/one/bin/python")

    monkeypatch.setattr("engines.process.environments.environment", environment)
    engine = next(one for one in registry().values() if one.package in APART)
    for name in (engine.package, engine.name):
        said = springlab_says("versions", name, "--install")
        assert (said.code, said.out) == (0, "made: /kept/one\n")
    assert asked == [(engine.package, APART[engine.package].version)] * 2
    for words, named in ((["numpy"], "numpy"), ([], "")):
        said = springlab_says("versions", *words, "--install")
        assert said.code == 2
        assert said.err.startswith(f"springlab: versions --install {named}: expected one of ")
    said = springlab_says("versions")
    assert said.err == "springlab: versions: expected ENGINE and VERSION..., or --all, or --check\n"
