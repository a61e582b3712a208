"""Tasks are done once, one does not stop another, and where something stops them all, nothing goes on."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import AbstractContextManager
from itertools import islice
from pathlib import Path
from typing import Any

import click
import pytest

from experiments.runs.results import rows
from experiments.runs.runner import LocalExecutor, Runner, answer, current, using
from experiments.runs.store import Store, StoreError
from experiments.runs.task import Task
from reference.outcome import Outcome
from report.commands.runner_options import chosen_runner
from tests.engines.process import misbehaving
from tests.experiments.runs.tasks import FakeExecutor, alike, ended, endings, task
from tests.report.commands.terminal import ROOT


def tasks(*numbers: int) -> list[Task]:
    """Tasks of these numbers."""
    return [task(number) for number in numbers]


def answered(runner: Runner, *numbers: int) -> dict[int, Any]:
    """The answers of tasks by number."""
    return {done.arguments[0]: found for done, found in runner.answers(tasks(*numbers))}


# --- Once ---


def test_a_task_is_done_once(store: Store) -> None:
    """Its answer comes from the store the second time, and for another runner too."""
    executor = FakeExecutor(answers={1: ended("done")})
    runner = Runner(executor, store)
    assert alike(runner.answer(task(1)), ended("done"))
    assert alike(runner.answer(task(1)), ended("done"))
    assert alike(Runner(executor, store).answer(task(1)), ended("done"))
    assert (executor.asked, runner.done) == ([1], 1)


def test_without_a_store_a_task_is_done_whenever_it_is_asked_for() -> None:
    """Nothing is kept, nothing is counted as kept."""
    executor = FakeExecutor()
    runner = Runner(executor)
    assert [runner.answer(task(1)), runner.answer(task(1))] == [1, 1]
    assert executor.asked == [1, 1]


def test_many_tasks_are_done_once_each_by_many_threads(store: Store) -> None:
    """And counted exactly."""
    executor = FakeExecutor(size=8)
    runner = Runner(executor, store)
    assert answered(runner, *range(100)) == {number: number for number in range(100)}
    assert answered(runner, *range(150)) == {number: number for number in range(150)}
    assert (sorted(executor.asked), runner.done) == ([*range(150)], 150)


def test_the_seconds_it_took_are_kept(store: Store) -> None:
    """Those that the executor tells."""
    Runner(FakeExecutor(), store).answer(task(1))
    assert rows(store.file, {})[0]["seconds"] == 1 / 64


def test_an_executor_far_away_is_given_batches_that_keep_it_busy(store: Store) -> None:
    """A first task each, as nobody knows how long one takes; then as many as fill 1/4 s. Kept ones are no work."""
    executor = FakeExecutor(batch_seconds=0.25)
    assert answered(Runner(executor, store), *range(100)) == {number: number for number in range(100)}
    assert sorted(executor.asked) == [*range(100)]
    assert executor.batches[0] == 1
    assert set(executor.batches[2:-1]) == {16}, "the second may have been handed out before the first was done"
    again = FakeExecutor(batch_seconds=0.25)
    assert answered(Runner(again, store), *range(101)) == {number: number for number in range(101)}
    assert again.asked == [100]


# --- Starting over ---


def test_a_fresh_runner_does_again_what_was_kept_earlier_and_that_once(store: Store) -> None:
    """What it has done itself it does not do again; the older answers stay."""
    answered(Runner(FakeExecutor(), store), 1, 2)
    executor = FakeExecutor(answers={1: Outcome("done", "anew")})
    fresh = Runner(executor, store, fresh=True)
    assert [fresh.answer(task(1)).reason for _ in range(3)] == ["anew"] * 3
    assert executor.asked == [1]
    assert len(rows(store.file, {}, retired=True)) == 3


def test_starting_over_goes_on_after_it_was_interrupted(store: Store) -> None:
    """All tasks are retired before the first is done again, so that a later runner, not fresh, does the rest."""
    answered(Runner(FakeExecutor(), store), *range(6))
    executor = FakeExecutor(answers={3: InterruptedError("stopped")})
    fresh = Runner(executor, store, fresh=True)
    fresh.start_over(tasks(*range(6)))
    with pytest.raises(InterruptedError):
        answered(fresh, *range(6))
    again = len(endings(store.file))
    assert 3 <= again < 6
    later = FakeExecutor()
    answered(Runner(later, store), *range(6))
    assert len(later.asked) == 6 - again
    assert len(rows(store.file, {}, retired=True)) == 12


# --- Many ---


def test_tasks_are_taken_as_they_are_needed(store: Store) -> None:
    """There may be millions: no more than two for each place are under way."""
    taken = []

    def many() -> Iterator[Task]:
        for number in range(1000):
            taken.append(number)
            yield task(number)

    answers = Runner(FakeExecutor(size=3), store).answers(many())
    for so_far, _ in enumerate(islice(answers, 20), 1):
        assert len(taken) < so_far + 2 * 3
    answers.close()
    assert len(taken) < 20 + 2 * 3


def test_no_tasks_have_no_answers(store: Store) -> None:
    """At once."""
    assert [*Runner(FakeExecutor(), store).answers([])] == []


def test_a_task_that_fails_does_not_stop_the_others(store: Store) -> None:
    """Its outcome is its answer, and kept like any other."""
    executor = FakeExecutor(size=2, answers={2: Outcome("crashed", "killed by SIGSEGV")})
    found = answered(Runner(executor, store), *range(5))
    assert found == {0: 0, 1: 1, 2: Outcome("crashed", "killed by SIGSEGV"), 3: 3, 4: 4}
    assert endings(store.file) == [(0, "done"), (1, "done"), (2, "crashed"), (3, "done"), (4, "done")]


def test_on_this_machines_cores_a_crash_is_an_outcome_and_the_others_are_done(store: Store) -> None:
    """In processes of their own: neither is this one."""
    functions = [misbehaving.segfault, misbehaving.fine, misbehaving.divide, misbehaving.fine]
    found = [*Runner(LocalExecutor(2), store).answers(Task(function, ()) for function in functions)]
    assert len(found) == len(functions)
    assert {done.function.__name__: outcome.ending for done, outcome in found} == {
        "segfault": "crashed",
        "fine": "done",
        "divide": "crashed",
    }


# --- Stopping ---


def fails_at(number: int, monkeypatch: pytest.MonkeyPatch, store: Store) -> None:
    """Let a store fail when one task is to be kept."""
    keep = store.keep

    def failing(of: Task, *words: Any) -> None:
        if of.arguments == (number,):
            raise StoreError("store: the disk is full")
        keep(of, *words)

    monkeypatch.setattr(store, "keep", failing)


def test_a_store_that_fails_stops_everything_and_says_so(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing more is asked for, no thread is left, and what was kept before is kept.

    2 x size tasks are under way at once. Who hands them out may have looked just before the failure, and takes as many
    once more for those that were done then; at the next look it is seen.
    """
    fails_at(5, monkeypatch, store)
    executor, threads = FakeExecutor(size=2), threading.active_count()
    with pytest.raises(StoreError, match="the disk is full"):
        answered(Runner(executor, store), *range(1000))
    assert executor.stopped
    assert len(executor.asked) <= 5 + 1 + 4 * executor.size
    assert threading.active_count() == threads
    assert {(number, "done") for number in range(4)} <= {*endings(store.file)}


