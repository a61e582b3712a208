"""The registry of experiments: each under its own name, in the order they are shown; a taken name is refused."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from experiments import order
from experiments.experiment import NAMES, Experiment, Result, Table, experiments, find, write_tables
from reference.errors import InputError


def test_experiments_are_in_the_order_of_their_names() -> None:
    """And each is called what its module is."""
    assert [*experiments()] == [*NAMES]
    assert [experiment.name for experiment in experiments().values()] == [*NAMES]


def test_a_name_that_is_taken_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """In one line, with the module that has it: the second would hide the first."""
    monkeypatch.setattr(order, "EXPERIMENT", replace(order.EXPERIMENT, name="maps"))
    with pytest.raises(InputError, match=r"experiment 'maps' is taken by experiments\.maps: expected another name"):
        experiments()


def test_an_unknown_name_is_refused_with_a_suggestion() -> None:
    """As for every unknown name."""
    with pytest.raises(InputError, match=r"unknown experiment 'ordr': did you mean 'order'\?"):
        find("ordr")


def test_tables_are_written_as_they_are_called(tmp_path: Path) -> None:
    """Each into its own file, in a folder that is made, and again into one that is there; None is an empty cell."""
    result = Result([], [Table("one", ["a", "b"], [[1, None], [2.5, "x"]]), Table("other", ["c"], [[3]])])
    for _ in range(2):
        files = write_tables(result, tmp_path / "deep" / "er")
        assert [file.name for file in files] == ["one.csv", "other.csv"]
        assert [file.read_text().splitlines() for file in files] == [["a,b", "1,", "2.5,x"], ["c", "3"]]


def test_an_experiment_is_in_the_report_and_may_run_beside_others_unless_it_says_otherwise() -> None:
    """Those that measure times say so: nothing may run beside them."""
    plain = Experiment("name", "title", "question", "1", lambda _: Result([], []))
    assert (plain.in_report, plain.timed, plain.run_in_full) == (True, False, None)
    assert {name for name, one in experiments().items() if one.timed} == {"cost", "speed", "million_runs"}
    assert {name for name, one in experiments().items() if not one.in_report} >= {"speed", "million_runs"}
