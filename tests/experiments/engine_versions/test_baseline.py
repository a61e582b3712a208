"""The baseline: what was written is read, one doctored number is named, and all that was promised is kept."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from experiments.engine_versions import baseline
from experiments.engine_versions.baseline import deviations
from experiments.engine_versions.changes import TOLERANCE
from experiments.engine_versions.versions import VersionMeasurements, find_subject
from reference.errors import InputError
from tests.conformance.doctored import Doctored
from tests.experiments.engine_versions.spring_versions import LIMIT, MEASURED, made_up, subject

#: What the project promised to keep.
KEPT = {
    "box2d-python": ["0.1.1", "0.1.2"],
    "mujoco": ["3.2.7", "3.3.7", "3.17.0", "4.0.0"],
    "pybullet": ["3.2.5", "3.2.6", "3.2.7"],
    "pymunk": ["6.8.1", "6.11.1", "7.0.1", "7.3.1"],
    "sapien": ["3.0.2", "3.0.3"],
}


def test_what_was_written_is_read_and_nothing_deviates(tmp_path: Path) -> None:
    """All versions, in order, and all lines are those of the file."""
    file = baseline.write(MEASURED, tmp_path)
    assert baseline.read("spring", tmp_path) == made_up()
    assert list(json.loads(file.read_text())) == ["1.9.0", "1.10.0", "2.0.0"]
    assert baseline.packages(tmp_path) == ["spring"]
    assert deviations(subject(), MEASURED, tmp_path) == []


def test_one_doctored_number_is_named(tmp_path: Path) -> None:
    """With its version, its engine, its measure, and both numbers; within the tolerance it is the same number."""
    baseline.write(MEASURED, tmp_path)
    rows = made_up()
    rows["1.9.0"]["springs"][LIMIT] = 0.01 * (1 + TOLERANCE / 2)
    assert deviations(subject(), VersionMeasurements("spring", rows), tmp_path) == []
    rows["1.9.0"]["springs"][LIMIT] = 0.01 * (1 + 2 * TOLERANCE)
    (line,) = deviations(subject(), VersionMeasurements("spring", rows), tmp_path)
    assert line == f"spring 1.9.0, springs, {LIMIT}: 0.01 in the baseline, {0.01 * (1 + 2 * TOLERANCE)} now"


def test_words_and_what_is_missing_deviate_too(tmp_path: Path) -> None:
    """Another word; a measure gone, or new; a version that cannot be installed. What is not asked is not compared."""
    baseline.write(MEASURED, tmp_path)
    rows = made_up()
    rows["1.9.0"]["spring"]["crash list: a"] = "hangs"
    del rows["1.9.0"]["springs"]["can: mesh"]
    rows["1.10.0"]["springs"]["can: fly"] = "kept"
    del rows["2.0.0"]
    assert deviations(subject(), VersionMeasurements("spring", rows, {"2.0.0": "there is no index"}), tmp_path) == [
        "spring 2.0.0: there is no index",
        "spring 1.9.0, springs, can: mesh: kept in the baseline, nothing now",
        "spring 1.9.0, spring, crash list: a: SIGABRT in the baseline, hangs now",
        "spring 1.10.0, springs, can: fly: nothing in the baseline, kept now",
    ]
    only_springs = replace(subject(), whole=False)
    of_springs = {version: {"springs": rows["springs"]} for version, rows in made_up().items()}
    assert deviations(only_springs, VersionMeasurements("spring", of_springs), tmp_path) == []


def test_an_engine_that_no_longer_runs_is_one_line(tmp_path: Path) -> None:
    """Not one for everything it is not asked then."""
    baseline.write(MEASURED, tmp_path)
    rows = made_up()
    rows["1.9.0"]["springs"] = {"runs": "crashed: killed by SIGSEGV"}
    (line,) = deviations(subject(), VersionMeasurements("spring", rows), tmp_path)
    assert line == "spring 1.9.0, springs, runs: yes in the baseline, crashed: killed by SIGSEGV now"


def test_an_engine_the_baseline_does_not_know_is_not_compared(tmp_path: Path) -> None:
    """Adding one to the lab breaks no check; it is named, so that it is not forgotten."""
    baseline.write(MEASURED, tmp_path)
    rows = made_up()
    rows["1.9.0"]["KickDrift"] = {"runs": "yes"}
    more = replace(subject(), engines=[*subject().engines, Doctored()])
    assert deviations(more, VersionMeasurements("spring", rows), tmp_path) == []
    assert baseline.unknown_engines(more, tmp_path) == ["KickDrift"]
    assert baseline.unknown_engines(subject(), tmp_path) == []


def test_writing_keeps_what_was_not_measured(tmp_path: Path) -> None:
    """Other versions, and other engines of the same version."""
    baseline.write(MEASURED, tmp_path)
    baseline.write(VersionMeasurements("spring", {"1.9.0": {"springs": {"runs": "no"}}, "1.9.5": {}}), tmp_path)
    found = baseline.read("spring", tmp_path)
    assert list(found) == ["1.9.0", "1.9.5", "1.10.0", "2.0.0"]
    assert found["1.9.0"] == {"springs": {"runs": "no"}, "spring": {"crash list: a": "SIGABRT"}}
    assert found["2.0.0"] == made_up()["2.0.0"]


def test_the_baseline_has_what_was_promised() -> None:
    """Every version, with every engine of its package; MuJoCo's cable ends with 4.0.0, in MuJoCo's own words."""
    for package, promised in KEPT.items():
        kept = baseline.read(package)
        assert set(promised) <= set(kept)
        for version in promised:
            assert {package} < set(kept[version]) <= set(find_subject(package).names), f"{package} {version}"
    runs = {version: rows["mujoco_cable"]["runs"] for version, rows in baseline.read("mujoco").items()}
    assert runs["3.17.0"] == "yes"
    assert "unrecognized element" in str(runs["4.0.0"])


def test_a_package_without_a_baseline_says_so(tmp_path: Path) -> None:
    """And which have one."""
    with pytest.raises(InputError, match="spring has no baseline"):
        baseline.kept_versions(subject(), [], tmp_path)


def test_all_that_is_kept_is_measured_unless_some_is_asked_for(tmp_path: Path) -> None:
    """In its order; words are kept as they are, for people to read."""
    baseline.write(MEASURED, tmp_path)
    assert baseline.kept_versions(subject(), [], tmp_path) == ["1.9.0", "1.10.0", "2.0.0"]
    assert baseline.kept_versions(subject(), ["2.0.0"], tmp_path) == ["2.0.0"]
    rows = made_up()
    rows["1.9.0"]["springs"]["can: mesh"] = "refused: für Netze"
    file = baseline.write(VersionMeasurements("spring", rows), tmp_path)
    assert "refused: für Netze" in file.read_text(encoding="utf-8")


def test_a_package_is_asked_about_as_a_whole_and_an_engine_is_not() -> None:
    """Only with a package is its list of crashes looked at."""
    whole, one = find_subject("mujoco"), find_subject("mujoco_tendons")
    assert (whole.whole, one.whole) == (True, False)
    assert (one.package, [engine.name for engine in one.engines]) == ("mujoco", ["mujoco_tendons"])
    assert {engine.package for engine in whole.engines} == {"mujoco"}
    assert len(whole.engines) > 1
