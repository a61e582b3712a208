"""Jobs are done once, one does not stop another, and where something stops them all, nothing goes on."""

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
from experiments.runs.runner import LocalCrew, Runner, answer, current, using
from experiments.runs.store import Store, StoreError
from experiments.runs.task import Job
from reference.outcome import Outcome
from report.commands.runner_options import chosen_runner
from tests.engines.process import misbehaving
from tests.experiments.runs.tasks import FakeCrew, alike, ended, endings, job
from tests.report.commands.terminal import ROOT


def jobs(*numbers: int) -> list[Job]:
    """Jobs of these numbers."""
    return [job(number) for number in numbers]


def answered(runner: Runner, *numbers: int) -> dict[int, Any]:
    """The answers of jobs by number."""
    return {done.arguments[0]: found for done, found in runner.answers(jobs(*numbers))}


# --- Once ---


def test_a_job_is_done_once(store: Store) -> None:
    """Its answer comes from the store the second time, and for another runner too."""
    crew = FakeCrew(answers={1: ended("done")})
    runner = Runner(crew, store)
    assert alike(runner.answer(job(1)), ended("done"))
    assert alike(runner.answer(job(1)), ended("done"))
    assert alike(Runner(crew, store).answer(job(1)), ended("done"))
    assert (crew.asked, runner.done) == ([1], 1)


def test_without_a_store_a_job_is_done_whenever_it_is_asked_for() -> None:
    """Nothing is kept, nothing is counted as kept."""
    crew = FakeCrew()
    runner = Runner(crew)
    assert [runner.answer(job(1)), runner.answer(job(1))] == [1, 1]
    assert crew.asked == [1, 1]


def test_many_jobs_are_done_once_each_by_many_threads(store: Store) -> None:
    """And counted exactly."""
    crew = FakeCrew(size=8)
    runner = Runner(crew, store)
    assert answered(runner, *range(100)) == {number: number for number in range(100)}
    assert answered(runner, *range(150)) == {number: number for number in range(150)}
    assert (sorted(crew.asked), runner.done) == ([*range(150)], 150)


def test_the_seconds_it_took_are_kept(store: Store) -> None:
    """Those that the crew tells."""
    Runner(FakeCrew(), store).answer(job(1))
    assert rows(store.file, {})[0]["seconds"] == 1 / 64


def test_a_crew_far_away_is_given_portions_that_keep_it_busy(store: Store) -> None:
    """A first job each, as nobody knows how long one takes; then as many as fill 1/4 s. Kept ones are no work."""
    crew = FakeCrew(portion=0.25)
    assert answered(Runner(crew, store), *range(100)) == {number: number for number in range(100)}
    assert sorted(crew.asked) == [*range(100)]
    assert crew.portions[0] == 1
    assert set(crew.portions[2:-1]) == {16}, "the second may have been handed out before the first was done"
    again = FakeCrew(portion=0.25)
    assert answered(Runner(again, store), *range(101)) == {number: number for number in range(101)}
    assert again.asked == [100]


# --- Starting over ---


def test_a_fresh_runner_does_again_what_was_kept_earlier_and_that_once(store: Store) -> None:
    """What it has done itself it does not do again; the older answers stay."""
    answered(Runner(FakeCrew(), store), 1, 2)
    crew = FakeCrew(answers={1: Outcome("done", "anew")})
    fresh = Runner(crew, store, fresh=True)
    assert [fresh.answer(job(1)).reason for _ in range(3)] == ["anew"] * 3
    assert crew.asked == [1]
    assert len(rows(store.file, {}, retired=True)) == 3


