"""Versions of engines: measured, compared with one another, and the command that does it."""

from __future__ import annotations

import copy
import json
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from engines.engine import find
from engines.process.isolation import EngineStepper
from experiments.engine_versions import baseline, conformance, versions
from experiments.engine_versions.changes import TOLERANCE, changes, differences, result_of, same
from experiments.engine_versions.conformance import capability, measure
from experiments.engine_versions.versions import (
    Subject,
    VersionMeasurements,
    in_order,
    measure_versions,
    where_it_changed,
)
from reference.errors import InputError
from reference.outcome import Outcome
from report.figures import draw
from report.figures.versions import MARK
from tests.conformance import doctored
from tests.conformance.doctored import Doctored, DoctoredSingle
from tests.engines.process.index import environment_or_skip
from tests.engines.process.misbehaving import Misbehaving, Segfaults
from tests.experiments.engine_versions.spring_versions import LIMIT, MEASURED, made_up
from tests.report.commands.terminal import springlab


def test_findings_tables_and_figure_are_made_from_the_rows() -> None:
    """What changed is counted and named; an engine that does not run is one change, not many."""
    result = result_of(MEASURED)
    assert result.findings == [
        "The motion changed: spring 1.10.0 changed 2 of 4 measurements of 1.9.0. "
        f"Of springs: {LIMIT}; spring: crash list: a.",
        "The motion changed: spring 2.0.0 changed 1 of 2 measurements of 1.10.0. Of springs: runs.",
    ]
    rows = {(row[0], row[1]): row[2:] for row in result.tables[0].rows}
    assert rows[("springs", LIMIT)] == [0.01, 0.011, None]
    assert ("springs", "can: mesh") not in rows
    picture = draw("versions", result)
    texts = [text.get_text() for text in picture.figure.axes[0].texts]
    assert texts.count(f"{MARK}0.011") == 1
    assert len([text for text in texts if text.startswith(MARK)]) == 3
    assert f"springs, {LIMIT}: 0.01 in 1.9.0, 0.011 in 1.10.0, not asked in 2.0.0" in picture.alt
    assert picture.svg().startswith("<svg")


def test_without_a_change_it_says_so() -> None:
    """In the sentence and in the figure's words."""
    rows = made_up()
    result = result_of(VersionMeasurements("spring", {"1": rows["1.9.0"], "2": rows["1.9.0"]}))
    assert result.findings == ["spring 2 changed nothing: 4 measurements are those of 1."]
    assert "No measurement of spring differs" in draw("versions", result).alt
    assert changes(rows["1.9.0"], rows["1.9.0"]) == []


def test_numbers_are_the_same_within_the_tolerance_and_words_when_equal() -> None:
    """A number is no word."""
    assert same(1.0, 1.0 + TOLERANCE / 2)
    assert not same(1.0, 1.0 + 2 * TOLERANCE)
    assert not same(1.0, "1.0")
    assert not same("fine", None)


def test_versions_are_in_the_order_of_their_numbers() -> None:
    """3.10 is newer than 3.9; twice is once."""
    assert in_order(["3.17.0", "3.2.7", "4.0.0", "3.2.7", "3.3.7"]) == ["3.2.7", "3.3.7", "3.17.0", "4.0.0"]


