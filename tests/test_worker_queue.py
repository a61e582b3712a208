"""Which worker runs which file: each file by one, each test once, and none lost with a worker that dies."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from tests.worker_queue import ByFile

#: How many tests each file has.
FILES = {"a.py": 4, "b.py": 1, "c.py": 3, "d.py": 5, "e.py": 1, "f.py": 2}
TESTS = [f"{file}::test_{k}" for file, count in FILES.items() for k in range(count)]


class Worker:
    """One that is given tests, and does them when it is told to."""

    def __init__(self, name: str) -> None:
        self.gateway, self.shutting_down = SimpleNamespace(id=name), False
        self.given: list[int] = []
        self.done: list[str] = []

    def send_runtest_some(self, places: list[int]) -> None:
        """Tests to do, by their places among those collected."""
        self.given += places

    def shutdown(self) -> None:
        """Nothing more will come."""
        self.shutting_down = True


@pytest.fixture
def workers() -> list[Worker]:
    """Two."""
    return [Worker("gw0"), Worker("gw1")]


@pytest.fixture
def queue(workers: list[Worker]) -> ByFile:
    """Their queue, with all that was collected."""
    config: Any = SimpleNamespace(
        getvalue=lambda _: ["popen", "popen"], option=SimpleNamespace(loadscopereorder=False, maxworkerrestart=None)
    )
    made = ByFile(config)
    for worker in workers:
        made.add_node(worker)  # type: ignore[arg-type]
    for worker in workers:
        made.add_node_collection(worker, list(TESTS))
    made.schedule()
    return made


def do_next(queue: ByFile, worker: Worker) -> None:
    """The next test of a worker."""
    place = worker.given.pop(0)
    worker.done.append(TESTS[place])
    queue.mark_test_complete(worker, place)


def files_of(worker: Worker) -> set[str]:
    """Whose tests it has done."""
    return {test.partition("::")[0] for test in worker.done}


def test_each_file_is_run_by_one_and_each_test_once(queue: ByFile, workers: list[Worker]) -> None:
    """Whoever has least to do gets the next file."""
    one, other = workers
    while one.given or other.given:
        for worker in (one, one, other):
            if worker.given:
                do_next(queue, worker)
    assert sorted(one.done + other.done) == sorted(TESTS)
    assert not files_of(one) & files_of(other)
    assert files_of(one)
    assert files_of(other)
    assert queue.tests_finished
    assert not queue.has_pending


def test_what_a_worker_that_dies_has_not_done_another_does(queue: ByFile, workers: list[Worker]) -> None:
    """Its file comes back with what is left of it; what was done is not done again."""
    one, other = workers
    do_next(queue, one)
    assert queue.remove_node(one) == "a.py::test_1"  # type: ignore[arg-type]
    while other.given:
        do_next(queue, other)
    assert sorted(one.done + other.done) == sorted(TESTS)
