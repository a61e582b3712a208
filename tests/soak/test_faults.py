"""A fifth of all runs ends badly, and processes are killed at random meanwhile: every run has the outcome it is due."""

from __future__ import annotations

import multiprocessing.forkserver
import time
from collections.abc import Sequence
from pathlib import Path
from random import Random

import pytest

from engines.process.supervisor import KILLS, supervisor
from experiments.runs.runner import LocalExecutor, Runner
from experiments.runs.store import Store, outcome_of_answer
from experiments.runs.task import Task
from reference.outcome import Outcome
from tests.soak import faults
from tests.soak.children import kill_one
from tests.soak.conftest import Size
from tests.soak.stored import check_accounted_for, check_answer, check_rows_due, check_same_rows, rows
from tests.soak.sweep import task_of

#: Runs that take half a second.
SLOW = ("no answer", "took more")


def processes(random: Random) -> list[int]:
    """Those that do the runs; at every tenth look, the server that forks them."""
    server = multiprocessing.forkserver._forkserver._forkserver_pid  # type: ignore[attr-defined]
    return [server] if server is not None and random.random() < 0.1 else supervisor().pids()


def sweep(store: Path, numbers: Sequence[int], kills: int) -> None:
    """Do runs while processes are killed: this number of kills, each at once after one of the answers, at random.

    One in the middle of its run is hit as often as not. No clock has a part in it, so that a machine may be as busy as
    it likes; and with fewer kills than a run is tried again after, or few for the time that it takes, none is given up.
    """
    kept, random, begin = Store(store), Random(3), time.perf_counter()
    due = {*random.sample(range(len(numbers) - len(numbers) // 5), kills)}
    runner, owed = Runner(LocalExecutor(2), kept), 0
    for count, _ in enumerate(runner.answers(map(task_of, numbers))):
        owed += count in due
        if owed and kill_one(processes(random), random):
            owed -= 1
    seconds = time.perf_counter() - begin
    kept.close()
    print(f"\n{len(numbers)} runs, {kills} kills, {seconds:.1f} s: {len(numbers) / seconds:.0f} runs/s")
    assert (runner.done, owed) == (len(numbers), 0)


@pytest.mark.rotating(3)
def test_every_run_is_accounted_for_though_processes_are_killed(tmp_path: Path, size: Size) -> None:
    """A row for each run, with its own outcome and reason and nobody else's; good answers are equal bit for bit."""
    store = tmp_path / "store.sqlite"
    sweep(store, range(size.runs), size.kills)
    check_accounted_for(store, range(size.runs))


@pytest.mark.rotating(2, in_turn=True)
def test_every_quick_run_is_accounted_for_though_processes_are_killed_all_the_time(tmp_path: Path, size: Size) -> None:
    """As above, with a kill after every eighth answer."""
    store = tmp_path / "store.sqlite"
    quick = [number for number in range(size.runs) if not faults.due(number)[1].startswith(SLOW)]
    sweep(store, quick, len(quick) // 8)
    check_accounted_for(store, quick)


@pytest.mark.rotating(5)
def test_the_sweep_has_every_fault_and_a_fifth_of_its_runs_ends_badly(undisturbed: Path, size: Size) -> None:
    """Were a fault missing, nothing would be shown of it. With p = 0.2 of n runs, within 4 sqrt(n p (1 - p)) of n p."""
    bad = [wrong for number in range(size.runs) if (wrong := faults.fault(number)) is not None]
    spread = (size.runs * faults.SHARE * (1 - faults.SHARE)) ** 0.5
    assert abs(len(bad) - size.runs * faults.SHARE) < 4 * spread
    assert len({wrong.reason for wrong in bad}) >= 6
    check_accounted_for(undisturbed, range(size.runs))


def test_a_run_that_kills_itself_is_given_up(tmp_path: Path) -> None:
    """As often as it may be somebody else's doing it is tried again, and not for ever; the run beside it is well."""
    store = Store(tmp_path / "store.sqlite")
    well = [number for number in range(50) if faults.fault(number) is None]
    tasks = [Task(faults.end_oneself, ()), *map(task_of, well)]
    answers = {task.key: outcome_of_answer(answer) for task, answer in Runner(LocalExecutor(2), store).answers(tasks)}
    store.close()
    assert answers[tasks[0].key] == Outcome("crashed", f"killed by SIGKILL, {KILLS} times over")
    assert [(answers[task.key].ending, answers[task.key].reason) for task in tasks[1:]] == list(map(faults.due, well))


@pytest.mark.rotating(2, in_turn=True)
def test_a_lost_run_and_a_wrong_blame_are_told(undisturbed: Path, size: Size) -> None:
    """Shown to fail: a row less, one more, one twice, another outcome or reason, another answer, a bit of an array."""
    good, folder = rows(undisturbed), undisturbed.parent / "arrays"
    done = next(i for i, row in enumerate(good) if row["outcome"] == "done")
    crashed = next(i for i, row in enumerate(good) if row["outcome"] == "crashed")
    changes = [
        (done, {"outcome": "crashed", "reason": "killed by SIGKILL"}),
        (crashed, {"outcome": "done", "reason": ""}),
        (crashed, {"reason": "killed by SIGKILL"}),
        (done, {"key": "0" * 64}),
        (done, {"answer": good[crashed]["answer"]}),
        (done, {"arrays": good[next(i for i, r in enumerate(good) if r["arrays"] and i != done)]["arrays"]}),
    ]
    wrong = [[*good[:i], {**good[i], **change}, *good[i + 1 :]] for i, change in changes]
    for found in (*wrong, good[1:], [*good, good[0]], [*good, {**good[0], "key": "0" * 64}]):
        with pytest.raises(AssertionError):
            check_rows_due(found, range(size.runs), folder)
        with pytest.raises(AssertionError):
            check_same_rows(found, good)
    number = next(n for n in range(size.runs) if faults.due(n) == ("done", ""))
    row = next(row for row in good if row["parameters"] == f'{{"number": {number}}}')
    answer = faults.good_answer(number)
    check_answer(row, answer, folder)
    answer["points"].view("u8")[0, 0] ^= 1
    with pytest.raises(AssertionError):
        check_answer(row, answer, folder)
