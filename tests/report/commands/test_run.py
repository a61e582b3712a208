"""`springlab run`: what it leaves, and what a failure ends."""

from __future__ import annotations

from pathlib import Path

import pytest

from experiments.experiment import find
from experiments.runs.store import StoreError
from tests.report.commands.terminal import springlab
from tests.report.page.canned import RESULTS
from tests.report.page.doubles import answering, failing, put


def test_run_writes_figure_and_tables_and_goes_on_after_a_failure(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """`springlab run` of two experiments, one of which raises: one line on that, exit code 1, the other is done."""
    put(monkeypatch, failing("errata", ArithmeticError("no")))
    put(monkeypatch, answering("stiff_limit", RESULTS["stiff_limit"]["no engine"]()))
    said = springlab("run", "errata", "stiff_limit", "--out", str(tmp_path))
    assert said.code == 1
    assert said.err == "springlab: errata: ArithmeticError: no\n"
    assert find("stiff_limit").question in " ".join(said.out.split())
    assert {file.name for file in (tmp_path / "stiff_limit").iterdir()} == {"stiff_limit.csv", "stiff_limit.svg"}
    assert springlab("run", "stiff_limit", "--out", str(tmp_path)).code == 0


def test_a_store_that_fails_midway_ends_run_with_its_line(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """It is no failure of the experiment's: exit code 2, and the next experiment is not begun."""
    put(monkeypatch, failing("errata", StoreError("store s: the disk is full")))
    put(monkeypatch, answering("stiff_limit", RESULTS["stiff_limit"]["no engine"]()))
    said = springlab("run", "errata", "stiff_limit", "--out", str(tmp_path))
    assert (said.code, said.out, said.err) == (2, "", "springlab: store s: the disk is full\n")


def test_a_folder_that_cannot_be_written_is_one_line(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Exit code 2: `results` is a file here."""
    put(monkeypatch, answering("errata", RESULTS["errata"]["usual"]()))
    (tmp_path / "results").write_text("")
    said = springlab("run", "errata", "--out", str(tmp_path / "results"), "--store", str(tmp_path / "store.sqlite"))
    assert (said.code, said.out, said.err.count("\n")) == (2, "", 1)
    assert str(tmp_path / "results") in said.err
