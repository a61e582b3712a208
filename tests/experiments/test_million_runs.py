"""How the costs of a million runs are measured: by a clock that the tests wind, in this process."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from experiments import million_runs
from experiments.million_runs import HANDED, TIMED, Hand, Kind
from reference.stepper import catalogued


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """The time [s], and what is done meanwhile: calls, processes that were ended."""
    made = SimpleNamespace(now=0.0, done=[], stopped=0)
    monkeypatch.setattr(million_runs, "perf_counter", lambda: made.now)

    def stop() -> None:
        made.stopped += 1

    monkeypatch.setattr(million_runs, "supervisor", lambda: SimpleNamespace(stop=stop))
    return made


def takes(clock: SimpleNamespace, first: float, others: float) -> Callable[..., Any]:
    """A task that takes longer the first time [s]."""

    def task(*what: Any) -> int:
        clock.now += others if clock.done else first
        clock.done.append(what)
        return len(clock.done)

    return task


def test_the_mean_leaves_the_first_out(clock: SimpleNamespace) -> None:
    """Which is for warming up, but is among the answers."""
    mean, answers = million_runs._mean(takes(clock, 100.0, 0.5))
    assert mean == 0.5
    assert answers == list(range(1, HANDED + 1))


@pytest.mark.parametrize("afresh", [False, True])
def test_a_run_is_timed_in_a_process_that_has_run_one(
    afresh: bool, clock: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of strings that are all another; or in one that is new each time, but for the first."""
    monkeypatch.setattr(million_runs, "_do", takes(clock, 100.0, 0.25))
    heun = catalogued()["heun"]
    assert million_runs._seconds_of_run(heun, afresh=afresh, runs=4) == 0.25
    assert clock.stopped == (4 if afresh else 0)
    assert len({task.key for (task,) in clock.done}) == 5
    clock.done.clear()
    assert million_runs._seconds_of_run(heun) == 0.25
    assert len(clock.done) == TIMED + 1


def test_whether_runs_are_identified_is_a_part_of_the_task() -> None:
    """As the sweep has it."""
    plain, identified = (next(million_runs._tasks(catalogued()["heun"], wanted)) for wanted in (False, True))
    assert plain.key != identified.key


def test_one_stepper_of_each_package_is_timed_and_three_kinds_of_heun(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first engine of each, in their order."""
    engines = [SimpleNamespace(name=name, engine=SimpleNamespace(package=name[0])) for name in ("a1", "a2", "b1", "c1")]
    monkeypatch.setattr(million_runs, "installed_engines", lambda: engines)
    asked: list[tuple[str, dict[str, Any]]] = []

    def seconds(stepper: Any, **how: Any) -> float:
        asked.append((stepper.name, how))
        return float(len(asked))

    monkeypatch.setattr(million_runs, "_seconds_of_run", seconds)
    found = list(million_runs._kinds())
    assert found == [
        Kind("heun", 1.0),
        *(Kind(name, 2.0 + i) for i, name in enumerate(("a1", "b1", "c1"))),
        Kind("heun, identified", 5.0),
        Kind("heun, in a new process after a crash", 6.0),
    ]
    assert asked[-2:] == [("heun", {"identify": True, "runs": 3}), ("heun", {"afresh": True, "runs": 3})]


def test_what_the_process_at_the_top_does_is_timed_one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """On this machine's cores alone a process is talked to; a run takes some kilobytes in the store."""
    monkeypatch.setattr(million_runs, "HANDED", 20)
    monkeypatch.setattr(million_runs, "isolated", lambda function, *given, **limits: function(*given))
    hands, size = million_runs._hands()
    assert [(hand.name, hand.where) for hand in hands] == [
        ("making the task", "always"),
        ("its key", "always"),
        ("looking it up in the store", "always"),
        ("keeping its answer", "always"),
        ("a task to a process and back", "on this machine"),
    ]
    assert all(hand.seconds >= 0 for hand in hands)
    assert 500 < size < 50_000


@pytest.mark.parametrize("seconds", [None, 0.002])
def test_a_cluster_is_a_batch_of_runs_or_a_package_that_is_missing(
    seconds: float | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Which is a failure that is told."""
    hand = Hand("its key", 1e-4)
    monkeypatch.setattr(million_runs, "_kinds", lambda: [Kind("heun", 0.1)])
    monkeypatch.setattr(million_runs, "_hands", lambda: ([hand], 2000.0))
    monkeypatch.setattr(million_runs, "_dask", lambda: seconds)
    result = million_runs.run(lambda _: None)
    dask = Hand("a batch of runs to a Dask worker and back", 0.002, "on a cluster, a batch")
    assert result.data["hands"] == ([hand] if seconds is None else [hand, dask])
    missing = ["Dask: not installed; expected the extra springlab[cluster]"]
    assert list(result.failures) == (missing if seconds is None else [])