def test_who_stops_listening_stops_everything(store: Store) -> None:
    """No task goes on behind their back."""
    executor = FakeExecutor(size=2)
    answers = Runner(executor, store).answers(tasks(*range(1000)))
    next(answers)
    answers.close()
    assert executor.stopped
    assert len(executor.asked) <= 1 + 2 * executor.size


ABANDONED = """
from experiments.runs.runner import Runner
from tests.experiments.runs.tasks import FakeExecutor, task
answers = Runner(FakeExecutor(size=2)).answers(task(number) for number in range(1000))
next(answers)
"""


def test_answers_that_nobody_closes_do_not_keep_a_program_from_its_end() -> None:
    """Though they are still there when it ends."""
    said = subprocess.run(
        [sys.executable, "-c", ABANDONED], cwd=ROOT, env={**os.environ, "PYTHONPATH": str(ROOT)}, timeout=600
    )
    assert said.returncode == 0


def test_a_task_given_to_the_executor_after_it_was_stopped_is_stopped_too(store: Store) -> None:
    """A thread may have been looking into the store meanwhile."""
    looking, stops, late = threading.Event(), [], []

    class Executor(FakeExecutor):
        def do_one(self, task: Task) -> Any:
            if task.arguments == (0,):
                looking.wait(600)
                raise StoreError("store: the disk is full")
            looking.set()
            before = len(stops)
            for _ in range(60_000):
                if len(stops) >= before + 2:
                    raise InterruptedError("stopped")
                time.sleep(0.01)
            late.append(task)

        def stop(self) -> None:
            stops.append(len(stops))

    with pytest.raises(StoreError):
        answered(Runner(Executor(size=2), store), 0, 1)
    assert not late