def test_starting_over_goes_on_after_it_was_interrupted(store: Store) -> None:
    """All jobs are retired before the first is done again, so that a later runner, not fresh, does the rest."""
    answered(Runner(FakeCrew(), store), *range(6))
    crew = FakeCrew(answers={3: InterruptedError("stopped")})
    fresh = Runner(crew, store, fresh=True)
    fresh.start_over(jobs(*range(6)))
    with pytest.raises(InterruptedError):
        answered(fresh, *range(6))
    again = len(endings(store.file))
    assert 3 <= again < 6
    later = FakeCrew()
    answered(Runner(later, store), *range(6))
    assert len(later.asked) == 6 - again
    assert len(rows(store.file, {}, retired=True)) == 12


# --- Many ---


def test_jobs_are_taken_as_they_are_needed(store: Store) -> None:
    """There may be millions: no more than two for each place are under way."""
    taken = []

    def many() -> Iterator[Job]:
        for number in range(1000):
            taken.append(number)
            yield job(number)

    answers = Runner(FakeCrew(size=3), store).answers(many())
    for so_far, _ in enumerate(islice(answers, 20), 1):
        assert len(taken) < so_far + 2 * 3
    answers.close()
    assert len(taken) < 20 + 2 * 3


def test_no_jobs_have_no_answers(store: Store) -> None:
    """At once."""
    assert [*Runner(FakeCrew(), store).answers([])] == []


def test_a_job_that_fails_does_not_stop_the_others(store: Store) -> None:
    """Its outcome is its answer, and kept like any other."""
    crew = FakeCrew(size=2, answers={2: Outcome("crashed", "killed by SIGSEGV")})
    found = answered(Runner(crew, store), *range(5))
    assert found == {0: 0, 1: 1, 2: Outcome("crashed", "killed by SIGSEGV"), 3: 3, 4: 4}
    assert endings(store.file) == [(0, "done"), (1, "done"), (2, "crashed"), (3, "done"), (4, "done")]


def test_on_this_machines_cores_a_crash_is_an_outcome_and_the_others_are_done(store: Store) -> None:
    """In processes of their own: neither is this one."""
    tasks = [misbehaving.segfault, misbehaving.fine, misbehaving.divide, misbehaving.fine]
    found = [*Runner(LocalCrew(2), store).answers(Job(task, ()) for task in tasks)]
    assert len(found) == len(tasks)
    assert {done.task.__name__: outcome.ending for done, outcome in found} == {
        "segfault": "crashed",
        "fine": "done",
        "divide": "crashed",
    }


# --- Stopping ---


def fails_at(number: int, monkeypatch: pytest.MonkeyPatch, store: Store) -> None:
    """Let a store fail when one job is to be kept."""
    keep = store.keep

    def failing(of: Job, *words: Any) -> None:
        if of.arguments == (number,):
            raise StoreError("store: the disk is full")
        keep(of, *words)

    monkeypatch.setattr(store, "keep", failing)


