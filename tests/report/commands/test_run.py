"""`springlab run`: what it leaves, and what a failure ends."""

from __future__ import annotations

from pathlib import Path

import pytest

from experiments.experiment import Experiment, Result, find
from experiments.runs.store import StoreError
from report.page.section import Section
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


def test_without_a_name_nothing_is_run() -> None:
    """In a line."""
    said = springlab("run")
    assert (said.code, said.err) == (2, "springlab: Missing argument 'EXPERIMENT...'.\n")


@pytest.mark.parametrize(("failed", "code"), [([], 0), (["errata"], 1), (["stiff_limit"], 1)])
def test_the_code_is_1_where_one_failed(
    failed: list[str], code: int, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Whichever; each goes into a folder of its own, which is told of those that did not."""

    def section(experiment: Experiment, folder: Path, tell: object) -> Section:
        assert folder == tmp_path / experiment.name
        return Section(experiment, failure="no") if experiment.name in failed else Section(experiment, Result([], []))

    monkeypatch.setattr("report.page.sections.section", section)
    monkeypatch.setattr("report.commands.run.show_result", lambda experiment, result: None)
    said = springlab("run", "errata", "stiff_limit", "--out", str(tmp_path), "--store", str(tmp_path / "store.sqlite"))
    assert said.code == code
    done = [name for name in ("errata", "stiff_limit") if name not in failed]
    assert said.out == "".join(f"written: {tmp_path / name}\n" for name in done)
    assert said.err == "".join(f"springlab: {name}: no\n" for name in failed)
