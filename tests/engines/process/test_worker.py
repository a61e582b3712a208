"""One worker, task after task: what is said of a task that does not answer is that task's own doing."""

from __future__ import annotations

import multiprocessing.forkserver
from collections.abc import Callable
from typing import Any

import pytest

from engines.process import worker
from engines.process.worker import NoAnswerError, NotStartedError, Worker
from reference.outcome import Outcome
from tests.engines.process import misbehaving, used

#: [s], and [bytes]: nothing comes near.
LIMITS = 600.0, 4 * 2**30


@pytest.mark.parametrize(
    ("task", "arguments", "reason"),
    [
        (misbehaving.leave, (4,), "ended with exit code 4 and no answer"),
        (misbehaving.abort, (), "killed by SIGABRT; it said: no iterations: cannot go on"),
    ],
    ids=["silent", "with words"],
)
def test_the_last_words_are_those_of_the_task_that_failed(
    task: Callable[..., Any], arguments: tuple[Any, ...], reason: str
) -> None:
    """Not what an earlier task of the same process has printed."""
    used_again = Worker()
    try:
        first = used_again.do(used.say, ("all is well",), *LIMITS)
        assert used_again.do(used.say, ("mass 3 is far away",), *LIMITS) == first
        with pytest.raises(NoAnswerError) as caught:
            used_again.do(task, arguments, *LIMITS)
        assert caught.value.outcome == Outcome("crashed", reason)
        assert not caught.value.from_outside
    finally:
        used_again.end()


def test_what_is_to_be_imported_beforehand_is_told_to_the_server_that_forks_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """In the order in which it was asked for; what is needed anyway stays."""
    monkeypatch.setattr(worker, "_IMPORTED", list(worker._IMPORTED))
    needed = list(worker._IMPORTED)
    for _ in range(2):
        worker.import_beforehand("json", *needed)
    Worker().end()
    assert multiprocessing.forkserver._forkserver._preload_modules == [*needed, "json"]  # type: ignore[attr-defined]


def test_a_process_that_cannot_start_is_nobodys_crash(monkeypatch: pytest.MonkeyPatch) -> None:
    """It ends before any task was begun: that is no outcome of a task, and is told as what it is."""
    monkeypatch.setattr(worker, "work", misbehaving.leave_before_any_task)
    stillborn = Worker()
    try:
        with pytest.raises(NotStartedError, match="ended with exit code 3"):
            stillborn.do(used.say, ("anything",), *LIMITS)
    finally:
        stillborn.end()