@pytest.fixture
def undamped_limit_only(monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Leave out the limits in other cases, which take long: the rows that are then missing."""
    others = set(conformance.LIMITED) - {"undamped"}
    monkeypatch.setattr(conformance, "LIMITED", {"undamped": {}})
    return {f"largest stable dt [s], {case}" for case in others}


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.usefixtures("undamped_limit_only")
def test_the_honest_engine_is_measured_as_what_it_is() -> None:
    """Kick-drift with explicit damping, to rounding, on everything; its limit is the closed form.

    Undamped, h^2 w^2 < 4 with w^2 = 4 k/m sin^2((2n - 1) pi / (4n + 2)), the fastest mode of n masses in a row, fixed
    at one end. Near it, where two eigenvalues meet, a perturbation grows in proportion to time: some 1e-6 below it
    that is a doubling in a run. Only what belongs to a limit off by 1e-5 would deviate from the baseline.
    """
    rows = measure(EngineStepper(Doctored()))
    assert [rows[f"identified, {case}"] for case in ("plain", "damping", "drag")] == ["kick_drift"] * 3
    assert {value for name, value in rows.items() if name.startswith("can: ")} == {"kept"}
    assert rows["runs"] == "yes"
    limit = 2 / (2 * np.sqrt(200 / 0.02) * np.sin(19 * np.pi / 42))
    assert rows[LIMIT] == pytest.approx(limit, rel=TOLERANCE)


@pytest.fixture
def no_limits(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave the limits out, which take long."""
    monkeypatch.setattr(conformance, "LIMITED", {})


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.usefixtures("no_limits")
def test_liars_are_seen_in_the_rows() -> None:
    """An integrator that moves before it kicks, springs a millionth too stiff, a mass for all, drag forgotten."""
    honest = set(measure(EngineStepper(Doctored())).items())

    def told(liar: type[doctored.KickDrift]) -> set[str]:
        return {name for name, _ in set(measure(EngineStepper(Doctored(liar))).items()) - honest}

    assert {"identified, plain", "can: mesh"} <= told(doctored.Euler)
    assert {"identified, plain", "can: damping"} <= told(doctored.StifferByAMillionth)
    assert {"can: masses"} <= told(doctored.OneMassForAll)
    assert "identified, drag" in told(doctored.ForgetsDrag)


def test_what_single_precision_rounds_breaks_no_capability() -> None:
    """Some 1e-6 m in 200 steps: kept; another mass, which moves masses by a tenth of the string: broken."""
    rounding = EngineStepper(DoctoredSingle(doctored.RoundsToSingle))
    assert [capability(rounding, name) for name in ("masses", "damping")] == ["kept"] * 2
    assert capability(EngineStepper(DoctoredSingle(doctored.OneMassInSingle)), "masses").startswith("broken: ")
    assert capability(EngineStepper(Doctored(doctored.RoundsToSingle)), "masses").startswith("broken: ")


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.usefixtures("no_limits")
def test_an_engine_that_refuses_is_told_from_one_that_breaks() -> None:
    """Refused with its reason; stepped though it said it could not; not running at all."""
    limited = Doctored(capabilities=Doctored().capabilities - {"mesh"})
    assert str(measure(EngineStepper(limited))["can: mesh"]).startswith("refused: ")
    assert str(measure(EngineStepper(replace(limited, refuses=False)))["can: mesh"]).startswith("broken: ")
    absent = EngineStepper(replace(limited, package="no-such-engine"))
    (answer,) = measure(absent).items()
    assert (answer[0], str(answer[1]).partition(":")[0]) == ("runs", "unsupported")


def test_the_command_fails_on_a_doctored_baseline_and_names_the_number(monkeypatch: pytest.MonkeyPatch) -> None:
    """Exit code 1 and one line; with the baseline as it is, exit code 0."""

    def as_kept(subject: Subject, wanted: list[str], *_: object, **__: object) -> VersionMeasurements:
        kept = baseline.read(subject.package)
        return VersionMeasurements(subject.package, {version: kept[version] for version in wanted})

    monkeypatch.setattr(versions, "measure_versions", as_kept)
    done = springlab("versions", "--check")
    assert done.code == 0, done.out
    assert "measurements are as in the baseline" in done.out
    doctored_rows = copy.deepcopy(baseline.read("pymunk"))
    doctored_rows["7.3.1"]["pymunk_springs"][LIMIT] = 0.0102
    measured = VersionMeasurements("pymunk", {"7.3.1": doctored_rows["7.3.1"]})
    monkeypatch.setattr(versions, "measure_versions", lambda *_, **__: measured)
    done = springlab("versions", "pymunk", "7.3.1", "--check")
    assert done.code == 1
    assert done.out == f"pymunk 7.3.1, pymunk_springs, {LIMIT}: 0.01011292 in the baseline, 0.0102 now\n"
    assert json.loads(springlab("versions", "pymunk", "7.3.1", "--check", "--json").out)["differences"]


def test_the_command_writes_tables_a_figure_and_json(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And says what a version changed."""
    monkeypatch.setattr(versions, "measure_versions", lambda *_, **__: MEASURED)
    words = ("versions", "pymunk", "6.8.1", "7.3.1", "--out", str(tmp_path))
    done = springlab(*words)
    assert done.code == 0
    assert "The motion changed: spring 2.0.0 changed 1 of 2 measurements of 1.10.0" in done.out
    assert {file.suffix for file in tmp_path.glob("spring*")} == {".csv", ".svg", ".json"}
    document = json.loads(springlab(*words, "--json").out)["spring"]
    assert document["versions"] == made_up()
    change = {"from": "1.9.0", "to": "1.10.0", "engine": "springs", "measure": LIMIT, "before": 0.01, "after": 0.011}
    assert document["changes"][0] == change


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("", "expected ENGINE and VERSION..., or --all, or --check"),
        ("pymnk 7.3.1", "unknown engine 'pymnk': did you mean 'pymunk'?"),
        ("mujoco_cabel", "unknown engine 'mujoco_cabel': did you mean 'mujoco_cable'?"),
        ("pymunk latest", "pymunk version 'latest': expected one such as 1.2.3"),
        ("pymunk 0.0.1 --check", "pymunk 0.0.1 is not in the baseline: expected 6.8.1, "),
    ],
)
def test_bad_words_are_one_line(words: str, said: str) -> None:
    """Exit code 2."""
    done = springlab("versions", *words.split())
    assert done.code == 2
    assert said in done.err
    assert done.err.count("\n") == 1


@pytest.mark.rotating(7, in_turn=True)
def test_a_version_that_never_was_is_one_line_and_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Exit code 2, and no folder in the cache. Without an index that is the reason, in a line as well."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    done = springlab("versions", "pymunk", "99.9")
    assert done.code == 2
    assert done.err.startswith("springlab: pymunk==99.9 cannot be installed: ")
    assert done.err.count("\n") == 1
    assert not [found for found in (tmp_path / "springlab" / "environments").iterdir() if found.is_dir()]


@pytest.mark.rotating(7)
@pytest.mark.parametrize("version", ["6.8.1", "7.3.1"])
def test_a_version_is_as_the_baseline_says(undamped_limit_only: set[str], version: str) -> None:
    """Measured now, in its own environment from the package index: the package, and one engine of it."""
    environment_or_skip("pymunk", version)
    subject = Subject("pymunk", [find("pymunk_springs")], whole=True)
    measured = measure_versions(subject, [version], lambda _: None)
    of_subject = {name: rows for name, rows in baseline.read("pymunk")[version].items() if name in subject.names}
    found = differences(of_subject, measured.rows[version])
    assert {change.measure for change in found} == undamped_limit_only, found


@pytest.mark.parametrize("first", range(1, 12))
def test_the_version_that_changed_it_is_found_by_halving(first: int) -> None:
    """Of twelve versions, wherever the change came; four of them are looked at besides the ends, at most."""
    subject = Subject("spring", [], whole=True)
    names = [f"1.{n}" for n in range(12)]
    asked: list[str] = []

    def measured(version: str) -> VersionMeasurements:
        asked.append(version)
        return VersionMeasurements("spring", {version: {"spring": {"a": float(names.index(version) >= first)}}})

    found = where_it_changed(subject, names, measured, lambda before, after: bool(changes(before, after)))
    assert list(found.rows) == [names[first - 1], names[first]]
    assert len(asked) <= 6


def test_without_a_change_the_ends_are_told() -> None:
    """And nothing in between is looked at; one version alone is refused."""
    subject = Subject("spring", [], whole=True)

    def measured(version: str) -> VersionMeasurements:
        return VersionMeasurements("spring", {version: {"spring": {"a": 1.0}}})

    found = where_it_changed(subject, ["1", "2", "3"], measured, lambda before, after: bool(changes(before, after)))
    assert list(found.rows) == ["1", "3"]
    with pytest.raises(InputError, match="two versions or more"):
        where_it_changed(subject, ["1"], measured, lambda before, after: False)


def test_a_change_of_words_alone_is_no_change_of_the_motion() -> None:
    """What it can and how it crashes is told apart from how it steps."""
    rows = made_up()["1.9.0"]
    other = {name: dict(of_name) for name, of_name in rows.items()}
    other["spring"]["crash list: a"] = "another end"
    result = result_of(VersionMeasurements("spring", {"1": rows, "2": other}))
    assert result.findings[0].startswith("The motion is the same: ")


def test_every_version_is_asked_everything_and_has_its_own_answers(monkeypatch: pytest.MonkeyPatch) -> None:
    """Conformance of each engine; of a whole package its NumPy, free springs and crashes too."""
    engines = [Doctored(), Misbehaving(Segfaults)]
    pythons = {"1.0": Path("one"), "2.0": Path("two")}
    monkeypatch.setattr(versions, "measure", lambda stepper: {"can": f"{stepper.name} in {stepper.version}"})
    monkeypatch.setattr(versions, "_numpy", lambda python: {"NumPy": str(python)})
    monkeypatch.setattr(versions.free_spring, "of_package", lambda package: [SimpleNamespace(name="its spring")])
    monkeypatch.setattr(versions.free_spring, "measured", lambda spring, python: {spring.name: f"{python} free"})
    monkeypatch.setattr(versions, "crash_cases", lambda package: {"a": SimpleNamespace(name="a")})
    monkeypatch.setattr(versions, "_break", lambda case, python: {f"crash list: {case.name}": f"{python} broke"})
    told: list[str] = []
    found = versions._measure(Subject("doctored", engines, whole=True), pythons, told.append)
    for version, python in (("1.0", "one"), ("2.0", "two")):
        assert found[version] == {
            **{engine.name: {"can": f"{engine.name} in {version}"} for engine in engines},
            "doctored": {"NumPy": python, "its spring": f"{python} free", "crash list: a": f"{python} broke"},
        }
    assert len(told) == 2 * 5
    assert told[-1].startswith("10 of 10 done: doctored ")
    one = versions._measure(Subject("doctored", engines[:1], whole=False), pythons, told.append)
    assert [list(rows) for rows in one.values()] == [[engines[0].name]] * 2


@pytest.mark.parametrize(("answer", "words"), [("1.26.4", "1.26.4"), (Outcome("crashed", "killed"), "crashed: killed")])
def test_the_numpy_of_a_version_is_told_or_why_there_is_none(
    answer: str | Outcome, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Asked of the version's own Python."""
    monkeypatch.setattr(versions, "isolated", lambda _, python: answer if python == Path("own") else None)
    assert versions._numpy(Path("own")) == {"NumPy": words}


def test_what_only_one_version_was_asked_has_not_changed() -> None:
    """It is no change that a measure is new, or gone."""
    before = {"engine": {"runs": "yes", "old": 1.0, "both": 1.0}}
    after = {"engine": {"runs": "yes", "new": 2.0, "both": 3.0}}
    assert [(c.measure, c.before, c.after) for c in changes(before, after)] == [("both", 1.0, 3.0)]
    assert [c.measure for c in differences(before, after)] == ["old", "both", "new"]


def test_both_versions_beside_a_change_have_rows_of_their_own() -> None:
    """The last that does as the first, and the next."""
    order = [f"1.{i}" for i in range(9)]
    measured = {
        v: VersionMeasurements("spring", {v: {"springs": {"runs": f"since {i // 5}, {v}"}}})
        for i, v in enumerate(order)
    }
    found = where_it_changed(
        Subject("spring", [], whole=True),
        order[::-1],
        measured.__getitem__,
        lambda a, b: str(a["springs"]["runs"])[:7] != str(b["springs"]["runs"])[:7],
    )
    assert found.rows == {"1.4": {"springs": {"runs": "since 0, 1.4"}}, "1.5": {"springs": {"runs": "since 1, 1.5"}}}
