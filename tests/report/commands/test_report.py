"""`springlab report` without its experiments: what is told of each section, and the exit code."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import click
import pytest
from click.testing import CliRunner

from report.commands.report import report_command
from report.page import written


def section(name: str, *findings: str) -> Any:
    """One with these findings; without any its experiment has failed."""
    result = SimpleNamespace(findings=list(findings)) if findings else None
    return SimpleNamespace(
        experiment=SimpleNamespace(name=name, title=name.upper()), result=result, failure="it failed"
    )


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, Any]]:
    """What was asked for; sections are those in the last entry."""
    asked: list[dict[str, Any]] = []

    def write(names: Any, out: Path, *_: Any, **options: Any) -> Any:
        asked.append({"names": names, **options})
        sections = [section("order", "of order two", "and more"), section("advice", "this dt", "that engine")]
        failed = [section("cost")] if "cost" in names else []
        return SimpleNamespace(sections=[*sections, *failed], file=out / "index.html")

    monkeypatch.setattr("report.commands.report.chosen_runner", lambda resume, store: nullcontext())
    monkeypatch.setattr(written, "write_page", write)
    monkeypatch.setattr(written, "write_scene_page", lambda scene, out, tell: write((scene,), out))
    return asked


def run(*words: str) -> tuple[int, str]:
    """Exit code and what was said."""
    done = CliRunner().invoke(report_command, [*words], catch_exceptions=False, standalone_mode=False)
    return done.return_value, done.output


def test_each_section_has_its_first_finding_and_advice_all(asked: list[dict[str, Any]], tmp_path: Path) -> None:
    """Under its title; the file comes last."""
    store = tmp_path / "store"
    store.touch()
    code, said = run("--out", str(tmp_path), "--store", str(store))
    assert code == 0
    assert said.splitlines() == [
        "ORDER: of order two",
        "",
        "ADVICE: this dt",
        "that engine",
        "",
        f"written: {tmp_path / 'index.html'}",
    ]
    assert asked == [{"names": (), "fresh": False, "full": False}]


def test_one_experiment_that_failed_is_told_and_the_code_is_1(asked: list[dict[str, Any]], tmp_path: Path) -> None:
    """Beside others that did not; of a scene the same page is asked for."""
    (tmp_path / "store").touch()
    words = (
        "--out",
        str(tmp_path),
        "--store",
        str(tmp_path / "store"),
        "--only",
        "order",
        "--only",
        "cost",
        "--fresh",
    )
    code, said = run(*words, "--full")
    assert (code, "COST: it failed" in said) == (1, True)
    assert asked == [{"names": ("order", "cost"), "fresh": True, "full": True}]
    assert run("string", "--out", str(tmp_path), "--store", str(tmp_path / "store"))[0] == 0
    assert asked[-1] == {"names": ("string",)}


def test_the_page_is_opened_where_that_is_asked_for(
    asked: list[dict[str, Any]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And only there."""
    opened: list[str] = []
    monkeypatch.setattr(click, "launch", opened.append)
    (tmp_path / "store").touch()
    for words, shown in ((), []), (("--open",), [str(tmp_path / "index.html")]):
        run("--out", str(tmp_path), "--store", str(tmp_path / "store"), *words)
        assert opened == shown


def test_processes_are_made_ready_where_nothing_is_kept(
    asked: list[dict[str, Any]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At once, of a page of experiments: a scene's is made here, and what is kept is shown again."""
    made: list[bool] = []
    monkeypatch.setattr("report.page.processes.prepare_processes", lambda at_once: made.append(at_once))
    store, words = tmp_path / "store", ("--out", str(tmp_path), "--store", str(tmp_path / "store"))
    run("string", *words)
    assert made == []
    run(*words)
    assert made == [True]
    store.touch()
    run(*words)
    assert made == [True]
