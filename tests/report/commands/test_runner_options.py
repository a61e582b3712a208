"""Who runs, and what is said where that is interrupted."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click
import pytest

from experiments.runs import cluster
from experiments.runs.runner import LocalExecutor, current
from report.commands.main import main
from report.commands.runner_options import chosen_runner


@pytest.mark.parametrize(("resume", "again"), [(True, "the same command"), (False, "the same command without --fresh")])
def test_after_ctrl_c_it_is_said_how_to_go_on(
    resume: bool, again: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the code that shells know it by; what is done is kept."""
    store = tmp_path / "store.sqlite"
    with pytest.raises(click.exceptions.Exit) as ending, chosen_runner(resume, store):
        raise KeyboardInterrupt
    assert ending.value.exit_code == 130
    assert capsys.readouterr().err == f"springlab: interrupted; what is done is kept in {store}: {again} goes on\n"
    assert store.exists()


def test_runs_are_made_here_or_by_a_cluster(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As many at once as are asked for; whoever it was is stopped in the end, and is the runner no more."""
    asked: list[Sequence[object]] = []

    class Dask(LocalExecutor):
        """One that is not there."""

        def __init__(self, address: str, jobs: int | None) -> None:
            super().__init__(jobs)
            asked.append((address, jobs))

        def stop(self) -> None:
            asked.append("stopped")

    monkeypatch.setattr(cluster, "DaskExecutor", Dask)
    before = current()
    with chosen_runner(True, tmp_path / "store.sqlite", 3, "tcp://there:1") as runner:
        assert current() is runner
    assert asked == [("tcp://there:1", 3), "stopped"]
    assert current() is not runner
    with chosen_runner(True, tmp_path / "store.sqlite", 3) as runner:
        pass
    assert asked[2:] == []
    assert type(current()) is type(before)


def test_a_folder_that_is_gone_is_no_place_to_work_in(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """In a line, before anything else."""

    def gone() -> str:
        raise FileNotFoundError

    monkeypatch.setattr("os.getcwd", gone)
    monkeypatch.setattr("sys.argv", ["springlab", "list"])
    with pytest.raises(SystemExit) as ending:
        main()
    assert ending.value.code == 2
    said = "springlab: the folder this was called in is no more: expected another one (cd)\n"
    assert capsys.readouterr() == ("", said)