def test_tasks_that_come_to_their_end_stop_nobody(store: Store) -> None:
    """The executor's processes are used again."""
    executor = FakeExecutor(size=2)
    answered(Runner(executor, store), *range(10))
    assert not executor.stopped


def test_a_task_that_makes_no_sense_stops_everything(store: Store) -> None:
    """As with a point of a sweep's grid that is refused."""

    def senseless() -> Iterator[Task]:
        yield from tasks(1, 2)
        raise ValueError("mass = -1")

    executor = FakeExecutor()
    with pytest.raises(ValueError, match="mass = -1"):
        [*Runner(executor, store).answers(senseless())]
    assert executor.stopped


def test_an_interrupted_task_is_not_kept(store: Store) -> None:
    """It has no answer."""
    with pytest.raises(InterruptedError):
        Runner(FakeExecutor(answers={1: InterruptedError("stopped")}), store).answer(task(1))
    assert endings(store.file) == []


# --- Who is at work ---


def fail(chosen: AbstractContextManager[Any], error: BaseException) -> None:
    """Raise an error while a runner is at work."""
    with chosen:
        raise error


def test_the_runner_at_work_is_the_one_chosen_last() -> None:
    """Until it is no more, however that comes; where none was chosen, one without a store."""
    one, two = Runner(FakeExecutor()), Runner(FakeExecutor())
    assert current().store is None
    assert isinstance(current().executor, LocalExecutor)
    with using(one):
        with using(two):
            assert current() is two
        assert current() is one
        with pytest.raises(KeyError):
            fail(using(two), KeyError())
        assert current() is one
    assert isinstance(current().executor, LocalExecutor)


def test_what_experiments_ask_for_the_runner_at_work_does(store: Store) -> None:
    """Within the limits they say."""
    asked: list[Task] = []

    class Executor(FakeExecutor):
        def do_one(self, task: Task) -> Any:
            asked.append(task)
            return "an answer"

    with using(Runner(Executor(), store)):
        for _ in range(2):
            assert answer(misbehaving.leave, 3, time_limit=1.0, memory_limit=2.0) == "an answer"
    (only,) = asked
    assert (only.function, only.arguments) == (misbehaving.leave, (3,))
    assert (only.time_limit, only.memory_limit) == (1.0, 2.0)


def test_an_executor_of_no_said_size_has_a_place_for_every_core() -> None:
    """And of one said, so many."""
    assert (LocalExecutor().size, LocalExecutor(3).size) == (os.cpu_count(), 3)


@pytest.mark.parametrize(
    ("resume", "command"), [(True, "the same command"), (False, "the same command without --fresh")]
)
def test_an_interrupted_command_says_how_to_go_on(
    store_file: Path, capsys: pytest.CaptureFixture[str], resume: bool, command: str
) -> None:
    """In one line, with the exit code that interrupted programs have; the store is closed, and nobody is at work."""
    with pytest.raises(click.exceptions.Exit) as ending:
        fail(chosen_runner(resume, store_file), KeyboardInterrupt())
    assert ending.value.exit_code == 130
    line = f"springlab: interrupted; what is done is kept in {store_file}: {command} goes on\n"
    assert capsys.readouterr().err == line
    assert isinstance(current().executor, LocalExecutor)


def test_a_chosen_runner_is_at_work_with_its_store_which_is_closed_afterwards(store_file: Path) -> None:
    """With as many places as were asked for."""
    with chosen_runner(True, store_file, jobs=3) as runner:
        assert current() is runner
        assert runner.executor.size == 3
        assert isinstance(runner.store, Store)
        assert runner.store.find(task(1)) is None
    assert current() is not runner
    with pytest.raises(StoreError, match="closed"):
        runner.store.find(task(1))
