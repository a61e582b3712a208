"""A million runs: what is measured of one, what is predicted of all, and where more cores help no more."""

from __future__ import annotations

import os

import pytest

from experiments.million_runs import CORES, RUNS, in_words, predicted, serial
from experiments.runs.cluster import BATCH_SECONDS
from tests.experiments.canned import million_runs
from tests.experiments.canned.million_runs import HANDS, KINDS, SIZE
from tests.experiments.canned.reading import finding, in_order, numbers, records

#: Beyond this machine's cores a run of 0.1 s and of 1 s take the process at the top this long [s].
AT_THE_TOP = [1e-3 + 0.2 * min(1.0, seconds / BATCH_SECONDS) for seconds in (0.1, 1.0)]


def test_what_is_done_one_after_another_is_a_floor() -> None:
    """RUNS times the longer of a core's share and that."""
    many = max(CORES)
    assert many > (os.cpu_count() or 1)
    for kind, floor in zip(KINDS, AT_THE_TOP, strict=True):
        assert predicted(kind, HANDS, many) == pytest.approx(RUNS * max(kind.seconds / many, floor))
        assert predicted(kind, HANDS, 1) == pytest.approx(RUNS * kind.seconds)


def test_the_table_has_a_measured_run_and_predicted_times_by_cores() -> None:
    """And up to how many cores help."""
    for row, kind, floor in zip(records(million_runs.usual()), KINDS, AT_THE_TOP, strict=True):
        assert (row["kind of run"], row["measured, a run [s]"]) == (kind.name, kind.seconds)
        for cores in CORES:
            assert row[f"predicted, {cores:,} cores"] == in_words(predicted(kind, HANDS, cores))
        assert row["predicted, cores that help"] == round(kind.seconds / floor)


def test_the_table_of_costs_says_where_each_is_spent() -> None:
    """On a core, or at the top."""
    rows = {row["what"]: row for row in records(million_runs.usual(), "million_runs_costs")}
    assert rows["heun"]["where"] == "on a core"
    assert rows["looking it up in the store"]["where"] == "at the top, always"
    assert rows["looking it up in the store"]["measured [s]"] == 7e-4


def test_sentences_go_from_the_quickest_to_the_slowest() -> None:
    """Milliseconds of a run; the times of all on few cores, then on many; the largest part at the top."""
    first = finding(million_runs.usual(), "Measured here")
    assert numbers(first)[:2] == [100, 1000]
    times = [in_words(predicted(kind, HANDS, n)) for n in (min(CORES), max(CORES)) for kind in KINDS]
    assert in_order(
        first, "(heun)", "(heun, in a new process after a crash)", *times[:2], f"on {min(CORES)}", *times[2:]
    )
    second = finding(million_runs.usual(), "bottleneck")
    helping = [round(kind.seconds / floor) for kind, floor in zip(KINDS, AT_THE_TOP, strict=True)]
    assert numbers(second) == pytest.approx([1e3 * AT_THE_TOP[0], *helping], rel=0.05)
    assert "looking it up in the store" in second


def test_the_store_s_size_is_of_one_and_of_all() -> None:
    """Kilobytes and gigabytes."""
    assert numbers(finding(million_runs.usual(), "in the store, a million")) == [SIZE / 1e3, SIZE * RUNS / 1e9]


@pytest.mark.parametrize(("seconds", "words"), [(3.0, "3 s"), (119.0, "119 s"), (120.0, "2 min"), (7200.0, "2 h")])
def test_times_are_said_in_units_that_suit_them(seconds: float, words: str) -> None:
    """From two of a unit on."""
    assert in_words(seconds) == words


def test_beyond_this_machines_cores_runs_go_to_a_cluster(monkeypatch: pytest.MonkeyPatch) -> None:
    """On four cores: up to those a task goes to a process, beyond it goes with its batch; of unknown many, one."""
    here, there = 1e-3 + 2e-3, AT_THE_TOP[0]
    monkeypatch.setattr(os, "cpu_count", lambda: 4)
    assert [serial(KINDS[0], HANDS, n) for n in (1, 4, 5)] == pytest.approx([here, here, there])
    monkeypatch.setattr(os, "cpu_count", lambda: None)
    assert [serial(KINDS[0], HANDS, n) for n in (1, 2)] == pytest.approx([here, there])
