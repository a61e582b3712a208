"""Processes are used again, and nobody is blamed for what another has done or somebody outside."""

from __future__ import annotations

import multiprocessing.forkserver
import os
import signal
import tempfile
import threading
import time
import venv
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pytest

from engines.process.supervisor import KILLS, Supervisor
from engines.process.worker import NoAnswerError, NotStartedError, Worker
from reference.outcome import Outcome
from tests.engines.process import misbehaving, used
from tests.soak.children import check_all_end

ROOT = Path(__file__).parents[3]

#: [s], and [bytes]: what nothing comes near to.
LONG, MUCH = 600.0, 4 * 2**30

#: What is waited for is there after this time [s], however busy the machine is.
PATIENCE = 600.0


class Asked(Supervisor):
    """A supervisor, asked with limits that nothing comes near to."""

    def ask(self, task: Callable[..., Any], *arguments: Any, time_limit: float = LONG, memory: float = MUCH) -> Any:
        """What a task returns."""
        return self.run(task, arguments, time_limit, memory)


@pytest.fixture(scope="module")
def python(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Another interpreter that can import the lab, the tests and NumPy."""
    home = tmp_path_factory.mktemp("another")
    venv.create(home)
    (packages,) = home.glob("lib/python*/site-packages")
    (packages / "lab.pth").write_text(f"{ROOT}\n{Path(np.__file__).parents[1]}\n")
    return home / "bin" / "python"


@pytest.fixture(params=["this interpreter", "another"])
def asked(request: pytest.FixtureRequest) -> Iterator[Asked]:
    """A supervisor of processes of this interpreter, and one of another's."""
    found = Asked(None if request.param == "this interpreter" else request.getfixturevalue("python"))
    yield found
    found.stop()


def lines(file: Path, count: int) -> list[int]:
    """The numbers noted in a file, as soon as there are so many."""
    deadline = time.monotonic() + PATIENCE
    while not file.exists() or file.read_text().count("\n") < count:
        assert time.monotonic() < deadline
        time.sleep(0.01)
    return list(map(int, file.read_text().split()))


def test_a_process_is_used_again(asked: Asked) -> None:
    """One task after another is done in the same one, which is none of ours."""
    pids = {asked.ask(used.pid) for _ in range(5)}
    assert pids == set(asked.pids())
    assert len(pids) == 1
    assert os.getpid() not in pids


def test_an_exception_costs_no_process(asked: Asked) -> None:
    """It is an answer like another."""
    first = asked.ask(used.pid)
    assert asked.ask(misbehaving.divide).reason == "ZeroDivisionError: mass 3 is zero and cannot be divided by"
    assert asked.ask(used.pid) == first


def test_a_task_that_only_a_used_process_fails_is_done_in_a_fresh_one(asked: Asked) -> None:
    """What an earlier task left behind is not its doing."""
    first = asked.ask(used.mark)
    assert asked.ask(used.crash_if_marked) not in (first, os.getpid())


@pytest.mark.parametrize(("before", "tries"), [(0, 1), (1, 2)])
def test_a_crash_is_tried_again_only_where_the_process_was_used(
    asked: Asked, tmp_path: Path, before: int, tries: int
) -> None:
    """In a fresh process it is the task's own doing, at once."""
    for _ in range(before):
        asked.ask(used.pid)
    assert asked.ask(used.crash, tmp_path / "noted").reason == "killed by SIGABRT"
    pids = lines(tmp_path / "noted", tries)
    assert len(pids) == len(set(pids)) == tries


@pytest.mark.rotating(7)
@pytest.mark.parametrize("before", [0, 1])
def test_too_much_memory_and_too_much_time_are_named(asked: Asked, before: int) -> None:
    """Whether the process had been used or not; and the next task is well."""
    for _ in range(before):
        asked.ask(used.pid)
    eaten = asked.ask(used.eat, 400 * 2**20, memory=0.3 * 2**30)
    assert eaten == Outcome("crashed", "took more than 0.3 GiB of memory")
    assert asked.ask(misbehaving.hang, time_limit=0.5) == Outcome("timed out", "no answer within 0.5 s")
    assert asked.ask(misbehaving.fine) == Outcome("done")


@pytest.mark.rotating(5, in_turn=True)
def test_memory_within_its_limit_is_nobodys_business(asked: Asked) -> None:
    """Shown the other way round: as much, with a limit twice as high, runs into the limit of time."""
    eaten = asked.ask(used.eat, 400 * 2**20, time_limit=1.5, memory=0.9 * 2**30)
    assert eaten == Outcome("timed out", "no answer within 1.5 s")


def test_a_task_whose_process_is_killed_from_outside_is_tried_again(asked: Asked, tmp_path: Path) -> None:
    """Twice killed, the third time done; by SIGTERM as by SIGKILL."""
    with ThreadPoolExecutor() as pool:
        answer = pool.submit(asked.ask, used.wait_at_first, tmp_path / "noted", 3)
        for killed, how in ((1, signal.SIGKILL), (2, signal.SIGTERM)):
            os.kill(lines(tmp_path / "noted", killed)[-1], how)
        assert answer.result() == lines(tmp_path / "noted", 3)[-1]


def test_a_process_that_is_killed_while_idle_costs_nobody_anything(asked: Asked) -> None:
    """The next task goes to another."""
    first = asked.ask(used.pid)
    os.kill(first, signal.SIGKILL)
    assert asked.ask(used.pid) != first


@pytest.mark.rotating(3, in_turn=True)
def test_a_task_is_not_tried_for_ever(asked: Asked, tmp_path: Path) -> None:
    """One that kills itself looks as if somebody else did: it is given up in the end, and it is said how often."""
    outcome = asked.ask(used.kill_oneself, tmp_path / "noted")
    assert outcome == Outcome("crashed", f"killed by SIGKILL, {KILLS} times over")
    assert len(lines(tmp_path / "noted", KILLS)) == KILLS


@pytest.mark.rotating(3, in_turn=True)
def test_an_end_that_looks_unseen_is_still_the_tasks_own_in_the_end(asked: Asked) -> None:
    """With exit code 255 ends also a process whose server was killed: it is tried again, and then blamed."""
    outcome = asked.ask(misbehaving.leave, 255)
    assert outcome == Outcome("crashed", f"ended with exit code 255 and no answer, {KILLS} times over")


@pytest.mark.parametrize(("number", "name"), [(signal.SIGBUS, "SIGBUS"), (40, "signal 40")])
def test_a_signal_is_named_even_one_that_has_no_name(asked: Asked, number: int, name: str) -> None:
    """Signals of real time have numbers only."""
    assert asked.ask(used.be_sent, number) == Outcome("crashed", f"killed by {name}")


def test_those_who_wait_are_interrupted_by_stop_and_new_tasks_are_done(asked: Asked) -> None:
    """At once, not at the end of their limit of ten minutes; and no process is left."""
    asked.ask(used.pid)
    with ThreadPoolExecutor() as pool:
        waiting = [pool.submit(asked.ask, misbehaving.hang) for _ in range(2)]
        while len(asked.pids()) < 2:
            time.sleep(0.01)
        processes = [psutil.Process(pid) for pid in asked.pids()]
        asked.stop()
        for future in waiting:
            with pytest.raises(InterruptedError):
                future.result(PATIENCE)
    assert asked.pids() == []
    check_all_end(processes)
    assert asked.ask(misbehaving.fine) == Outcome("done")


def test_threads_have_processes_of_their_own_at_once(asked: Asked, tmp_path: Path) -> None:
    """Four tasks that wait for one another are in four processes; afterwards these are used again."""
    with ThreadPoolExecutor(4) as pool:
        pids = set(pool.map(lambda _: asked.ask(used.gather, tmp_path, 4), range(4)))
    assert len(pids) == 4
    assert pids == set(asked.pids())
    assert asked.ask(used.pid) in pids


def test_nothing_is_left_of_a_process_that_was_stopped(
    asked: Asked, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its folder is removed, however it ended."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    asked.ask(misbehaving.abort)
    asked.ask(used.pid)
    assert list(tmp_path.iterdir())
    asked.stop()
    assert list(tmp_path.iterdir()) == []


def test_a_process_hears_no_interrupt(asked: Asked) -> None:
    """Ctrl-C is for the one it works for to act on, who still hears it."""
    assert asked.ask(used.hears_interrupts) is False
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, ())


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize("task", [misbehaving.hang, misbehaving.sleep])
def test_a_process_ends_with_the_one_it_works_for(python: Path, task: Callable[..., Any]) -> None:
    """Whatever it is at: as soon as nobody holds the other end of its lifeline."""
    for interpreter in (None, python):
        worker = Worker(interpreter)
        cut = threading.Timer(0.5, worker._lifeline.close)
        cut.start()
        with pytest.raises(NoAnswerError, match="killed by SIGKILL") as caught:
            worker.do(task, (), LONG, MUCH)
        assert caught.value.from_outside
        worker.end()


@pytest.mark.rotating(3, in_turn=True)
def test_what_a_killed_process_has_started_ends_with_it(asked: Asked, tmp_path: Path) -> None:
    """A task whose own process hangs: nobody is left of either, and the task is tried again."""
    with ThreadPoolExecutor() as pool:
        answer = pool.submit(asked.ask, used.have_it_done, tmp_path / "noted")
        (inner,) = map(psutil.Process, lines(tmp_path / "noted", 1))
        os.kill(asked.pids()[0], signal.SIGKILL)
        assert answer.result() == lines(tmp_path / "noted", 2)[-1]
        check_all_end([inner])


@pytest.mark.rotating(3, in_turn=True)
def test_the_server_that_forks_processes_may_be_killed_too(tmp_path: Path) -> None:
    """A task under way is tried again by a new one; the process that nobody sees the end of any more ends."""
    asked = Asked()
    with ThreadPoolExecutor() as pool:
        answer = pool.submit(asked.ask, used.wait_at_first, tmp_path / "noted", 2)
        (orphan,) = map(psutil.Process, lines(tmp_path / "noted", 1))
        os.kill(multiprocessing.forkserver._forkserver._forkserver_pid, signal.SIGKILL)  # type: ignore[attr-defined]
        assert answer.result() == lines(tmp_path / "noted", 2)[-1]
    check_all_end([orphan])
    asked.stop()


def test_another_interpreter_is_another_and_knows_nothing_of_this_ones_settings(
    python: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """PYTHONHOME, were it passed on, would stop it from starting."""
    monkeypatch.setenv("PYTHONHOME", "nowhere")
    asked = Asked(python)
    assert Path(asked.ask(used.prefix)) == python.parents[1]
    asked.stop()


def test_an_interpreter_that_cannot_import_the_lab_is_no_tasks_crash(tmp_path: Path) -> None:
    """It says so, and nothing is an outcome of the task."""
    venv.create(tmp_path)
    asked = Asked(tmp_path / "bin" / "python")
    with pytest.raises(NotStartedError, match="ended with exit code 1"):
        asked.ask(misbehaving.fine)
    asked.stop()