def test_a_store_that_fails_stops_everything_and_says_so(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing more is asked for, no thread is left, and what was kept before is kept."""
    fails_at(5, monkeypatch, store)
    crew, threads = FakeCrew(size=2), threading.active_count()
    with pytest.raises(StoreError, match="the disk is full"):
        answered(Runner(crew, store), *range(1000))
    assert crew.stopped
    assert len(crew.asked) <= 5 + 1 + 2 * crew.size
    assert threading.active_count() == threads
    assert {(number, "done") for number in range(4)} <= {*endings(store.file)}


def test_who_stops_listening_stops_everything(store: Store) -> None:
    """No job goes on behind their back."""
    crew = FakeCrew(size=2)
    answers = Runner(crew, store).answers(jobs(*range(1000)))
    next(answers)
    answers.close()
    assert crew.stopped
    assert len(crew.asked) <= 1 + 2 * crew.size


ABANDONED = """
from experiments.runs.runner import Runner
from tests.experiments.runs.tasks import FakeCrew, job
answers = Runner(FakeCrew(size=2)).answers(job(number) for number in range(1000))
next(answers)
"""


def test_answers_that_nobody_closes_do_not_keep_a_program_from_its_end() -> None:
    """Though they are still there when it ends."""
    said = subprocess.run(
        [sys.executable, "-c", ABANDONED], cwd=ROOT, env={**os.environ, "PYTHONPATH": str(ROOT)}, timeout=60
    )
    assert said.returncode == 0


def test_a_job_given_to_the_crew_after_it_was_stopped_is_stopped_too(store: Store) -> None:
    """A thread may have been looking into the store meanwhile."""
    looking, stops, late = threading.Event(), [], []

    class Crew(FakeCrew):
        def do_one(self, job: Job) -> Any:
            if job.arguments == (0,):
                looking.wait(10)
                raise StoreError("store: the disk is full")
            looking.set()
            before = len(stops)
            for _ in range(500):
                if len(stops) >= before + 2:
                    raise InterruptedError("stopped")
                time.sleep(0.01)
            late.append(job)

        def stop(self) -> None:
            stops.append(len(stops))

    with pytest.raises(StoreError):
        answered(Runner(Crew(size=2), store), 0, 1)
    assert not late


def test_jobs_that_come_to_their_end_stop_nobody(store: Store) -> None:
    """The crew's processes are used again."""
    crew = FakeCrew(size=2)
    answered(Runner(crew, store), *range(10))
    assert not crew.stopped


def test_a_job_that_makes_no_sense_stops_everything(store: Store) -> None:
    """As with a point of a sweep's grid that is refused."""

    def senseless() -> Iterator[Job]:
        yield from jobs(1, 2)
        raise ValueError("mass = -1")

    crew = FakeCrew()
    with pytest.raises(ValueError, match="mass = -1"):
        [*Runner(crew, store).answers(senseless())]
    assert crew.stopped


def test_an_interrupted_job_is_not_kept(store: Store) -> None:
    """It has no answer."""
    with pytest.raises(InterruptedError):
        Runner(FakeCrew(answers={1: InterruptedError("stopped")}), store).answer(job(1))
    assert endings(store.file) == []


# --- Who is at work ---


def fail(chosen: AbstractContextManager[Any], error: BaseException) -> None:
    """Raise an error while a runner is at work."""
    with chosen:
        raise error


def test_the_runner_at_work_is_the_one_chosen_last() -> None:
    """Until it is no more, however that comes; where none was chosen, one without a store."""
    one, two = Runner(FakeCrew()), Runner(FakeCrew())
    assert current().store is None
    assert isinstance(current().crew, LocalCrew)
    with using(one):
        with using(two):
            assert current() is two
        assert current() is one
        with pytest.raises(KeyError):
            fail(using(two), KeyError())
        assert current() is one
    assert isinstance(current().crew, LocalCrew)


def test_what_experiments_ask_for_the_runner_at_work_does(store: Store) -> None:
    """Within the limits they say."""
    asked: list[Job] = []

    class Crew(FakeCrew):
        def do_one(self, job: Job) -> Any:
            asked.append(job)
            return "an answer"

    with using(Runner(Crew(), store)):
        for _ in range(2):
            assert answer(misbehaving.leave, 3, time_limit=1.0, memory_limit=2.0) == "an answer"
    (only,) = asked
    assert (only.task, only.arguments) == (misbehaving.leave, (3,))
    assert (only.time_limit, only.memory_limit) == (1.0, 2.0)


def test_a_crew_of_no_said_size_has_a_place_for_every_core() -> None:
    """And of one said, so many."""
    assert (LocalCrew().size, LocalCrew(3).size) == (os.cpu_count(), 3)


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
    assert isinstance(current().crew, LocalCrew)


def test_a_chosen_runner_is_at_work_with_its_store_which_is_closed_afterwards(store_file: Path) -> None:
    """With as many places as were asked for."""
    with chosen_runner(True, store_file, jobs=3) as runner:
        assert current() is runner
        assert runner.crew.size == 3
        assert isinstance(runner.store, Store)
        assert runner.store.find(job(1)) is None
    assert current() is not runner
    with pytest.raises(StoreError, match="closed"):
        runner.store.find(job(1))
