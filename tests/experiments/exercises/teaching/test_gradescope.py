"""Gradescope's results and its zip, without a sandbox: scores of both checks, who sees what, what `grade` is told."""

from __future__ import annotations

import json
import zipfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from experiments.exercises.exercise import find
from experiments.exercises.grading import Grade
from experiments.exercises.handed_in.submission import Submission
from experiments.exercises.process.sandbox import Limits
from experiments.exercises.teaching import gradescope
from experiments.exercises.teaching.words import UNSEEN
from experiments.exercises.verdict.findings import Finding
from experiments.exercises.verdict.judge import Verdict

RIGHT = Verdict("right", (), (True, True, True), 0.0, 0.0, layers=("limits", "seccomp"))
WRONG = Verdict("mistake", (Finding("gravity_sign", "It falls up."),), (True, False, False), layers=("limits",))
OWN = Submission("euler.py", "", find("1"))


@pytest.mark.parametrize(
    ("public", "hidden", "score", "scores", "finding"),
    [
        (RIGHT, None, 100.0, [100.0], "right"),
        (WRONG, None, 33.33, [33.33], "gravity_sign"),
        (RIGHT, WRONG, 66.67, [100.0, 33.33], "gravity_sign"),
        (WRONG, RIGHT, 66.67, [33.33, 100.0], "gravity_sign"),
    ],
)
def test_each_check_is_a_test_with_its_own_score(
    public: Verdict, hidden: Verdict | None, score: float, scores: list[float], finding: str
) -> None:
    """The public one is seen at once, the hidden one when grades are published; seconds to two digits."""
    document = gradescope.results(OWN, Grade(public, hidden, 1.23456))
    assert (document["score"], document["execution_time"]) == (score, 1.23)
    tests = document["tests"]
    assert [test["score"] for test in tests] == scores
    assert [test["status"] for test in tests] == ["passed" if s == 100.0 else "failed" for s in scores]
    assert [test["name"] for test in tests] == ["Public check", "Hidden check"][: len(scores)]
    assert [test["number"] for test in tests] == ["1", "2"][: len(scores)]
    assert [test["visibility"] for test in tests] == ["visible", "after_published"][: len(scores)]
    assert document["extra_data"]["finding"] == finding
    assert document["extra_data"]["walls"] == list(public.layers)


def test_what_is_seen_at_once_says_nothing_of_the_hidden_check() -> None:
    """That it is told later, where it has run; that it has not run, where it has not."""
    alone, (seen, later) = (gradescope.results(OWN, Grade(RIGHT, hidden, 1.0))["tests"] for hidden in (None, WRONG))
    assert UNSEEN in alone[0]["output"]
    assert "The hidden one is told later." in seen["output"]
    assert "gravity_sign" not in seen["output"]
    assert "gravity_sign" in later["output"]


def test_who_is_refused_has_no_points_and_who_could_not_be_graded_no_score() -> None:
    """The reason is told in both."""
    document = gradescope.refused("no file")
    (test,) = document["tests"]
    assert (document["score"], test["score"], test["status"], test["output"]) == (0.0, 0.0, "failed", "no file")
    assert (test["name"], test["number"], test["max_score"], test["visibility"]) == (
        "Public check",
        "1",
        100.0,
        "visible",
    )
    alone = gradescope.results(OWN, Grade(replace(RIGHT, passed=(True,)), None, 1.0))["tests"]
    assert [(test["score"], test["max_score"]) for test in alone] == [(100.0, 100.0)]
    assert "score" not in gradescope.not_graded("no memory")
    assert "not your fault: no memory." in gradescope.not_graded("no memory")["output"]


@pytest.mark.parametrize(
    ("settings", "keyed", "exposed"),
    [({}, True, False), ({"keyed": False}, False, False), ({"exposed": True}, True, True)],
)
def test_the_settings_of_the_zip_are_those_of_its_grades(
    settings: dict[str, Any], keyed: bool, exposed: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The key, whether numbers depend on it, whether submissions may reach files; of several files the one meant."""
    asked: list[tuple[Submission, str, Limits]] = []
    monkeypatch.setattr(gradescope, "grade", lambda *given: asked.append(given) or Grade(RIGHT, RIGHT, 1.0))
    for name in ("another.py", "euler.py"):
        (tmp_path / name).write_text("EXERCISE = 1\n")
    document = gradescope.grade_folder(tmp_path, {"exercise": "euler", "key": "sesame", **settings})
    ((submission, key, limits),) = asked
    assert document["score"] == 100.0
    assert (submission.name, key) == ("euler.py", "sesame")
    assert (submission.keyed, limits) == (keyed, Limits(exposed=exposed))


@pytest.mark.parametrize(("exercise", "expected"), [("4", "whole_state.py or whole_state.c"), ("8", "which_engine.py")])
def test_a_folder_of_none_or_several_is_refused_by_the_name_that_is_expected(
    exercise: str, expected: str, tmp_path: Path
) -> None:
    """With that of a C file where it may be one."""
    for name in ("one.py", "two.py"):
        (tmp_path / name).write_text("x = 1\n")
    refused = gradescope.grade_folder(tmp_path, {"exercise": find(exercise).name, "key": "k"})
    assert refused["output"] == f"2 files: expected one, {expected}"


@pytest.mark.parametrize("options", [{}, {"exposed": True}, {"keyed": False}])
@pytest.mark.parametrize(("exercise", "in_c"), [("4", True), ("8", False)])
def test_the_zip_has_its_settings_and_two_programs(
    exercise: str, in_c: bool, options: dict[str, bool], tmp_path: Path
) -> None:
    """Only these two are executable; the compiler is asked for where an exercise can be done in C."""
    gradescope.write_zip(find(exercise), "sesame", tmp_path / "a.zip", **options)
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        settings = json.loads(archive.read("exercise.json"))
        modes = {entry.filename: entry.external_attr >> 16 & 0o777 for entry in archive.infolist()}
        setup = archive.read("setup.sh").decode()
    assert settings == {
        "exercise": find(exercise).name,
        "key": "sesame",
        "exposed": "exposed" in options,
        "keyed": "keyed" not in options,
    }
    assert {name for name, mode in modes.items() if mode == 0o755} == {"setup.sh", "run_autograder"}
    assert {mode for name, mode in modes.items() if name.endswith(".py")} == {0o644}
    assert ("command -v cc" in setup) == in_c
